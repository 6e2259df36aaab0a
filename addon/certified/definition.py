"""Defines the certified picture, in integers: what each pixel shows, which is what is proven.

Each pixel has one stored ray. The ray, the triangles in world space and the infinite planes are
float64 numbers. They are taken as exact, and nothing that follows is rounded but t, once. Only hits
with clip start <= t <= clip end count, and none at t = 0 where clip start is 0.

Here and in all of this folder a ray *meets* a surface, an edge or a corner where the two have a
point in common; a triangle includes its edges and corners. A *hit* is such a place. The moved ray
of 2 meets no edges: it *crosses* the surfaces that it meets. Two surfaces *intersect*, in a line.

1. Clear rays. A ray is clear if, up to and including the first place where it meets anything, it
   meets no edge or corner of a triangle and no two surfaces at the same t. It sees the surface of
   the least t; or nothing, if it meets none.
2. Ambiguous rays: all others. The ray's direction is moved by (x, x^2, x^3) for an infinitely small
   x (`exact.py`), and the pixel shows the first surface that the moved ray crosses, which may be
   none. Of several in one plane it is the lowest (instance, triangle); planes come after all
   instances.
3. Depth. On the surface that is seen, the ray that was not moved has t = T / D, a fraction of two
   integers. It is rounded once, to the nearest float64, ties to even.

In Coq (`proofs/`), these are theorems about a model of `plain.py` whose arithmetic is recorded from
the code; docs/proof.md says what the model leaves out:

    certified_with_depth          all three; in it, `clearly_sees` is 1 and `moved_sees` is 2
    integers_exact, seen_exact    the integers are the floats, and find the hits in the clip range
    crossed_rule_all, order_rule  what the moved ray crosses, and in which order
    t_rounded                     3

Not claimed: that a stored ray is the camera's ideal ray, or a corner its exact transform
(`rounding.py` bounds both). Triangles that are not finite are left out, and counted.

This file is slow on purpose: it tests every ray with every surface. `plain.py` has the same result,
and uses integers only where floats leave a doubt; `sweep/` has it faster still, where
the picture is linear in the film position. Tests hold both equal to this file.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..arrays import Index
from ..scene import Scene
from ..tracer.camera import Rays, camera_rays, film_positions
from ..tracer.hits import NOTHING, NOWHERE
from ..tracer.ties import Name
from ..tracer.world import finite_triangles
from .exact import IntegerBatch
from .ties import seen_and_ties


class Seen(NamedTuple):
    """The surface that a ray sees."""

    name: Name  # instance and triangle; NOWHERE for nothing
    t: float  # the ray's parameter on it, of a camera's ray the depth in metres; inf for nothing
    # All names that an ambiguous ray might show, this one included; empty for a clear ray.
    ties: frozenset[Name]
    crossings: int  # how many surfaces the moved ray crosses within the clip range


def definition(scene: Scene, pixels: Index | None = None) -> Iterator[Seen]:
    """Yield what the rays of a camera's pixels see, row by row from the lowest.

    `pixels` (n,) are numbers of pixels in the camera's region; by default all.
    """
    camera = scene.camera
    rays = camera_rays(camera, *film_positions(camera.region, pixel=pixels))
    return seen_by(scene, rays, (camera.clip_start, camera.clip_end))


def seen_by(scene: Scene, rays: Rays, clip: tuple[float, float]) -> Iterator[Seen]:
    """Yield what any rays see in a clip range."""
    triangles = finite_triangles(scene)
    first_plane = len(scene.instances)
    names = [(first_plane + number, NOTHING) for number in range(len(scene.planes))]
    names += zip(triangles.instance.tolist(), triangles.triangle.tolist(), strict=True)
    planes = [(plane.point, plane.normal) for plane in scene.planes]
    integers = IntegerBatch(rays, triangles.corners, planes, *clip)  # planes first, as in `names`
    for ray in range(rays.count):
        met = []
        for number, name in enumerate(names):
            hit = integers.hit(ray, number)
            if hit is not None:
                met.append((name, hit))
        chosen, ties = seen_and_ties(met)  # an index; -1 for nothing
        crossings = sum(hit.is_crossed() for _, hit in met)
        if chosen >= 0:
            name, hit = met[chosen]
            yield Seen(name, integers.t(hit), ties, crossings)
        else:
            yield Seen(NOWHERE, np.inf, ties, crossings)

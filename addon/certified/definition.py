"""Says what a certified picture is, in integers: what is proven of every pixel.

The theorem, for each stored ray, in exact arithmetic and within the camera's clip range:

1. If the ray meets no edge or corner and no two surfaces at once before anything else, it sees the
   one surface that it meets at the least t, or nothing where it meets none.
2. Otherwise it is ambiguous: it sees what the ray sees that is moved infinitesimally by the rule of
   `exact.py`, and of several surfaces in one plane the one of the lowest (instance, triangle).
3. Its t = T / D is rounded once, to the nearest float64, ties to even.

In Coq (`proofs/`), `certified_with_depth` is the theorem, about `plain.py`; `clearly_sees` there is
1, and `moved_sees` is 2, both in real numbers. That the integers below compute just that:
`integers_exact` (floats as integers), `seen_exact` (hits within the clip range), `t_rounded` (3),
`met_rule_all` and `order_rule` (the ray that is moved).

Nothing here is fast: every ray meets every surface. There are no candidates, no error bounds and no
batches. `plain.py` is this definition with a filter, `sweep/` is the same sooner, and tests hold
both equal to it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..arrays import Index
from ..scene import Scene
from ..tracer.camera import camera_rays, film_positions
from ..tracer.hits import NOTHING, NOWHERE, Name
from ..tracer.world import WorldTriangles, batches, world_triangles
from .exact import IntegerBatch
from .ties import seen_and_ties


class Seen(NamedTuple):
    """What a ray sees."""

    name: Name  # instance and triangle; NOWHERE for nothing
    t: float  # metres along the view axis; inf for nothing
    ties: frozenset[Name]  # of an ambiguous ray, all that it may be said to see; else empty
    crossings: int  # of the moved ray with surfaces, within the clip range


def definition(scene: Scene, pixels: Index | None = None) -> Iterator[Seen]:
    """Yield what the rays of a camera's pixels see, row by row from the lowest.

    `pixels` (n,) are the numbers of some of them; by default all.
    """
    camera = scene.camera
    rays = camera_rays(camera, *film_positions(camera.region, pixel=pixels))
    triangles, names = _surfaces(scene)
    planes = [(plane.point, plane.normal) for plane in scene.planes]
    clip = camera.clip_start, camera.clip_end
    surfaces = IntegerBatch(rays, triangles.corners, planes, *clip)
    for ray in range(rays.count):
        exact = [surfaces.hit(ray, number) for number in range(len(names))]
        met = [(name, hit) for name, hit in zip(names, exact, strict=True) if hit]
        seen, ties = seen_and_ties(met)
        name, t = NOWHERE, np.inf
        if seen >= 0:
            name, hit = met[seen]
            t = surfaces.t(hit)
        yield Seen(name, t, ties, sum(hit.is_hit() for _, hit in met))


def _surfaces(scene: Scene) -> tuple[WorldTriangles, list[Name]]:
    """Return all triangles in world space, and the names of all planes, then of the triangles."""
    every = [world_triangles(scene, batch, np.dtype(float)) for batch in batches(scene)]
    triangles = WorldTriangles.joined([WorldTriangles.none(), *every])
    triangles = triangles.take(np.flatnonzero(triangles.finite))
    first = len(scene.instances)
    names = [(first + number, NOTHING) for number in range(len(scene.planes))]
    names += zip(triangles.instance.tolist(), triangles.triangle.tolist(), strict=True)
    return triangles, names

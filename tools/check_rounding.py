"""Counts the pixels that would show another surface if nothing were rounded before the proof.

    .venv/bin/python tools/check_rounding.py SCENE

SCENE is a .blend, an .npz or a mesh. Rays and corners are rounded before they are stored
(`addon/certified/rounding.py`). The ladder of `plain.py` is climbed again with its bounds widened:
what is certain there is certain for the unrounded rays and corners, too. Rays that are left in
doubt are asked exactly, in fractions.
"""

from __future__ import annotations

import sys
from copy import copy
from dataclasses import dataclass, field, replace
from fractions import Fraction
from pathlib import Path

import numpy as np
from reference_tracer.arrays import Array, Floats, Index, Integers
from reference_tracer.certified.arithmetic import check_assumptions
from reference_tracer.certified.bounds import BOUND, plane_fractions
from reference_tracer.certified.ladder import BY_INTEGERS, Decisions, Ladder
from reference_tracer.certified.rounding import rounding
from reference_tracer.certified.surfaces import Candidates, Surfaces
from reference_tracer.cli.opening import load
from reference_tracer.rendering import render
from reference_tracer.scene import Scene, SceneError, ViewWindow
from reference_tracer.tracer.camera import (
    Rays,
    camera_rays,
    corner_rays,
    dual_axes,
    film_positions,
    pixel_size,
)
from reference_tracer.tracer.candidates import candidates, cull
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.vector import Vectors, transform_points

_ROWS = 32  # of a tile
rational = np.vectorize(lambda x: Fraction(float(x)), otypes=[object])  # of floats, exactly


@dataclass
class Rounding:
    """The pixels (x, y) that would show another surface unrounded, of how many asked exactly."""

    total: int
    others: list[tuple[int, int]] = field(default_factory=list)
    asked: int = 0

    def __str__(self) -> str:
        at = f", as at {self.others[0]}" if self.others else ""
        return (
            f"{len(self.others):,} of {self.total:,} pixels would show another surface unrounded"
            f"{at} ({self.asked:,} were asked exactly)"
        )


def check_rounding(scene: Scene, frame: Frame) -> Rounding:
    """Find the pixels of a certified frame that would show another surface.

    Raises
    ------
    SceneError
        If rounding may move what is seen first behind the eye, or if rays are no fractions.
    """
    check_assumptions()
    camera = scene.camera
    if not camera.projection.is_linear:
        raise SceneError(
            f"The unrounded rays of an {camera.projection.name} camera are sines and cosines, "
            "which no fractions are"
        )
    region = camera.region
    loose, aside, reach = _loosened(scene)
    plan = result_of(cull(loose, np.dtype(float), 1 << 26, reach))
    around = _around(corner_rays(camera), aside)
    stored = np.stack((frame.instance_index, frame.triangle_index))
    found = Rounding(stored[0].size)
    for y in range(region.y0, region.y1, _ROWS):
        tile = replace(region, y0=y, y1=min(y + _ROWS, region.y1))
        film = film_positions(tile)
        ladder = _Widened(scene, camera_rays(camera, *film), around, aside)
        for _, pairs in candidates(plan, tile):
            if pairs:
                ladder.test(pairs)
        left, clear, surfaces = ladder.left()
        for part in left.take(np.flatnonzero(~clear)).by_ray(BY_INTEGERS):
            ray, seen = _unrounded(scene, film, part, surfaces)
            shown = stored[:, y - region.y0 :].reshape(2, -1)[:, ray]
            found.asked += len(ray)
            found.others += [
                (region.x0 + own % region.width, y + own // region.width)
                for own in ray[(seen != shown).any(axis=0)].tolist()
            ]
    return found


def _loosened(scene: Scene) -> tuple[Scene, float, float]:
    """Return a scene whose clip range has room for rounding, and how far rays may be moved.

    Rays are moved by a length at the least depth that is seen, and by pixels. Moving a corner moves
    no point of its triangle farther than itself: it counts as moving the ray. All is twice the
    bound, as the moved numbers are rounded, too.
    """
    camera = scene.camera
    w = camera.window
    off = rounding(scene)
    axes = float(np.max(np.abs(dual_axes(camera)).sum(axis=1)))
    along = 2 * (off.ray + off.corner) * axes  # how far a depth is moved
    start = camera.clip_start - along
    loose = scene.seen_by(replace(camera, clip_start=start, clip_end=camera.clip_end + along))
    aside = 2 * (off.ray + off.corner / camera.projection.scale(loose.camera.clip_start))
    slant = camera.projection.slant(max(abs(w.left), abs(w.right), abs(w.bottom), abs(w.top)))
    return loose, aside, aside * axes * slant / min(pixel_size(camera))


class _Widened(Ladder):
    """A ladder whose bounds of planes hold for all rays that are off by at most `room`."""

    def __init__(self, scene: Scene, rays: Rays, around: Rays, room: float) -> None:
        self._room = room  # in every component
        clip = scene.camera.clip_start, scene.camera.clip_end
        super().__init__(rays, Surfaces.planes_of(scene), clip, around)

    def _test_plane(self, number: int, point: Floats, normal: Floats) -> None:
        every = np.arange(self._rays.count)
        with np.errstate(all="ignore"):
            fractions = plane_fractions(self._rays, point, normal)
            for error in (fractions.numerator_error, fractions.denominator_error):
                error += self._room * np.abs(normal).sum()
            plane, sure = np.full(len(every), number), np.ones(len(every), bool)
            self._found.append(self._candidates(every, plane, fractions, sure))


def _around(rays: Rays, aside: float) -> Rays:
    """Return rays so far around others that error bounds for them hold for rays moved aside, too.

    An error bound is at least BOUND times the largest components.
    """
    ends = np.array((-1, 1)).repeat(4) * aside / BOUND

    def widened(vectors: Vectors) -> Vectors:
        return vectors if vectors.shape[1] == 1 else np.tile(vectors, 2) + ends

    return Rays(widened(rays.origins), widened(rays.directions))


def _unrounded(
    scene: Scene, film: tuple[Floats, Floats], found: Candidates, surfaces: Surfaces
) -> tuple[Index, Index]:
    """Return the rays of these candidates, (n,), and what they see in fractions: names, (2, n)."""
    which, ray = np.unique(found.ray, return_inverse=True)
    camera = copy(scene.camera)
    w = camera.window
    window = ViewWindow(*rational((w.left, w.right, w.bottom, w.top)))
    # Not by `replace`: a camera of fractions is refused when it is made.
    vars(camera).update(window=window, world_from_camera=rational(camera.world_from_camera))
    unit = 4 * camera.width * camera.height  # of lengths: denominators are then powers of two
    px, py = film
    exact = camera_rays(camera, rational(px[which]), rational(py[which]), object)
    rays = Rays(exact.origins * unit, exact.directions * unit)
    some, surface = surfaces.only(found.surface)
    corners = unrounded_corners(scene, some.triangles.instance, some.triangles.triangle)
    planes = [(rational(point) * unit, normal) for point, normal in some.planes]
    triangles = replace(some.triangles, corners=corners * unit)
    some = replace(some, planes=planes, triangles=triangles)
    hits = Hits.none(len(which))
    decisions = Decisions(hits, rays, some, (camera.clip_start, camera.clip_end), rays)
    decisions.by_integers(replace(found, ray=ray, surface=surface))
    return which, np.stack((hits.instance, hits.triangle))


def unrounded_corners(scene: Scene, instance: Integers, triangle: Integers) -> Array:
    """Return corners of named triangles in world space, fractions: (corner, component, m)."""
    out = np.empty((3, 3, len(instance)), object)
    for k, (of, name) in enumerate(zip(instance, triangle, strict=True)):
        mesh = scene.meshes[scene.instances[of].mesh]
        corners = rational(mesh.vertices[mesh.triangles[name]].T)
        out[..., k] = transform_points(rational(scene.instances[of].world_from_object), corners).T
    return out


def main() -> None:
    """Trace the scene, and print how far rounding goes and what it changes."""
    scene, _ = load(Path(sys.argv[1]))
    frame = render(scene, Settings("certified"))
    print(rounding(scene), check_rounding(scene, frame), sep="\n")


if __name__ == "__main__":
    main()

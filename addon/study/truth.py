"""Finds a scene's picture by a method, and how many triangles each of its rays crosses.

A sample of the rays is held against the definition, in integers, with every surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Index, Places
from ..certainty import Certainty
from ..certified.any_rays import decide
from ..methods import Method
from ..rendering import steps
from ..scene import Camera, Scene
from ..tracer.camera import Rays, camera_rays, film_positions
from ..tracer.candidates import candidates
from ..tracer.frame import Frame
from ..tracer.hits import Hits
from ..tracer.nearest import plan, test_pairs, test_planes
from ..tracer.progress import Progress, Work, scaled
from ..tracer.settings import UNPROVEN_SETTINGS, Precision, Settings

CERTIFIED = Settings(Method.CERTIFIED)


@dataclass(frozen=True, eq=False)
class Truth:
    """A scene's picture by a method, and how many triangles each of its rays crosses."""

    frame: Frame
    count: Index  # (n,) of each ray, near or far within the clip range


def truth_of(scene: Scene) -> Work[Truth]:
    """Find the truth of a scene."""
    frame = Frame.empty(scene)
    yield from scaled(steps(scene, CERTIFIED, frame), 0.0, 0.5)
    region, rays = scene.camera.region, pixel_rays(scene.camera, CERTIFIED.precision)
    clip = scene.camera.clip_start, scene.camera.clip_end
    count = np.zeros(rays.count, np.int64)
    made = yield from plan(scene, CERTIFIED, reach=0.0)
    for share, some in candidates(made, region):
        yield Progress(0.5 + 0.5 * share)
        if some is not None:
            corners = some.triangles.corners
            crossed = decide(rays.take(some.pixel), corners, *clip, row=some.row).crossed
            count += np.bincount(some.pixel[crossed], minlength=len(count))
    return Truth(frame, count)


def plain_of(scene: Scene, precision: Precision) -> Work[dict[Method, Truth]]:
    """Find what every unproven method makes of a scene in a precision: they share what is tested.

    Its frames have no colours. Infinite planes are seen, but not counted.
    """
    region, rays = scene.camera.region, pixel_rays(scene.camera, precision)
    every = [s for s in UNPROVEN_SETTINGS if s.precision == precision]
    found = [(s, Hits.none(rays.count), np.zeros(rays.count, np.int64)) for s in every]
    for _, hits, _ in found:
        test_planes(scene, rays, hits)
    made = yield from plan(scene, every[0], reach=0.0)
    for share, some in candidates(made, region):
        yield Progress(share)
        if some is None:
            continue
        for settings, hits, count in found:
            crossed = some.pixel[test_pairs(scene, settings, rays, some, hits)[0]]
            count += np.bincount(crossed, minlength=rays.count)
    out = {}
    for settings, hits, count in found:
        frame = Frame.empty(scene)
        frame.enter(slice(0, region.height), hits)
        frame.statistics.refused = made.refused
        out[settings.method] = Truth(frame, count)
    return out


def pixel_rays(camera: Camera, precision: Precision) -> Rays:
    """Return the rays through the centres of the camera's pixels, row by row from the lowest."""
    return camera_rays(camera, *film_positions(camera.region), precision.dtype)


def largest_t_error(frame: Frame, certified: Frame, in_ulp: bool = False) -> float | None:
    """Return the largest error of t where both frames see the same surface; None where none do.

    In metres along the view axis; or, with `in_ulp`, in units in the last place of the certified t
    as a float64.
    """
    same = (
        (frame.instance_index == certified.instance_index)
        & (frame.triangle_index == certified.triangle_index)
        & np.isfinite(certified.t)
    )
    if not same.any():
        return None
    t, exact = frame.t[same], certified.t[same]
    unit = np.spacing(exact) if in_ulp else 1.0
    with np.errstate(over="ignore"):  # a plain t may be off by more ulp than there are doubles
        return float(np.abs(t / unit - exact / unit).max())  # a difference of t may overflow, too


def sample(frame: Frame, count: int) -> Places:
    """Return pixels to ask about: half of them anywhere, half where integers had to decide."""
    rng = np.random.default_rng(count)
    anywhere = rng.permutation(frame.certainty.size)
    hard = rng.permutation(np.flatnonzero(frame.certainty >= Certainty.EXACT))[: count // 2]
    rest = anywhere[~np.isin(anywhere, hard)][: count - len(hard)]
    return np.sort(np.concatenate((hard, rest)))

"""Finds a scene's certified picture, and how many triangles each certified ray crosses.

A sample of the rays is held against the definition, in integers, with every surface.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Index, Places
from ..certainty import Certainty
from ..certified.any_rays import decide
from ..methods import Method
from ..rendering import steps
from ..scene import Camera, Scene
from ..tracer.camera import Rays, camera_rays, film_positions
from ..tracer.candidates import candidates
from ..tracer.frame import Frame
from ..tracer.nearest import plan
from ..tracer.progress import Work, scaled
from ..tracer.settings import Precision, Settings
from ..tracer.world import Pairs

CERTIFIED = Settings(Method.CERTIFIED)


@dataclass(frozen=True, eq=False)
class Truth:
    """A scene's certified picture, and how many triangles each certified ray crosses."""

    frame: Frame
    count: Index  # (n,) of each ray


def truth_of(scene: Scene) -> Work[Truth]:
    """Find the truth of a scene."""
    frame = Frame.empty(scene)
    for share in steps(scene, CERTIFIED, frame):
        yield 0.5 * share
    clip = scene.camera.clip_start, scene.camera.clip_end
    counting = crossings(
        scene,
        CERTIFIED,
        lambda rays, p: decide(rays, p.corners.astype(float, copy=False), *clip).hit,
    )
    return Truth(frame, (yield from scaled(counting, 0.5, 0.5)))


def crossings(
    scene: Scene, settings: Settings, test: Callable[[Rays, Pairs], Bools]
) -> Work[Index]:
    """Count the triangles that each of the camera's rays crosses, (n,), near or far.

    `test` takes p rays and p pairs, and returns which are crossed within the clip range, (p,) bool.
    """
    region = scene.camera.region
    rays = pixel_rays(scene.camera, settings.precision)
    count = np.zeros(region.width * region.height, np.int64)
    made = yield from plan(scene, settings, reach=0.0)
    for share, some in candidates(made, region):
        yield share
        if some is not None:
            crossed = some.pixel[test(rays.take(some.pixel), some)]
            count += np.bincount(crossed, minlength=len(count))
    return count


def pixel_rays(camera: Camera, precision: Precision) -> Rays:
    """Return the rays through the centres of the camera's pixels, row by row from the lowest."""
    return camera_rays(camera, *film_positions(camera.region, 0.0, 0.0), precision.dtype)


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

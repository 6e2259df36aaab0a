"""The truth of a scene: its certified picture, and all that each certified ray crosses.

The oracle, which has no part in either, is asked about a sample of the rays.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..methods import Method
from ..scene import Camera, Scene
from ..tracer.any_rays import decide
from ..tracer.camera import Rays, camera_rays
from ..tracer.candidates import Pairs
from ..tracer.certified.certainty import Certainty
from ..tracer.frame import Frame
from ..tracer.nearest import candidates, film_positions, plan
from ..tracer.progress import Work, scaled
from ..tracer.render import steps
from ..tracer.settings import Precision, Settings

CERTIFIED = Settings(Method.CERTIFIED)


@dataclass(frozen=True, eq=False)
class Crossings:
    """Pairs of a ray and a triangle that it crosses: `keys` (k,) int64; `count` (n,) of each."""

    keys: NDArray[np.int64]
    count: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Truth:
    """A scene's certified picture, and every triangle that a certified ray crosses."""

    scene: Scene
    frame: Frame
    crossed: Crossings


def truth_of(scene: Scene) -> Work[Truth]:
    """Find the truth of a scene."""
    frame = Frame.empty(scene)
    for share in steps(scene, CERTIFIED, frame):
        yield 0.5 * share
    clip = scene.camera.clip_start, scene.camera.clip_end
    counting = crossings(
        scene, CERTIFIED, lambda rays, pairs: decide(rays, pairs.corners, *clip).hit
    )
    crossed = yield from scaled(counting, 0.5, 0.5)
    return Truth(scene, frame, crossed)


def crossings(
    scene: Scene, settings: Settings, test: Callable[[Rays, Pairs], NDArray[np.bool_]]
) -> Work[Crossings]:
    """Find all that the camera's rays cross, whether it is the nearest or not.

    Parameters
    ----------
    scene : Scene
    settings : Settings
    test : callable
        Takes p rays and p pairs; returns which are crossed within the clip range, (p,) bool.
    """
    region = scene.camera.region
    rays = pixel_rays(scene.camera, settings.precision)
    pixel, name = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    made = yield from plan(scene, settings, reach=0.0)
    for share, some in candidates(made, region):
        yield share
        if some is not None:
            hit = np.flatnonzero(test(rays.take(some.pixel), some))
            pixel.append(some.pixel[hit])
            name.append(number(scene, some.instance[hit], some.triangle[hit]))
    pixel, name = np.concatenate(pixel), np.concatenate(name)
    return Crossings(
        keys(scene, pixel, name),
        np.bincount(pixel, minlength=region.width * region.height),
    )


def pixel_rays(camera: Camera, precision: Precision) -> Rays:
    """Return the rays through the centres of the camera's pixels, row by row from the lowest."""
    return camera_rays(camera, *film_positions(camera.region, 0.0, 0.0), precision.dtype)


def number(scene: Scene, instance: NDArray, triangle: NDArray) -> NDArray[np.int64]:
    """Return numbers for triangles of all instances."""
    counts = [len(scene.meshes[i.mesh].triangles) for i in scene.instances]
    return np.concatenate(([0], np.cumsum(counts)))[instance] + triangle


def keys(scene: Scene, pixel: NDArray, name: NDArray) -> NDArray[np.int64]:
    """Return one number for each pair of a pixel and a numbered triangle."""
    return pixel * max(1, scene.triangle_count) + name


def sample(frame: Frame, count: int) -> NDArray[np.intp]:
    """Return pixels to ask about: half of them anywhere, half where integers had to decide."""
    rng = np.random.default_rng(count)
    anywhere = rng.permutation(frame.certainty.size)
    hard = rng.permutation(np.flatnonzero(frame.certainty >= Certainty.EXACT))[: count // 2]
    rest = anywhere[~np.isin(anywhere, hard)][: count - len(hard)]
    return np.sort(np.concatenate((hard, rest)))

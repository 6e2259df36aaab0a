"""Prepares a scene to judge students on: some pixels, the pairs that their rays need, the truth.

Any number of students' functions can be held against a `JudgedScene`. Where float64 may see either
of two surfaces, by its rounding, the pixel is on the *boundary*; all others are the *interior*, and
there a sound function has no excuse.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Array, Bools, Colors, Floats, Integers, Places
from reference_tracer.certainty import Certainty
from reference_tracer.certified.bounds import U, plane_fractions
from reference_tracer.methods import Method
from reference_tracer.rendering import steps
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.camera import Rays, camera_rays, film_positions
from reference_tracer.tracer.candidates import candidates
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING, Hits
from reference_tracer.tracer.nearest import plan, test_planes
from reference_tracer.tracer.progress import Progress, Work, scaled
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.ties import Ties
from reference_tracer.tracer.world import Pairs

from .known import Known, known
from .options import PIXELS

_ALIKE = 64 * U  # relative: planes' own depths, which the tracer computes, are better than this


@dataclass(frozen=True, eq=False)
class JudgedScene:
    """The truth about a scene, for students' functions.

    Arrays of pixels are those of the chosen ones, (h, w): every `stride`-th of the camera's region,
    from `first` on, or flat (n,), row by row from the lowest.
    """

    name: str
    source: str  # what the user named, for a command that explains a pixel
    scene: Scene
    stride: int
    first: int
    shape: tuple[int, int]
    rays: Rays  # (3, n) or (3, 1)
    pairs: list[Pairs]  # `pixel` numbers the n pixels
    planes: Hits  # the nearest infinite plane of each ray
    color: Colors  # (h, w, 4) certified
    t: Floats  # (n,) certified; inf: no hit
    instance: Integers
    triangle: Integers
    chosen: Places  # (n,) the pixels' numbers in the camera's region
    ties: Ties  # by these numbers
    ambiguous: Bools  # (n,) the ray meets an edge or two surfaces exactly
    near_edge: Bools  # (n,) it passes within float64's reach of an edge
    near_tie: Bools  # (n,) two surfaces are within float64's reach of one another
    camera_options: tuple[str, ...] = ()  # those of the command line that placed its camera

    @property
    def boundary(self) -> Bools:
        """Which pixels sound float64 may have otherwise, (n,)."""
        return self.ambiguous | self.near_edge | self.near_tie

    def position(self, pixel: int) -> tuple[int, int]:
        """Return x and y of one of the n pixels in the camera's region, from its lower left."""
        y, x = divmod(int(self.chosen[pixel]), self.scene.camera.region.width)
        return x, y


def arrays(rays: Rays, pixel: Array, corners: Array) -> tuple[Array, Array, Array]:
    """Return origins, directions and triangles (corner, component, pair) as students have them."""
    own = rays.take(pixel)
    o, d = (np.broadcast_to(v, (3, len(pixel))).T for v in (own.origins, own.directions))
    return o, d, corners.transpose(2, 0, 1)


def prepare(
    name: str,
    scene: Scene,
    source: str = "",
    pixels: int | None = PIXELS,
    camera_options: tuple[str, ...] = (),
) -> Work[JudgedScene]:
    """Trace a scene, certified, and find the truth of some of its pixels.

    Parameters
    ----------
    name, source : str
    scene : Scene
    pixels : int, optional
        About so many: every second, third and so on in both directions. None for all.
    camera_options : tuple of str, optional
        Those of the command line without which `source` has another camera.

    Raises
    ------
    SceneError
        If the camera shows what is behind its rays' origins: students' functions only have t > 0.
    """
    region = scene.camera.region
    if scene.camera.clip_start < 0:
        raise SceneError(
            f"{name}: the camera '{scene.camera.name}' shows what is behind it (its clip start is "
            f"{scene.camera.clip_start:g} m), where t < 0 is no hit: raise its clip start to 0."
        )
    frame = Frame.empty(scene)
    yield from scaled(steps(scene, Settings(Method.CERTIFIED), frame), 0.0, 0.5)
    total = region.width * region.height
    stride = 1 if pixels is None else max(1, int(np.ceil(np.sqrt(total / pixels))))
    stride = min(stride, region.width, region.height)
    first = stride // 2
    grid = np.arange(total).reshape(region.height, region.width)[first::stride, first::stride]
    chosen = grid.ravel()
    rays = camera_rays(scene.camera, *film_positions(region, pixel=chosen))
    planes = Hits.none(len(chosen))
    test_planes(scene, rays, planes)
    judged = JudgedScene(
        name,
        source or name,
        scene,
        stride,
        first,
        grid.shape,
        rays,
        [],
        planes,
        frame.color.reshape(-1, 4)[chosen].reshape(*grid.shape, 4),
        frame.t.ravel()[chosen],
        frame.instance_index.ravel()[chosen],
        frame.triangle_index.ravel()[chosen],
        chosen,
        frame.ties,
        frame.certainty.ravel()[chosen] == Certainty.AMBIGUOUS,
        np.zeros(len(chosen), bool),
        _near_planes(scene, rays, frame.t.ravel()[chosen], planes),
        camera_options,
    )
    yield from _find_pairs(judged)
    return judged


def _find_pairs(judged: JudgedScene) -> Work[None]:
    scene = judged.scene
    region = scene.camera.region
    wanted = np.zeros(region.width * region.height, bool)
    wanted[judged.chosen] = True
    made = yield from plan(scene, Settings(Method.CERTIFIED), reach=0.0)
    for share, own in candidates(made, region, wanted):
        if own is not None and len(own.pixel):
            clip = scene.camera.clip_start, scene.camera.clip_end
            truth = known(*arrays(judged.rays, own.pixel, own.corners), *clip)
            judged.pairs.append(own)
            _mark_boundary(judged, own, truth)
        yield Progress(0.5 + 0.5 * share)


def _mark_boundary(judged: JudgedScene, some: Pairs, truth: Known) -> None:
    """Enter which pixels are near an edge or a tie, by these pairs."""
    seen = judged.t[some.pixel]
    with np.errstate(invalid="ignore"):
        hidden = truth.t - truth.t_allowed > seen
        near = np.abs(truth.t - seen) <= 2 * truth.t_allowed
    judged.near_edge[some.pixel[truth.doubt & ~hidden]] = True
    other = (some.instance != judged.instance[some.pixel]) | (
        some.triangle != judged.triangle[some.pixel]
    )
    judged.near_tie[some.pixel[truth.hit & near & other]] = True


def _near_planes(scene: Scene, rays: Rays, seen: Array, planes: Hits) -> Bools:
    """Return where an infinite plane is as near as what is seen, within rounding."""
    near = np.zeros(len(seen), bool)
    for p in scene.planes:
        with np.errstate(all="ignore"):
            low, high = plane_fractions(rays, p.point[:, None], p.normal[:, None]).interval()
            near |= (low <= seen * (1 + _ALIKE)) & (high >= seen * (1 - _ALIKE))
    return near & (planes.instance != NOTHING) & (seen != planes.t)

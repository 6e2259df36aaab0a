"""Fits an object to a picture: where it is, or how large."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np

from ...arrays import Bools, Floats
from ...causes.case import Case
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Instance, Scene
from ...tracer.progress import Work
from ...tracer.vector import transform_points
from ..evidence import Evidence
from .climbing import values_of
from .fault import Numbers, Values, instances_named, with_instances
from .fitting import FINER, FOUND, NEARLY, Fit
from .looked import Looked
from .matching import Fitted, fitted, matches
from .search import Search

FINEST = 1 / 128  # pixels
FIRST = 1 / 4  # of the object's width: the first step
SMALL = 6.0  # pixels
TRIED = 2  # objects that are fitted
NEAR_STEP = 0.5  # pixels: the first step from where edges are found


def moved(instance: Instance, x: float, y: float, z: float) -> Instance:
    """Translate an instance by (x, y, z) m in world space."""
    matrix = instance.world_from_object.copy()
    matrix[:3, 3] += (x, y, z)
    return replace(instance, world_from_object=matrix)


@dataclass(frozen=True, eq=False)
class Sized(Numbers):
    """An object of another size, about one of the points of `ABOUT`."""

    about: int = 0


# The point that stays: the object's origin, the middle of its base, its middle.
ABOUT = "", ", about the middle of its base", ", about its middle"


def sized(scene: Scene, name: str, factor: float, about: int) -> Scene:
    """Scale an object's instances, each about its own point."""

    def scaled(instance: Instance) -> Instance:
        matrix, point = instance.world_from_object.copy(), _staying(scene, instance, about)
        matrix[:3, :3] *= factor
        matrix[:3, 3] = point + factor * (matrix[:3, 3] - point)
        return replace(instance, world_from_object=matrix)

    return with_instances(scene, name, scaled)


def _staying(scene: Scene, instance: Instance, about: int) -> Floats:
    """Return the point of `ABOUT` of an instance, (3,) in the world."""
    matrix = instance.world_from_object
    corners = np.array(list(product(*scene.meshes[instance.mesh].bounds.T)))
    low, high = (f(transform_points(matrix, corners.T), axis=1) for f in (np.min, np.max))
    middle = (low + high) / 2
    return (matrix[:3, 3].copy(), np.array((*middle[:2], low[2])), middle)[about]


def copied(case: Case, guess: Numbers) -> Case:
    """Return the case with a translated copy of an object's instances."""

    def twice(scene: Scene) -> Scene:
        own = instances_named(scene, guess.object)
        more = (moved(scene.instances[n], *guess.values) for n in own)
        return replace(scene, instances=(*scene.instances, *more))

    return case.with_scenes(twice)


@dataclass(frozen=True)
class Pose:
    """A change of an object in a few numbers, to be fitted."""

    change: Callable[[Scene, Values], Scene | None]  # of a scene with the object alone
    axes: Floats  # changes of the numbers that move the object by about a pixel, (m, k) columns
    starts: list[Values]
    unseen: Floats | None = None  # changes of the numbers that change nothing, (m, j) columns
    # The camera that sees the unchanged object as it looks after the change.
    camera: Callable[..., Camera | None] | None = None
    origin: float = 0.0  # the numbers of no change


def _placed(looked: Looked) -> Pose:
    """Return the translation of an object, along the world's axes."""
    axes, start, unseen = looked.axes(), looked.start(), None
    if looked.evidence.case.scene.camera.projection is ORTHOGRAPHIC:  # nearer looks the same
        axes, start, unseen = axes[:, :2], start[:2], axes[:, 2:]

    def change(scene: Scene, values: Values) -> Scene:
        return with_instances(scene, "", lambda instance: moved(instance, *values))

    # Where its middle moved by little, its edges would have been found.
    far = np.abs(start[:2]).max() >= SMALL or looked.kept
    starts = [values_of(axes @ start)] if far else []
    return Pose(change, axes, starts, unseen, _moved_against)


def _moved_against(camera: Camera, *by: float) -> Camera:
    """Translate a camera against (x, y, z) m, as if the world moved by it."""
    matrix = camera.world_from_camera.copy()
    matrix[:3, 3] -= by
    return replace(camera, world_from_camera=matrix)


def _nearer(point: Floats, camera: Camera, factor: float) -> Camera | None:
    """Return the camera that sees all as a camera sees it scaled by a factor about a point."""
    if factor <= 0:
        return None
    matrix = camera.world_from_camera.copy()
    matrix[:3, 3] = point + (matrix[:3, 3] - point) / factor
    near = 1 / factor if camera.projection is ORTHOGRAPHIC else 1.0
    return replace(camera, world_from_camera=matrix, window=camera.window.scaled(near, near))


def _sized(about: int) -> Callable[[Looked], Pose]:
    """Return a function that returns the scale of an object about one of the points."""

    def of(looked: Looked) -> Pose:
        unit = 2 / max(looked.width, 2.0)

        def change(scene: Scene, values: Values) -> Scene | None:
            return sized(scene, "", values[0], about) if values[0] > 0 else None

        point = _staying(looked.alone, looked.alone.instances[0], about)
        view = partial(_nearer, point)
        return Pose(change, np.array([[unit]]), [(looked.growth,), (1.0,)], None, view, 1.0)

    return of


def _matched(looked: Looked, pose: Pose) -> Fitted | None:
    """Return the change with which the object's edges are where the picture has them."""
    if not pose.camera:
        return None
    evidence, view = looked.evidence, pose.camera
    own = evidence.case.scene.camera
    for about in (tuple(looked.start()[:2]), (0.0, 0.0)):
        found = fitted(
            matches(evidence, looked.name, looked.seen, about),
            lambda units: view(own, *(pose.origin + pose.axes @ units)),
            pose.axes.shape[1],
        )
        if found and found.share >= FOUND:
            return found
    return None


def posing(of: Callable[[Looked], Pose], kept: bool = False) -> Fit:
    """Return how a pose of each suspect is fitted; with `kept`, of a second copy of it."""

    def refine(evidence: Evidence, guess: Numbers) -> Work[Numbers | None]:
        looked = yield from Looked.of(evidence, guess.object, kept)
        if looked is None:
            return None
        pose = of(looked)
        alone = looked.alone

        def right(values: Values) -> Work[Bools | None]:
            changed = pose.change(alone, values)
            return None if changed is None else (yield from looked.right(changed))

        starts, step, axes = pose.starts, FIRST * looked.width, pose.axes
        if axes.shape[1] == 1:  # a single number: in finer steps
            step /= 4
        if pose.camera and not kept:
            found, moves = _matched(looked, pose), _matched(looked, _placed(looked))
            if moves and not (found and found.share >= NEARLY * moves.share):
                return None
            if found:
                starts, step = [values_of(pose.origin + axes @ found.units)], NEAR_STEP
                axes = axes @ found.axes
        fine = bool(guess.low)
        if guess.values:
            starts, step = [guess.values], FINER if fine else 1.0
        if not starts:
            return None
        least = 0.0 if guess.values else looked.least_right
        search = Search(right, axes, FINEST, least, pose.unseen)
        return (yield from search.guess(starts, step, guess.object, enclose=fine))

    def find(evidence: Evidence) -> Work[list[Numbers]]:
        out = []
        for name in evidence.suspects[:TRIED]:
            guess = yield from refine(evidence, Numbers(object=name))
            if guess:
                out.append(guess)
        return out

    return Fit(find, refine)


MOVED, TWICE = posing(_placed), posing(_placed, kept=True)
_SCALED = [posing(_sized(about)) for about in range(len(ABOUT))]


def about_point(guess: Numbers, about: int = 0) -> Sized:
    """Return a guess of a size with the point that stays."""
    numbers = guess.values, guess.low, guess.high
    return Sized(*numbers, object=guess.object, words=ABOUT[about], about=about)


def find_sizes(evidence: Evidence) -> Work[list[Sized]]:
    """Fit the size of each suspect, about each of the points."""
    out = []
    for about, fit in enumerate(_SCALED):
        found = yield from fit.find(evidence)
        out += [about_point(guess, about) for guess in found]
    return out


def refine_size(evidence: Evidence, guess: Sized) -> Work[Sized | None]:
    """Fit a size finely, about the same point."""
    found = yield from _SCALED[guess.about].refine(evidence, guess)
    return about_point(found, guess.about) if found else None

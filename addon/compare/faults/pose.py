"""Fits an object to a picture: where it is, how large, or how far its surface is displaced.

What is behind the object is traced once, without it; then the object alone, for each guess.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Bools, Floats, Places
from ...projections import ORTHOGRAPHIC
from ...scene import Instance, Mesh, Scene
from ...tracer.camera import camera_rays, pixel_size
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING, Hits
from ...tracer.nearest import plan
from ...tracer.progress import Work
from ...tracer.vector import cross
from ..bounds import largest_within
from ..case import Case
from ..checks.probe import SOUND, Probe
from ..evidence import WORTH, Evidence, shows_colors, spread
from ..picture import Picture
from .fault import Find, Guess, Refine, instances_named
from .search import Search, Values

AROUND = 6  # pixels around the object, on both sides, in which it is looked at, too
FINEST = 1 / 128  # pixels
FIRST = 1 / 4  # of the object's width: the first step
SMALL = 6.0  # pixels
TRIED = 2  # objects that are fitted


def moved(instance: Instance, x: float, y: float, z: float) -> Instance:
    """Return an instance at another place, (x, y, z) m away in world space."""
    matrix = instance.world_from_object.copy()
    matrix[:3, 3] += (x, y, z)
    return replace(instance, world_from_object=matrix)


def scaled(instance: Instance, factor: float) -> Instance:
    """Return an instance as many times as large, about its object's origin."""
    matrix = instance.world_from_object.copy()
    matrix[:3, :3] *= factor
    return replace(instance, world_from_object=matrix)


def copied(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case with an object's instances a second time, somewhere else."""

    def twice(scene: Scene) -> Scene:
        own = instances_named(scene, guess.object)
        more = (moved(scene.instances[n], *guess.values) for n in own)
        return replace(scene, instances=(*scene.instances, *more))

    return case.with_scenes(twice)


def inflated(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case with an object's vertices displaced along their smooth normals."""

    def displaced(scene: Scene) -> Scene:
        own = {scene.instances[n].mesh for n in instances_named(scene, guess.object)}
        meshes = [
            _displaced(mesh, *guess.values) if n in own else mesh
            for n, mesh in enumerate(scene.meshes)
        ]
        return replace(scene, meshes=tuple(meshes))

    return case.with_scenes(displaced)


def _displaced(mesh: Mesh, distance: float) -> Mesh:
    """Displace vertices along the mean of their triangles' normals, each weighed by its area."""
    vertices = mesh.vertices.astype(np.float64)
    a, b, c = (vertices[mesh.triangles[:, k]].T for k in range(3))
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, mesh.triangles[:, k], cross(b - a, c - a).T)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return replace(mesh, vertices=vertices + distance * normals / np.where(length > 0, length, 1))


@dataclass(frozen=True, eq=False)
class _Looked:
    """An object in a picture: the pixels in which it is looked for, and what is behind it."""

    evidence: Evidence
    name: str
    at: tuple[Places, Places]  # rows and columns of the n pixels
    picture: Picture  # of these
    behind: Hits  # what is hit there without the object
    rest: Scene  # without it
    seen: Bools  # (h, w) where it is traced
    shown: Bools  # (h, w) where the picture shows it, as far as is known
    depth: float  # of the object, metres
    kept: bool  # whether it stays at its place, too

    @classmethod
    def of(cls, evidence: Evidence, name: str, kept: bool = False) -> Work[_Looked | None]:
        """Look at an object; None if it is not seen or not shown."""
        scene, frame = evidence.case.scene, evidence.frame
        own = instances_named(scene, name)
        seen = np.isin(frame.instance_index, own)
        shown = _shown(evidence, own) & (evidence.open | seen)
        if kept:
            shown &= ~seen
        if not seen.any() or not shown.any():
            return None
        around = largest_within((seen | shown).astype(np.int8), AROUND) > 0
        chosen = np.zeros_like(seen)
        for some in (around & evidence.open, around & ~evidence.open):
            chosen.flat[spread(some, evidence.size // 2)] = True
        rows, columns = np.nonzero(chosen)
        at = rows, columns
        left = [i for n, i in enumerate(scene.instances) if kept or n not in own]
        rest = replace(scene, instances=tuple(left))
        depth = float(np.median(frame.t[seen]))
        picture = evidence.picture.at(at)
        out = cls(evidence, name, at, picture, Hits.none(0), rest, seen, shown, depth, kept)
        behind = yield from out.traced(rest)
        return replace(out, behind=behind)

    def traced(self, scene: Scene) -> Work[Hits]:
        """Return what the n pixels see of a scene."""
        wanted = np.zeros(self.seen.shape, bool)
        wanted[self.at] = True
        made = yield from plan(scene, SOUND, 0.0)
        probe = yield from Probe.of(made, scene.camera.region, wanted.ravel())
        return (yield from probe.trace())

    @property
    def alone(self) -> Scene:
        """The scene with the object alone."""
        scene = self.evidence.case.scene
        own = instances_named(scene, self.name)
        return replace(scene, instances=tuple(scene.instances[n] for n in own), planes=())

    def right(self, changed: Scene) -> Work[int]:
        """Return how many of the n pixels are right with the object as a scene has it alone."""
        hits = yield from self.traced(changed)
        before = (hits.instance != NOTHING) & (hits.t < self.behind.t)
        shown = self._agree(self.rest, self.behind, ~before) | self._agree(changed, hits, before)
        return int(shown.sum())

    def _agree(self, scene: Scene, hits: Hits, where: Bools) -> Bools:
        """Return which of the n pixels, of those where it is seen, show the hits of a scene."""
        out = np.zeros(len(where), bool)
        here = np.flatnonzero(where)
        case = self.evidence.case.in_scene(scene)
        picture = replace(
            self.picture.at(here), owners=case.picture.owners, colorless=case.colorless
        )
        out[here] = ~picture.differ(scene, hits.take(here))
        return out

    @property
    def least_right(self) -> float:
        """How many of the n pixels must be right for a guess to be worth a closer look."""
        open_ = self.evidence.open[self.at]
        return float((~open_).sum() + WORTH * open_.sum())

    @property
    def pixel(self) -> float:
        """The width of a pixel at the object, in metres."""
        camera = self.evidence.case.scene.camera
        return pixel_size(camera)[0] * camera.projection.scale(self.depth)

    @property
    def growth(self) -> float:
        """How many times as wide the object is shown as it is traced."""
        return float(np.sqrt(int(self.shown.sum()) / int(self.seen.sum())))

    def start(self) -> Floats:
        """Return about where the object is shown: right, up, forward, in units of pixels."""
        rows, columns = (np.mean(v) for v in np.nonzero(self.shown))
        own_rows, own_columns = (np.mean(v) for v in np.nonzero(self.seen))
        forward = (1 / self.growth - 1) * self._depth_units
        return np.array((columns - own_columns, rows - own_rows, forward))

    @property
    def width(self) -> float:
        """About how wide the object is seen, in pixels."""
        return float(np.sqrt(self.seen.sum()))

    @property
    def _depth_units(self) -> float:
        """The object's depth in units that change its size by about a pixel."""
        return max(self.width / 2, 1.0)

    def axes(self) -> Floats:
        """Return what a unit of right, up and away is in world space, (3, 3) columns.

        Away is along the ray through the object's middle, so that it changes the size alone.
        """
        camera = self.evidence.case.scene.camera
        rows, columns = (float(np.mean(v)) + 0.5 for v in np.nonzero(self.seen))
        r = camera.region
        ray = camera_rays(camera, np.array([columns + r.x0]), np.array([rows + r.y0]))
        away = self.depth / self._depth_units * ray.directions[:, 0]
        return np.stack((self.pixel * camera.right, self.pixel * camera.up, away), axis=1)


def _shown(evidence: Evidence, own: list[int]) -> Bools:
    """Return where (h, w) a picture shows some instances, by their object or their colours."""
    picture, scene = evidence.picture, evidence.case.scene
    if picture.owner is not None and picture.owners is not None:
        return np.isin(picture.owner, picture.owners[own])
    first, last = scene.color_rows[:, own]
    rows = np.unique(
        np.concatenate([np.arange(a, b + 1) for a, b in zip(first, last, strict=True)])
    )
    return shows_colors(picture, scene.color_table[rows])


@dataclass(frozen=True)
class Pose:
    """What is fitted of an object: a change of it in a few numbers."""

    change: Callable[[Scene, Values], Scene | None]  # of a scene with the object alone
    axes: Floats  # the numbers that a unit, about a pixel, of each stands for, (m, k) columns
    starts: list[Values]  # in units


def _placed(looked: _Looked) -> Pose:
    """Return the object at another place; its numbers are along the world's axes."""
    axes, start = looked.axes(), looked.start()
    if looked.evidence.case.scene.camera.projection is ORTHOGRAPHIC:  # nearer looks the same
        axes, start = axes[:, :2], start[:2]

    def change(scene: Scene, values: Values) -> Scene:
        return replace(scene, instances=tuple(moved(i, *values) for i in scene.instances))

    beside = np.append(start[:2], 0)[: len(start)]
    starts = [start, beside]
    if np.abs(start).max() < SMALL:  # then its middle says little
        starts.append(0 * start)
    return Pose(change, axes, [tuple(v.tolist()) for v in starts])


def _sized(looked: _Looked) -> Pose:
    """Return the object as many times as large."""
    unit = 2 / max(looked.width, 2.0)

    def change(scene: Scene, values: Values) -> Scene | None:
        if values[0] <= 0:
            return None
        return replace(scene, instances=tuple(scaled(i, *values) for i in scene.instances))

    return Pose(change, np.array([[unit]]), [(looked.growth / unit,), (1 / unit,)])


def _inflated(looked: _Looked) -> Pose:
    """Return the object with a displaced surface."""
    scene = looked.evidence.case.scene
    matrix = scene.instances[instances_named(scene, looked.name)[0]].world_from_object
    size = float(np.cbrt(abs(np.linalg.det(matrix[:3, :3])))) or 1.0
    start = (looked.growth - 1) * looked.width / 2

    def change(scene: Scene, values: Values) -> Scene:
        used = {i.mesh for i in scene.instances}
        meshes = [_displaced(m, *values) if n in used else m for n, m in enumerate(scene.meshes)]
        return replace(scene, meshes=tuple(meshes))

    return Pose(change, np.array([[looked.pixel / size]]), [(start,), (0.0,)])


def posing(of: Callable[[_Looked], Pose], kept: bool = False) -> tuple[Find, Refine]:
    """Return what finds how objects that are suspected are shown, and what fits it finely.

    `kept` says that each object stays at its place, too.
    """

    def refine(evidence: Evidence, guess: Guess) -> Work[Guess | None]:
        looked = yield from _Looked.of(evidence, guess.object, kept)
        if looked is None:
            return None
        pose = of(looked)

        def right(units: Values) -> Work[int]:
            changed = pose.change(looked.alone, tuple((pose.axes @ units).tolist()))
            return -1 if changed is None else (yield from looked.right(changed))

        starts, step = pose.starts, FIRST * looked.width
        if len(starts[0]) == 1:  # of which more are looked at on each side
            step /= 4
        if guess.values:
            starts, step = [tuple((np.linalg.pinv(pose.axes) @ guess.values).tolist())], 1.0
        least = 0.0 if guess.values else looked.least_right
        search = Search(right, (1.0,) * len(starts[0]), FINEST, least)
        found = yield from search.guess(starts, step, guess.object)
        return found and _in_numbers(found, pose.axes)

    def find(evidence: Evidence) -> Work[list[Guess]]:
        out = []
        for name in evidence.suspects[:TRIED]:
            guess = yield from refine(evidence, Guess(object=name))
            if guess:
                out.append(guess)
        return out

    return find, refine


def _in_numbers(guess: Guess, axes: Floats) -> Guess:
    """Return a guess in units as one in the numbers that these stand for."""
    values = axes @ guess.values
    free = np.abs(axes) @ (np.subtract(guess.high, guess.low) / 2)
    low, high = values - free, values + free
    return replace(
        guess, values=tuple(values.tolist()), low=tuple(low.tolist()), high=tuple(high.tolist())
    )


MOVED, TWICE = posing(_placed), posing(_placed, kept=True)
SCALED, DISPLACED = posing(_sized), posing(_inflated)

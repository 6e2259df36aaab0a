"""An object in the picture: where it is traced, where it is shown, and what is behind it.

What is behind is traced once, without the object; then the object alone, for each guess.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...arrays import Bools, Floats, Places
from ...pictures.bounds import largest_within
from ...pictures.picture import Picture
from ...scene import Scene, without
from ...tracer.camera import camera_rays, pixel_size
from ...tracer.hits import NOTHING, Hits
from ...tracer.progress import Work
from ..evidence import WORTH, Evidence, shows_colors, spread
from .fault import instances_named

AROUND = 6  # pixels around the object, on both sides, that are compared, too


@dataclass(frozen=True, eq=False)
class Looked:
    """An object in the picture: the pixels in which it is searched, and what is behind it."""

    evidence: Evidence
    name: str
    at: tuple[Places, Places]  # rows and columns of the n pixels
    picture: Picture  # of these
    behind: Hits  # of these, without the object
    rest: Scene  # without the object
    seen: Bools  # (h, w) where it is traced
    shown: Bools  # (h, w) where the picture shows it, as far as is known
    around: Bools  # (h, w) both, and AROUND pixels beside them
    depth: float  # of the object, metres
    kept: bool  # whether it stays at its place, too

    @classmethod
    def of(cls, evidence: Evidence, name: str, kept: bool = False) -> Work[Looked | None]:
        """Gather what is known of an object (cached); None if it can settle few pixels."""
        key = f"looked {name} {kept} {evidence.size} {evidence.fine}"
        return (yield from evidence.done_once(key, cls._of(evidence, name, kept)))

    @classmethod
    def _of(cls, evidence: Evidence, name: str, kept: bool) -> Work[Looked | None]:
        scene, frame = evidence.case.scene, evidence.frame
        own = instances_named(scene, name)
        if not own:  # an infinite plane
            return None
        seen = np.isin(frame.instance_index, own)
        shown = _shown(evidence, own) & (evidence.unexplained | seen)
        if kept:
            shown &= ~seen
        if not seen.any() or not shown.any():
            return None
        around = largest_within(seen | shown, AROUND)
        chosen = np.zeros_like(seen)
        where = around & evidence.beside_edges if evidence.fine else around
        for some in (where & evidence.unexplained, where & ~evidence.unexplained):
            chosen.flat[spread(some, evidence.size // 2)] = True
        rows, columns = np.nonzero(chosen)
        at = rows, columns
        rest = scene if kept else without(scene, [name])
        depth = float(np.median(frame.t[seen]))
        picture = evidence.picture.at(at)
        behind = yield from evidence.trace(rest, at)
        out = cls(evidence, name, at, picture, behind, rest, seen, shown, around, depth, kept)
        return out if out._may_settle >= WORTH * evidence.unexplained.sum() else None

    @property
    def alone(self) -> Scene:
        """The scene with the object alone."""
        scene = self.evidence.case.scene
        return only(scene, instances_named(scene, self.name))

    def right(self, changed: Scene) -> Work[Bools]:
        """Return which of the n pixels are right with the object as a scene has it, (n,)."""
        hits = yield from self.evidence.trace(changed, self.at)
        before = (hits.instance != NOTHING) & (hits.t < self.behind.t)
        return (self._beneath & ~before) | self._agree(changed, hits, before)

    @property
    def _may_settle(self) -> float:
        """How many unexplained pixels may agree: they show the object, or what is behind it."""
        unexplained, may = self.evidence.unexplained[self.at], self._beneath | self.shown[self.at]
        share = float(np.mean(may[unexplained])) if unexplained.any() else 0.0
        return share * int((self.around & self.evidence.unexplained).sum())

    @cached_property
    def _beneath(self) -> Bools:
        """The pixels, among n, that show what is behind the object."""
        return self._agree(self.rest, self.behind, np.ones(len(self.behind), bool))

    def _agree(self, scene: Scene, hits: Hits, where: Bools) -> Bools:
        """Return which of the n pixels are in a mask and agree with the hits of a scene."""
        out = np.zeros(len(where), bool)
        here = np.flatnonzero(where)
        case = replace(self.evidence.case, picture=self.picture.at(here)).in_scene(scene)
        picture = replace(case.picture, colorless=case.colorless)
        out[here] = ~picture.differ(scene, hits.take(here))
        return out

    @property
    def least_right(self) -> float:
        """How many of the n pixels must be right for a guess to be worth a closer look."""
        unexplained = self.evidence.unexplained[self.at]
        return float((~unexplained).sum() + WORTH * unexplained.sum())

    @property
    def is_left(self) -> bool:
        """Whether the object is not shown where it is traced: it may be far from there."""
        return bool(self.evidence.unexplained[self.seen].mean() >= WORTH)

    @property
    def growth(self) -> float:
        """The width of the object as shown, relative to that as traced."""
        return float(np.sqrt(int(self.shown.sum()) / int(self.seen.sum())))

    def displacement(self) -> Floats:
        """Estimate how many pixels to the right and up the object is shown, (2,)."""
        rows, columns = (np.mean(v) for v in np.nonzero(self.shown))
        own_rows, own_columns = (np.mean(v) for v in np.nonzero(self.seen))
        return np.array((columns - own_columns, rows - own_rows))

    def start(self, depth: float) -> Floats:
        """Return the displacement so many times as far away, in units right, up and away."""
        return np.array((*self.displacement(), (depth - 1) * self._depth_units))

    @property
    def width(self) -> float:
        """The approximate width of the object in the traced picture, in pixels."""
        return float(np.sqrt(self.seen.sum()))

    @property
    def _depth_units(self) -> float:
        """The object's depth in units that change its size by about a pixel."""
        return max(self.width / 2, 1.0)

    def axes(self) -> Floats:
        """Return the units right, up and away in world space, (3, 3) columns.

        Away is along the ray through the middle of what is shown: it changes the size alone.
        """
        camera = self.evidence.case.scene.camera
        rows, columns = (float(np.mean(v)) + 0.5 for v in np.nonzero(self.shown))
        r = camera.region
        ray = camera_rays(camera, np.array([columns + r.x0]), np.array([rows + r.y0]))
        away = self.depth / self._depth_units * ray.directions[:, 0]
        width, height = (v * camera.projection.scale(self.depth) for v in pixel_size(camera))
        return np.stack((width * camera.right, height * camera.up, away), axis=1)


def _shown(evidence: Evidence, own: list[int]) -> Bools:
    """Return which pixels (h, w) of a picture show some instances, by object or colour."""
    picture, scene = evidence.picture, evidence.case.scene
    if picture.owners:
        return np.isin(picture.owners.pixels, picture.owners.instances[own])
    return shows_colors(picture, only(scene, own).color_table[:-1])


def only(scene: Scene, own: list[int]) -> Scene:
    """Return the scene with some instances alone."""
    return replace(scene, instances=tuple(scene.instances[n] for n in own), planes=())

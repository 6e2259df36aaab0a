"""The tracer's own sweep, which also notes what it looks at and what it leaves out.

`draw_culling.py` draws and counts that.
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from unittest import mock

import numpy as np
from numpy.typing import NDArray
from reference_tracer.certainty import Certainty
from reference_tracer.certified.sweep import sweep
from reference_tracer.certified.sweep.boxes import boxes_of
from reference_tracer.certified.sweep.chunks import Expanded
from reference_tracer.certified.sweep.depth_buffer import DepthBuffer, Fragments
from reference_tracer.certified.sweep.edge_functions import EdgeFunctions
from reference_tracer.certified.sweep.film import Film
from reference_tracer.certified.sweep.rasterise import Boxes, Covered
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer import render
from reference_tracer.tracer.hits import Statistics
from reference_tracer.tracer.progress import quiet, result_of
from reference_tracer.tracer.settings import Settings


@dataclass(frozen=True, eq=False)
class Look:
    """Triangles that were looked at together: their boxes, and which were `open`, not hidden.

    `seen` is which pixels had a sure hit before.
    """

    boxes: Boxes
    nearest: NDArray[np.float64]
    open: NDArray[np.integer]
    seen: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Tested:
    """EdgeFunctions that were evaluated together, what hid them, and their fragments."""

    found: EdgeFunctions
    boxes: Boxes
    depths: DepthBuffer
    fragments: list[Fragments] = field(default_factory=list)


class Watched(sweep.Sweep):
    """A sweep that counts; and, where `closely`, remembers what can be drawn."""

    def __init__(
        self,
        scene: Scene,
        film: Film,
        region: Region,
        statistics: Statistics,
        closely: bool = False,
    ) -> None:
        super().__init__(scene, film, region, statistics)
        self._closely = closely
        self.bounds: list[NDArray] = []  # how far from an edge is sure, in pixels
        self.looks: list[Look] = []
        self.tested: list[Tested] = []
        self.expanded: list[Expanded] = []
        self.found_boxes: list[tuple[NDArray, NDArray]] = []  # of the expanded, lowest and highest

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Which pixels have a sure hit by now, (height, width)."""
        region = self._depths.region
        grid = self._depths.nearness.reshape(-1, self._depths.stride)
        return grid[: region.height, : region.width] > -np.inf

    def numbers(self, fragments: Fragments) -> NDArray[np.integer]:
        """Return the pixels of fragments, numbered row by row from the lowest."""
        return self._depths.pixels(fragments.pixel)

    def not_hidden(self, low: NDArray, high: NDArray, nearest: NDArray) -> NDArray[np.integer]:
        found = super().not_hidden(low, high, nearest)
        if self._closely:
            boxes = Boxes(np.arange(len(nearest)), low, high)
            self.looks.append(Look(boxes, nearest, found, self.seen))
        return found

    def pairs(self, found: EdgeFunctions, boxes: Boxes) -> Iterator[Covered]:
        _, of_y, of_x = found.coefficients[:, :3]
        self.bounds.append(found.edge_error / np.hypot(of_x, of_y).min(axis=0))
        if self._closely:  # the depth buffer as it is now: it goes on changing
            self.tested.append(Tested(found, boxes, deepcopy(self._depths)))
        return super().pairs(found, boxes)

    def of_pairs(self, pairs: Covered, surface: NDArray) -> Fragments:
        fragments = super().of_pairs(pairs, surface)
        if self._closely:
            self.tested[-1].fragments.append(fragments)
        return fragments


def _none_small() -> mock._patch:
    """Let all triangles go the way that can be drawn, which finds the same."""
    return mock.patch.object(sweep, "are_small", lambda *given: np.zeros(len(given[-1]), bool))


def watch(scene: Scene) -> Watched:
    """Sweep a small scene, which is one chunk, closely."""
    region = scene.camera.region
    swept = Watched(scene, Film(scene.camera), region, Statistics(), closely=True)

    def found(scene: Scene, film: Film, expanded: Expanded) -> tuple[NDArray, NDArray, NDArray]:
        low, high, nearest = boxes_of(scene, film, expanded)
        swept.expanded.append(expanded)
        swept.found_boxes.append((low, high))
        return low, high, nearest

    with _none_small(), mock.patch.object(sweep, "boxes_of", found):
        for _ in quiet(swept.steps(Settings().memory)):
            pass
    return swept


def count(scene: Scene) -> tuple[Statistics, NDArray[np.float64]]:
    """Sweep a scene in bands, as ever; returns its counts, and how far from an edge is sure."""
    settings, statistics, bounds = Settings("certified"), Statistics(), []
    statistics.triangles = scene.triangle_count
    for band in render.bands(scene.camera, settings):
        swept = Watched(scene, Film(scene.camera), band, statistics)
        with _none_small():
            hits = result_of(quiet(swept.steps(settings.memory // 2)))
        statistics.culling["by_integers"] += int((hits.certainty != Certainty.BOUND).sum())
        bounds += swept.bounds
    return statistics, np.concatenate(bounds)

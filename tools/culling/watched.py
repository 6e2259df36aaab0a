"""The sweep, watched: the tracer's own, which also writes down what it looked at, and what it left.

In comes a scene; out go, as each class here says, what `draw_culling.py` draws and counts.
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass, field
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer import render
from reference_tracer.tracer.certified.certainty import Certainty
from reference_tracer.tracer.certified.sweep import sweep
from reference_tracer.tracer.certified.sweep.chunks import Expanded
from reference_tracer.tracer.certified.sweep.depth_buffer import DepthBuffer
from reference_tracer.tracer.certified.sweep.edge_functions import Footprints
from reference_tracer.tracer.certified.sweep.film import Film
from reference_tracer.tracer.certified.sweep.fragments import Kept
from reference_tracer.tracer.certified.sweep.rasterise import Boxes, Covered
from reference_tracer.tracer.certified.sweep.verdict import Verdict
from reference_tracer.tracer.hits import Hits, Statistics
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
    """Footprints that were evaluated together, what hid them, and the pairs that were kept."""

    found: Footprints
    boxes: Boxes
    depths: DepthBuffer
    kept: list[Kept] = field(default_factory=list)


@dataclass
class Counts:
    """What became of a picture's triangles and pixels."""

    width: int = 0
    height: int = 0
    triangles: int = 0
    boxed: int = 0  # triangles whose box holds the centre of a pixel
    reached: int = 0  # of them, not dropped as a whole: some pixel was computed
    computed: int = 0  # pixels of boxes and of cells, in which the four functions were computed
    pairs: int = 0  # of them, not surely outside an edge
    left: int = 0  # pixels that the sweep did not decide
    by_numbers: int = 0  # of them, by integers or by the rule of ties
    bounds: list[NDArray] = field(default_factory=list)  # how far from an edge is sure, in pixels

    @property
    def pixels(self) -> int:
        return self.width * self.height


class Watched(sweep.Sweep):
    """A sweep that counts; and, where `closely`, remembers what can be drawn."""

    def __init__(
        self,
        scene: Scene,
        film: Film,
        region: Region,
        statistics: Statistics,
        counts: Counts | None = None,
        closely: bool = False,
    ) -> None:
        super().__init__(scene, film, region, statistics)
        self.counts, self._closely = counts or Counts(), closely
        self.looks: list[Look] = []
        self.tested: list[Tested] = []
        self.expanded: list[Expanded] = []
        self.boxes: list[tuple[NDArray, NDArray]] = []  # of the expanded, lowest and highest

    @property
    def seen(self) -> NDArray[np.bool_]:
        """Which pixels have a sure hit by now, (height, width)."""
        region = self._depths.region
        grid = self._depths.nearness.reshape(-1, self._depths.stride)
        return grid[: region.height, : region.width] > -np.inf

    def numbers(self, kept: Kept) -> NDArray[np.integer]:
        """Which pixels pairs are of, row by row from the lowest."""
        return self._depths.pixels(kept.pixel)

    def _boxes(self, expanded: Expanded) -> tuple[NDArray, NDArray, NDArray]:
        low, high, nearest = super()._boxes(expanded)
        if self._closely:
            self.expanded.append(expanded)
            self.boxes.append((low, high))
        return low, high, nearest

    def _not_hidden(self, boxes: Boxes, nearest: NDArray) -> NDArray[np.integer]:
        found = super()._not_hidden(boxes, nearest)
        self.counts.boxed += len(nearest)
        if self._closely:
            self.looks.append(Look(boxes, nearest, found, self.seen))
        return found

    def _pairs(self, found: Footprints, boxes: Boxes, shape: NDArray) -> Iterator[Covered]:
        _, of_y, of_x = found.coefficients[:, :3]
        self.counts.bounds.append(found.edge_error / np.hypot(of_x, of_y).min(axis=0))
        if self._closely:  # the depth buffer as it is now: it goes on changing
            own = boxes.take(found.row)
            each = Boxes(np.arange(len(found.row)), own.low, own.high)
            self.tested.append(Tested(found, each, deepcopy(self._depths)))
        return super()._pairs(found, boxes, shape)

    def _keep_pairs(self, found: Footprints, pairs: Covered, surface: NDArray) -> Kept:
        kept = super()._keep_pairs(found, pairs, surface)
        if self._closely:
            self.tested[-1].kept.append(kept)
        return kept


def watch(scene: Scene) -> Watched:
    """Sweep a small scene, which is one chunk, closely."""
    region = scene.camera.region
    swept = Watched(scene, Film(scene.camera), region, Statistics(), closely=True)
    for _ in sweep.quiet(swept.steps(sweep._TRIANGLES)):
        pass
    return swept


def count(scene: Scene) -> Counts:
    """Trace a scene as ever, and count."""
    region = scene.camera.region
    counts = Counts(region.width, region.height, scene.triangle_count)
    statistics = Statistics()
    covered, reached = sweep.covered, np.zeros(0, bool)
    last: Footprints | None = None

    def computing(
        found: Footprints, boxes: Boxes, shape: NDArray, depths: DepthBuffer
    ) -> Iterator[Covered]:
        nonlocal last, reached
        if found is not last:  # the next triangles
            counts.reached += int(reached.sum())
            last, reached = found, np.zeros(len(found.row), bool)
        some = boxes.take(slice(0, len(shape)))
        reached[found.row[some.owner]] = True
        width, height = (some.high - some.low + 1).astype(np.int64)
        counts.computed += int((width * height).sum())
        return covered(found, boxes, shape, depths)

    def left(self: Verdict, hits: Hits, pixel: NDArray, surface: NDArray) -> Iterator:
        counts.left += len(np.unique(pixel))
        return contest(self, hits, pixel, surface)

    contest = Verdict._contest
    with (
        patch.object(Verdict, "_contest", left),
        patch.object(sweep, "Sweep", lambda *given: Watched(*given, counts=counts)),
        patch.object(sweep, "covered", computing),
    ):
        hits = render.trace(scene, Settings("certified"), statistics)
    counts.reached += int(reached.sum())
    counts.pairs = statistics.pairs_tested
    counts.by_numbers = int((hits.certainty != Certainty.BOUND).sum())
    return counts

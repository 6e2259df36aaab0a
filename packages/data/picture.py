"""A picture of data: what differs, by how much, how it is shown, and what may be wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar, Self

import numpy as np
from reference_tracer.arrays import Array, Bools, Colors, Where
from reference_tracer.pictures.metrics import Metrics
from reference_tracer.pictures.picture import Picture
from reference_tracer.scene import Scene
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import Hits

from .kind import Data


@dataclass(frozen=True, eq=False)
class DataPicture(Picture):
    """The other side where it holds depths, normals and so on: its colours are to look at."""

    has_colors: ClassVar[bool] = False
    data: Data = field(kw_only=True)

    def at(self, where: Where) -> Self:
        """Return some of the pixels."""
        return replace(super().at(where), data=self.data.at(where))

    def moved(self, where: Where) -> DataPicture:
        """Return the picture with its pixels in other places, and the rays of these."""
        there = self.at(where)
        raw = None if self.data.raw is None else self.data.raw[where]
        return replace(there, data=replace(there.data, film=self.data.film, raw=raw))

    def shows(self, frame: Frame, rows: slice = slice(None)) -> Bools:
        """Return which of these pixels, some rows, may show what a frame has there, (k, w)."""
        hits = frame.hits(rows)
        same = self.data.flat.same(frame.scene, hits, self.sampling, hits.t)
        return same.reshape(frame.instance_index[rows].shape)

    def sees_apart(self, first: Frame, second: Frame) -> Bools:
        """Return where two frames (h, w) have something else to show in such a picture."""
        with np.errstate(invalid="ignore"):
            out = (first.t != second.t) | (first.object_index != second.object_index)
        return out | (first.triangle_index != second.triangle_index)

    def holds_as(self, other: Picture) -> bool:
        """Return whether another picture holds the same, with the same faults."""
        return isinstance(other, DataPicture) and self.data is other.data

    def same_color(self, scene: Scene, hits: Hits) -> Bools:
        """Return which of n hits may have the values of these n pixels."""
        return self.data.same(scene, hits, self.sampling)

    def measured_with(self, frame: Frame) -> tuple[Colors, Array, Array]:
        """Return a frame as colours to look at, and both sides' values, 0 where nothing is."""
        made, held = self.data.of_frame(frame), self.data.held
        return self.data.shown(made), np.nan_to_num(made), np.nan_to_num(held)

    def as_shown(self, frame: Frame) -> Colors:
        """Return what such a picture of a frame would look like, (h, w, 4)."""
        return self.data.shown(self.data.of_frame(frame))

    def measured(self, metrics: Metrics) -> str:
        """Say how large the error is, without the ratios, which are of colours; of ids, nothing."""
        if self.data.kind.name == "ids":
            return ""
        unit = self.data.kind.unit and f" {self.data.kind.unit}"
        return f"{self.data.kind.words}: RMSE {metrics.rmse:.3g}{unit}"

    @property
    def presumed(self) -> str:
        """What of it is taken to be so, as nobody says it."""
        return self.data.kind.presumed

    def silent(self, frame: Frame) -> str:
        """Say why such a picture says nothing of what is wrong; many a fault can empty one."""
        made, held = self.data.of_frame(frame), self.data.held
        expected = frame.object_index[..., None] if self.data.kind.name == "ids" else made
        if _is_constant(expected) or not _is_constant(held):
            return ""
        same = "are the same in every pixel"
        return f"{self.data.kind.words} {same}: a constant says nothing of what is wrong"

    def faults_of(self, known: Sequence[Any]) -> Sequence[Any]:
        """Return the faults that are looked for: those of data, and those of scenes."""
        from .faults import faults_of_data

        return faults_of_data(known)


def _is_constant(values: Array) -> bool:
    return np.array_equal(values, np.broadcast_to(values[0, 0], values.shape), equal_nan=True)

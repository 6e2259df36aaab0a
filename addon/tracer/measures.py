"""t and the barycentrics of a picture: kept where they are known, else found when asked for."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from .certified.rounding import PIXELS, rounded
from .hits import Hits, LazyHits, Measure, Measured


class Measures:
    """t and the barycentrics of the h x w pixels of the camera's region, whose names are given.

    Parameters
    ----------
    scene : Scene
        That is traced.
    instance, triangle : (h, w) int32
        What the pixels see: a picture's own arrays, which may still be filled.
    """

    def __init__(self, scene: Scene, instance: NDArray, triangle: NDArray) -> None:
        self._scene, self._names = scene, (instance, triangle)
        self._open = np.zeros(len(instance), bool)  # rows that nobody has asked for yet
        self._known = Measured.none()
        self._t: NDArray | None = None
        self._s: NDArray | None = None

    def enter(self, rows: slice, hits: Hits) -> None:
        """Enter what is known of rows whose names are entered; the rest is found when asked for."""
        width = self._names[0].shape[1]
        if isinstance(hits, LazyHits):
            self._open[rows] = True
            self._known = Measured.joined((self._known, hits.known.numbered(rows.start * width)))
        else:
            self._keep(rows, hits.t, hits.s)

    def of(self, rows: slice) -> Measure:
        """Return t (k, w), inf where nothing is hit, and barycentrics (3, k, w) of k rows."""
        for _ in self.steps(rows):
            pass
        return self._t[rows], self._s[:, rows]

    def steps(self, rows: slice) -> Iterator[None]:
        """Find those of some rows that are not known yet, in small steps."""
        height, width = self._names[0].shape
        first, last, _ = rows.indices(height)
        together = max(1, PIXELS // width)
        self._make_room()
        for y in range(first, last, together):
            some = slice(y, min(y + together, last))
            if self._open[some].any():
                region, names = self._scene.camera.region, [v.reshape(-1) for v in self._names]
                ray = np.arange(some.start * width, some.stop * width)
                self._keep(some, *rounded(self._scene, region, names, self._known, ray))
            yield

    def _keep(self, rows: slice, t: NDArray, s: NDArray) -> None:
        self._make_room()
        width = self._t.shape[1]
        self._t[rows], self._s[:, rows] = t.reshape(-1, width), s.reshape(3, -1, width)
        self._open[rows] = False

    def _make_room(self) -> None:
        if self._t is None:
            shape = self._names[0].shape
            self._t, self._s = np.full(shape, np.inf), np.zeros((3, *shape))

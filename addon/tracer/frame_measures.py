"""t and the barycentrics of a picture, each row found on first use."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property, partial

import numpy as np

from ..arrays import Index, Integers
from .hits import FindMeasures, Hits, Measures, Names, no_measures

PIXELS = 1 << 17  # found together: a step of some ten milliseconds
_KNOWN = -1  # of a row whose values are there


class FrameMeasures:
    """t and the barycentrics of a picture of h x w pixels.

    Parameters
    ----------
    instance, triangle : (h, w) int32
        The surface that each pixel shows. These are the frame's own arrays, which it still fills.
    """

    def __init__(self, instance: Integers, triangle: Integers) -> None:
        self._instance = instance
        self._triangle = triangle
        self._height, self._width = instance.shape
        self._bands: dict[int, tuple[int, FindMeasures]] = {}  # first row, what finds its rays'
        self._band_of = np.full(self._height, _KNOWN)  # of each row that is not found yet

    @cached_property
    def _values(self) -> Measures:
        return no_measures(self._height, self._width)

    def enter(self, rows: slice, hits: Hits) -> None:
        """Take over the measures of a band's rows, found or to be found."""
        found = hits.measures
        number = max(self._bands, default=_KNOWN) + 1
        self._band_of[rows] = number
        self._bands[number] = rows.start, found if callable(found) else partial(_taken, found)

    def of(self, rows: slice) -> Measures:
        """Return t, inf where nothing is hit, and the barycentrics of k rows, (4, k, w)."""
        for _ in self.steps(rows):
            pass
        return self._values[:, rows]

    def some(self, pixel: Index) -> Measures:
        """Return t and the barycentrics of k pixels alone, numbered row by row, (4, k)."""
        row, column = np.divmod(pixel, self._width)
        band_of = self._band_of[row]
        is_known = (band_of == _KNOWN).any()
        out = self._values[:, row, column] if is_known else no_measures(len(pixel))
        for band in np.unique(band_of[band_of != _KNOWN]).tolist():
            first, find = self._bands[band]
            own = np.flatnonzero(band_of == band)
            at = row[own], column[own]
            ray = pixel[own] - first * self._width
            out[:, own] = find(ray, self._instance[at], self._triangle[at])
        return out

    def steps(self, rows: slice) -> Iterator[None]:
        """Find what is not known yet of some rows, in small steps."""
        first, last, _ = rows.indices(self._height)
        together = max(1, PIXELS // self._width)
        for y in range(first, last, together):
            band_of = self._band_of[y : min(y + together, last)]
            for band in np.unique(band_of[band_of != _KNOWN]).tolist():
                self._find(band, y + np.flatnonzero(band_of == band))
            yield

    def _find(self, band: int, row: Index) -> None:
        """Find the measures of some rows of one band."""
        first, find = self._bands[band]
        ray = ((row - first)[:, None] * self._width + np.arange(self._width)).ravel()
        found = find(ray, self._instance[row].ravel(), self._triangle[row].ravel())
        self._values[:, row] = found.reshape(4, -1, self._width)
        self._band_of[row] = _KNOWN
        if not (self._band_of == band).any():
            del self._bands[band]  # and what it takes to find them


def _taken(found: Measures, ray: Index, _instance: Names, _triangle: Names) -> Measures:
    return found[:, ray]

"""What turns the traced colours into those of a picture: a curve, an exposure, swapped channels.

Each is a function of straight linear RGB (..., 3). One is only believed where it makes most of the
pixels agree that show, with the eight around them, one surface: no edge is among those.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..images import curve, curve_undone
from ..tracer.frame import Frame
from .shown import Shown, Transform

MOST = 0.5  # of the differing pixels away from edges that a transform must account for
ENOUGH = 4096  # pixels on which it is tried
LEAST = 0.01  # an exposure or gamma nearer to 1 would be one of rounding
_FIT = 0.02  # values from here up to 1 less this are fitted: others say little of a curve


class Named(NamedTuple):
    """A transform and its name."""

    name: str
    of: Transform


CURVES = (
    Named("sRGB's curve applied once more", lambda c: curve(np.clip(c, 0, 1))),
    Named("sRGB's curve left out", lambda c: curve_undone(np.clip(c, 0, 1))),
    Named(
        "a power of 1/2.2 in place of sRGB's curve",
        lambda c: curve_undone(np.clip(c, 0, 1) ** (1 / 2.2)),
    ),
    Named("a power of 1/2.2", lambda c: np.clip(c, 0, None) ** (1 / 2.2)),
    Named("red and blue swapped", lambda c: c[..., ::-1]),
)


def find(
    frame: Frame, shown: Shown, interior: NDArray[np.bool_], more: Sequence[Named] = ()
) -> Named | None:
    """Return the transform that makes the most of a picture's differing pixels agree, or None.

    Parameters
    ----------
    frame : Frame
    shown : Shown
        (h, w).
    interior : (h, w) bool
        Pixels that may be asked: away from edges, and traced.
    more : sequence of Named
        Others to try, such as the scene's own view transform.
    """
    differ = shown.other_color(frame.color)
    asked = np.flatnonzero((interior & differ).ravel())
    if not len(asked):
        return None
    asked = asked[:: -(-len(asked) // ENOUGH)]
    where = np.zeros(differ.size, bool)
    where[asked] = True
    where = where.reshape(differ.shape)
    some, colors = shown.at(where), frame.color[where]
    best, most = None, MOST * len(asked)
    for named in _candidates(colors, some, more):
        agree = int((~some.through(named.of).other_color(colors)).sum())
        if agree > most:
            best, most = named, agree
    return best


def _candidates(colors: NDArray, shown: Shown, more: Sequence[Named]) -> Iterator[Named]:
    yield from more
    yield from CURVES
    if shown.levels:
        for named in (Named("values", lambda c: c), *CURVES[1:3]):
            yield Named(f"{named.name} cut off, not rounded", _cut_off(named.of, shown.levels))
    a, b = (np.asarray(v[:, :3], np.float64).ravel() for v in (colors, shown.color))
    with np.errstate(invalid="ignore"):
        told = (a > _FIT) & (b > _FIT) & np.isfinite(b)
    if told.any():
        factor = float(np.median(b[told] / a[told]))
        if abs(factor - 1) > LEAST:
            yield Named(f"an exposure of {np.log2(factor):+.3g} stops", lambda c: c * factor)
    told &= (a < 1 - _FIT) & (b < 1 - _FIT)
    if told.any():
        power = float(np.median(np.log(b[told]) / np.log(a[told])))
        if abs(power - 1) > LEAST:
            yield Named(f"a gamma of {1 / power:.3g}", lambda c: np.clip(c, 0, None) ** power)


def _cut_off(of: Callable[[NDArray], NDArray], levels: int) -> Transform:
    def transform(color: NDArray) -> NDArray:
        stored = levels * curve(np.clip(of(color), 0, 1))
        return curve_undone(np.floor(stored + 1e-6) / levels)

    return transform

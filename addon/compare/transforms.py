"""What turns the traced colours into those of a picture: a curve, an exposure, swapped channels.

Each is a function of straight linear RGB (..., 3). It is sought and believed on surfaces, a sample
for each of their colours, so that a large one does not outvote the others; the background proves
nothing. No pixel at an edge is asked.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..images import curve, curve_undone
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from .shown import Shown, Transform, straight

MOST = (
    0.5  # of the differing surfaces' colours, and of their pixels, that a known curve makes agree
)
NEARLY_ALL = 0.9  # of both, that a curve must whose number was fitted to them
ENOUGH = 4096  # pixels on which it is tried
LEAST = 0.01  # an exposure or gamma nearer to 1 would be one of rounding
_FIT = 0.02  # values from here up to 1 less this are fitted: others say little of a curve


class Named(NamedTuple):
    """A transform and its name."""

    name: str
    of: Transform
    share: float = MOST  # that it must account for


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
    """Return the transform that makes a picture's differing surfaces agree, or None.

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
    differ = shown.other_color(frame.color) & (frame.instance_index != NOTHING)
    asked = np.flatnonzero((interior & differ).ravel())
    if not len(asked):
        return None
    asked = asked[:: -(-len(asked) // ENOUGH)]
    where = np.zeros(differ.size, bool)
    where[asked] = True
    where = where.reshape(differ.shape)
    some, colors = shown.at(where), frame.color[where]
    keys = np.column_stack((frame.instance_index[where], colors))
    _, group = np.unique(keys, axis=0, return_inverse=True)
    group = group.reshape(-1)
    best, most = None, 0.0
    for named in _candidates(*_one_each(colors, some.color, group), shown.levels, more):
        agree = _agreeing(~some.through(named.of).other_color(colors), group)
        if agree > max(most, named.share):
            best, most = named, agree
    return best


def _one_each(
    colors: NDArray, shown: NDArray, group: NDArray[np.integer]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the traced and the median shown straight RGB, (k, 3), of each group of n pixels."""
    _, first = np.unique(group, return_index=True)
    order = np.argsort(group, kind="stable")
    parts = np.split(shown[order], np.cumsum(np.bincount(group))[:-1])
    median = np.array([np.median(part, axis=0) for part in parts])
    return straight(colors[first]), straight(median)


def _agreeing(agree: NDArray[np.bool_], group: NDArray[np.integer]) -> float:
    """Return the share that agrees: of n pixels, or of their groups where that is less."""
    of_group = np.bincount(group, agree) / np.bincount(group)
    return min(float(agree.mean()), float((of_group > MOST).mean()))


def _candidates(
    traced: NDArray, shown: NDArray, levels: int, more: Sequence[Named]
) -> Iterator[Named]:
    """Yield what may turn traced colours (k, 3) into the shown ones, the likeliest first."""
    yield from more
    yield from CURVES
    if levels:
        for named in (Named("values", lambda c: c), *CURVES[1:3]):
            yield Named(f"{named.name} cut off, not rounded", _cut_off(named.of, levels))
    for power in (2.2, 1 / 2.2):
        yield _coded_power(power, levels, MOST)
    a, b = traced.ravel(), shown.ravel()
    with np.errstate(invalid="ignore"):
        told = (a > _FIT) & (b > _FIT) & np.isfinite(b)
    if _several(a[told]):
        factor = float(np.median(b[told] / a[told]))
        if abs(factor - 1) > LEAST:
            name = f"an exposure of {np.log2(factor):+.3g} stops"
            yield Named(name, lambda c: c * factor, NEARLY_ALL)
    told &= (a < 1 - _FIT) & (b < 1 - _FIT)
    if _several(a[told]):
        power = _power(a[told], b[told])
        if abs(power - 1) > LEAST:
            name = f"a gamma of {1 / power:.3g}"
            yield Named(name, lambda c: np.clip(c, 0, None) ** power, NEARLY_ALL)
        coded = _power(curve(a[told]), curve(b[told]))
        if abs(coded - 1) > LEAST:
            yield _coded_power(coded, levels, NEARLY_ALL)


def _several(values: NDArray) -> bool:
    """Return whether values are told apart: one alone fits any curve of one number."""
    return len(values) > 0 and float(np.ptp(values)) > LEAST


def _power(a: NDArray, b: NDArray) -> float:
    """Return p of b = a**p: the median, then least squares of b among the values near to it."""
    x, y = np.log(a), np.log(b)
    power = float(np.median(y / x))
    near = np.abs(a**power - b) < _FIT
    if not near.any():
        return power
    x, y, weight = x[near], y[near], b[near] ** 2  # db = b d(log b)
    return float((weight * x * y).sum() / (weight * x * x).sum())


def _coded_power(power: float, levels: int, share: float) -> Named:
    """Return a power of sRGB's coded values, which a picture of `levels` has rounded before."""

    def transform(color: NDArray) -> NDArray:
        stored = curve(np.clip(color, 0, 1))
        if levels:
            stored = np.rint(levels * stored) / levels
        return curve_undone(stored**power)

    return Named(f"a gamma of {1 / power:.3g} applied to coded (sRGB) values", transform, share)


def _cut_off(of: Callable[[NDArray], NDArray], levels: int) -> Transform:
    def transform(color: NDArray) -> NDArray:
        stored = levels * curve(np.clip(of(color), 0, 1))
        return curve_undone(np.floor(stored + 1e-6) / levels)

    return transform

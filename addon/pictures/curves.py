"""Transforms of colours that may have made a picture differ: curves, exposures, swapped channels.

Each is a function of straight linear RGB (..., 3).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..arrays import Array
from ..files.images import EIGHT_BITS, curve, curve_undone
from .picture import MAJORITY, Curve, Transform

FITTED_SHARE = 0.9  # the share of pixels for a curve with a number that was fitted to them
LEAST_CHANGE = 0.01  # an exposure or gamma nearer to 1 than this would be one of rounding
# What to do about a transform that was found.
ADVICE = "check the colour space of each file, and what is applied when it is saved or loaded"
FIT = 0.02  # values below this, or above 1 less this, say little of a curve

CURVES = (
    Curve("sRGB's curve applied once more", lambda c: curve(np.clip(c, 0, 1)), key="srgb_twice"),
    Curve("sRGB's curve left out", lambda c: curve_undone(np.clip(c, 0, 1)), key="srgb_left_out"),
    Curve(
        "a power of 1/2.2 in place of sRGB's curve",
        lambda c: curve_undone(np.clip(c, 0, 1) ** (1 / 2.2)),
        key="power_for_srgb",
    ),
    Curve("a power of 1/2.2", lambda c: np.clip(c, 0, None) ** (1 / 2.2), key="gamma"),
    Curve("red and blue swapped", lambda c: c[..., ::-1], key="channels"),
)


def _eight(values: Array) -> Array:
    """Return values rounded to 8 bits."""
    return np.rint(EIGHT_BITS * np.clip(values, 0, 1)) / EIGHT_BITS


def _power(color: Array) -> Array:
    return np.clip(color, 0, 1) ** (1 / 2.2)


def _of_code(change: Transform) -> Transform:
    """Return what changes linear values by a function of sRGB's."""
    return lambda color: curve_undone(change(curve(np.clip(color, 0, 1))))


def _cut_off(levels: int) -> Transform:
    """Return what rounds values down to levels of sRGB's curve."""
    return _of_code(lambda v: np.floor(levels * v + 1e-6) / levels)


def _to_bits(cut_off: bool, bits: tuple[int, int, int]) -> Transform:
    """Return what rounds values to some bits of each channel, or cuts them off."""
    most = 2.0 ** np.array(bits) - 1
    if cut_off:
        return _of_code(lambda v: np.floor(np.rint(EIGHT_BITS * v) * (most + 1) / 256) / most)
    return _of_code(lambda v: np.rint(most * v) / most)


_in_srgb = _of_code(_eight)  # rounds linear values to 8 bits of sRGB's curve
ROUNDED_ONCE = Curve("values rounded to 8 bits", _in_srgb, key="rounding_level")
# What linear values go through, in a name's words; and what of them is then wrong.
_BEFORE: dict[str, Transform] = {
    "": lambda c: c,
    ", after values were rounded to 8 bits": _in_srgb,
    ", after linear values were rounded to 8 bits": _eight,
}
_STEPS: tuple[tuple[str, str, Transform], ...] = (
    (
        "srgb_twice",
        "sRGB's curve applied once more, to values of 8 bits",
        lambda c: _eight(curve(np.clip(c, 0, 1))),
    ),
    (
        "srgb_left_out",
        "sRGB's curve left out, linear values stored in 8 bits and read as sRGB's",
        lambda c: curve_undone(_eight(c)),
    ),
    (
        "power_for_srgb",
        "a power of 1/2.2 in place of sRGB's curve, in 8 bits",
        lambda c: curve_undone(_eight(_power(c))),
    ),
    ("gamma", "a power of 1/2.2, in 8 bits", lambda c: _eight(_power(c))),
)
_FEWER = (5, 6, 5), (5, 5, 5), (4, 4, 4), (3, 3, 2)  # bits of red, green and blue


def _one_after_the_other(first: Transform, second: Transform) -> Transform:
    return lambda color: second(first(color))


# Transforms with a rounding within them: a diagnosis tells them, no comparison excuses them.
ROUNDED = (
    *(
        Curve(name + before, _one_after_the_other(first, second), key=key)
        for before, first in _BEFORE.items()
        for key, name, second in _STEPS
    ),
    Curve(
        "values cut off to 8 bits, not rounded",
        _cut_off(EIGHT_BITS),
        key="cut_off",
    ),
    Curve("linear values rounded to 8 bits, before sRGB's curve", _eight, key="rounding_level"),
    *(
        Curve(
            f"values {'cut off' if cut_off else 'rounded'} to {r}, {g} and {b} bits",
            _to_bits(cut_off, (r, g, b)),
            key="rounding_level",
        )
        for r, g, b in _FEWER
        for cut_off in (False, True)
    ),
)
# The names of the faults of colours, in the order in which they are reported, and what they are.
KEYS = {
    "channels": "channels swapped",
    "gamma": "a power of linear values",
    "srgb_twice": "sRGB's curve applied once more",
    "srgb_left_out": "sRGB's curve left out",
    "power_for_srgb": "a power in place of sRGB's curve",
    "cut_off": "values cut off to 8 bits, not rounded",
    "coded_gamma": "a power of coded (sRGB) values",
    "exposure": "an exposure",
    "view_transform": "a view transform",
    "rounding_level": "values rounded to 8 bits or fewer",
}


def candidates(traced: Array, shown: Array, levels: int, more: Sequence[Curve]) -> Iterator[Curve]:
    """Yield what may turn traced colours (k, 3) into the shown ones, the likeliest first.

    Both are straight linear RGB. The picture was stored in `levels` of sRGB's curve, 0 for floats;
    `more` are transforms that are known beforehand.
    """
    yield from more
    yield from CURVES
    if levels:
        for named in (Curve("values", lambda c: c), *CURVES[1:3]):
            cut = _one_after_the_other(named.of, _cut_off(levels))
            yield Curve(f"{named.name} cut off, not rounded", cut, key="cut_off")
    for power in (2.2, 1 / 2.2):
        yield _coded_power(power, levels, MAJORITY)
    a, b = traced.ravel(), shown.ravel()
    with np.errstate(invalid="ignore"):
        fits = (a > FIT) & (b > FIT) & np.isfinite(b)
    a, b = a[fits], b[fits]
    if several(a):
        factor = float(np.median(b / a))
        if abs(factor - 1) > LEAST_CHANGE:
            name = f"an exposure of {np.log2(factor):+.3g} stops"
            yield Curve(name, lambda c: c * factor, FITTED_SHARE, "exposure")
    fits = (a < 1 - FIT) & (b < 1 - FIT)
    a, b = a[fits], b[fits]
    if several(a):
        power = _fitted_power(a, b)
        if abs(power - 1) > LEAST_CHANGE:
            name = f"a gamma of {1 / power:.3g}"
            yield Curve(name, lambda c: np.clip(c, 0, None) ** power, FITTED_SHARE, "gamma")
        coded = _fitted_power(curve(a), curve(b))
        if abs(coded - 1) > LEAST_CHANGE:
            yield _coded_power(coded, levels, FITTED_SHARE)
            linear = _fitted_power(a, curve(b))
            yield _coded_power(linear, levels, FITTED_SHARE, of_linear=True)


def several(values: Array) -> bool:
    """Return whether there are several distinct values: one alone fits any curve of one number."""
    return len(values) > 0 and float(np.ptp(values)) > LEAST_CHANGE


def _fitted_power(a: Array, b: Array) -> float:
    """Return p of b = a**p: the median, then a least squares fit to the values near to that."""
    x, y = np.log(a), np.log(b)
    power = float(np.median(y / x))
    near = np.abs(a**power - b) < FIT
    if not near.any():
        return power
    x, y = x[near], y[near]
    weight = b[near] ** 2  # as db = b d(log b)
    return float(np.sum(weight * x * y) / np.sum(weight * x * x))


def _coded_power(power: float, levels: int, share: float, of_linear: bool = False) -> Curve:
    """Return a power of sRGB's coded values, rounded to `levels`, or of what they are decoded to.

    The latter is then taken for coded.
    """

    def change(stored: Array) -> Array:
        if levels:
            stored = np.rint(levels * stored) / levels
        return (curve_undone(stored) if of_linear else stored) ** power

    if of_linear:
        name = f"a power of 1/{1 / power:.3g} in place of sRGB's curve"
        return Curve(name, _of_code(change), share, "power_for_srgb")
    name = f"a gamma of {1 / power:.3g} applied to coded (sRGB) values"
    return Curve(name, _of_code(change), share, "coded_gamma")

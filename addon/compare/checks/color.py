"""Colour only: the same object in another shade, by the light or by a transform of the colours.

A transform is a function of straight linear RGB (..., 3): a curve, an exposure, swapped channels.
It is sought on the surfaces that differ, a sample for each of their colours, so that a large one
does not outvote the others; the background proves nothing. No pixel at an edge is asked. It is one
of the whole picture, or of none: a surface that agrees without it, and would not with it, refutes
it. Then the objects in another shade are named, and stay unexplained.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...arrays import Array, Index, Mask, Places, Reals
from ...images import curve, curve_undone
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ..bounds import difference
from ..cause import AGREE, UNEXPLAINED, Cause, Shade
from ..metrics import boundary
from ..picture import MAJORITY, Curve, Picture, Transform, straight
from .probe import OpenPixels, blocks

COLOR = Cause(
    9,
    "color",
    "colour only",
    "the same object in another shade: {figure:.3g} is left after the transform that the "
    "comparison names (allowed: {allowed:.3g})",
    "of 1",
    (0.4, 0.7, 0.7),
    explains=True,
    warns=True,
    see_through=True,
)


FITTED_SHARE = 0.9  # as MAJORITY, of a curve whose number was fitted to the pixels
ENOUGH = 4096  # pixels on which it is tried
LEAST_CHANGE = 0.01  # an exposure or gamma nearer to 1 would be one of rounding
REFUTING = 0.01  # the share of all surfaces' pixels that may agree without a transform alone
SHADES = 16  # objects that are looked at for one
_FIT = 0.02  # values from here up to 1 less this are fitted: others say little of a curve

CURVES = (
    Curve("sRGB's curve applied once more", lambda c: curve(np.clip(c, 0, 1))),
    Curve("sRGB's curve left out", lambda c: curve_undone(np.clip(c, 0, 1))),
    Curve(
        "a power of 1/2.2 in place of sRGB's curve",
        lambda c: curve_undone(np.clip(c, 0, 1) ** (1 / 2.2)),
    ),
    Curve("a power of 1/2.2", lambda c: np.clip(c, 0, None) ** (1 / 2.2)),
    Curve("red and blue swapped", lambda c: c[..., ::-1]),
)


def check(pixels: OpenPixels) -> Work[None]:
    """Settle the pixels that show the same object in another shade.

    The others are looked at as if the picture were made by the transform that was found.
    """
    if pixels.picture.lit:
        pixels.out.transform = "light that the tracer does not have"
    elif pixels.case.curves is None or not pixels.open.any():
        return
    else:
        where = _judged(pixels) & (pixels.open | (pixels.out.cause == AGREE))
        found = yield from find_transform(pixels.frame, pixels.picture, where, pixels.case.curves)
        if found is None:
            return
        pixels.out.transform = found.name
        pixels.picture = replace(pixels.picture, transform=found.of)
    for rows in blocks(pixels.open.shape):
        part, instance = pixels.rows(rows), pixels.frame.instance_index[rows]
        picture, color = part.picture, pixels.frame.color[rows]
        if picture.lit:
            alike = picture.same_object(instance)
            left, allowed = difference(color, picture.color)[0].max(axis=-1), 1.0
        else:
            alike = ~picture.other_color(color) & ~picture.other_object(instance)
            left, allowed = picture.difference(color)
        part.settle(part.open & alike, COLOR, left, allowed)
        yield 1.0


def find_transform(
    frame: Frame, picture: Picture, interior: Mask, more: Sequence[Curve] = ()
) -> Work[Curve | None]:
    """Return the transform that makes a picture's (h, w) differing surfaces agree, or None.

    Only the pixels `interior` (h, w) are asked, which are away from edges, and traced; `more` are
    tried besides CURVES, such as the scene's own view transform. It has to leave right what is.
    """
    surface = interior & (frame.instance_index != NOTHING)
    where = surface & (yield from _differing(frame, picture))
    right = surface & ~where
    asked = np.flatnonzero(where)
    if not len(asked):
        return None
    where = np.zeros_like(surface)
    where.flat[asked[:: -(-len(asked) // ENOUGH)]] = True
    some, colors = picture.at(where), frame.color[where]
    keys = np.column_stack((frame.instance_index[where], colors))
    _, group = np.unique(keys, axis=0, return_inverse=True)
    group = group.reshape(-1)
    found: list[tuple[float, Curve]] = []
    first, shown = _medians(some.color, group)
    for named in _candidates(straight(colors[first]), straight(shown), picture.levels, more):
        agree = ~replace(some, transform=named.of).other_color(colors)
        of_group = np.bincount(group, agree) / np.bincount(group)
        # Of the pixels, or of their groups where that is less.
        share = min(float(agree.mean()), float((of_group > MAJORITY).mean()))
        yield 0.0
        if share > named.share:
            found.append((share, named))
    for _, named in sorted(found, key=lambda pair: -pair[0]):
        after = yield from _differing(frame, replace(picture, transform=named.of))
        if not _refuted(frame, surface, right & after):
            return named
    return None


def _judged(pixels: OpenPixels) -> Mask:
    """Return the pixels (h, w) away from edges in which something is known of the colour."""
    return ~boundary(pixels.frame) & (pixels.out.blind < 0)


def _differing(frame: Frame, picture: Picture) -> Work[Mask]:
    """Return where the colours differ, (h, w)."""
    out = np.zeros(frame.shape, bool)
    for rows in blocks(out.shape):
        out[rows] = picture.at(rows).other_color(frame.color[rows])
        yield 0.0
    return out


def _refuted(frame: Frame, surface: Mask, wrong: Mask) -> bool:
    """Return whether what a transform makes wrong refutes it: most of an instance, or too much."""
    of, count = frame.instance_index, int(frame.instance_index.max()) + 1
    many, bad = (np.bincount(of[some], minlength=count) for some in (surface, wrong))
    return bool((bad > MAJORITY * many).any() or bad.sum() > REFUTING * many.sum())


def name_shades(pixels: OpenPixels) -> Work[None]:
    """Name the objects that stay unexplained because they are shown in another shade as a whole.

    Each of an object's colours must have become one other, or all have by one transform; and most
    of what is shown must not be the colour of what is around it, if it may be that.
    """
    frame, picture = pixels.frame, pixels.picture
    inside = _judged(pixels) & (frame.instance_index != NOTHING)
    inside &= ~picture.other_object(frame.instance_index)
    if picture.lit or not (inside & (pixels.out.cause == UNEXPLAINED)).any():
        return
    # Pixels that agree and differ were passed over: nobody looked for their cause.
    wrong = inside & np.isin(pixels.out.cause, (UNEXPLAINED, AGREE))
    wrong &= yield from _differing(frame, picture)
    count = np.bincount(frame.object_index[wrong])
    share = count / np.maximum(np.bincount(frame.object_index[inside])[: len(count)], 1)
    for number in np.argsort(-count, kind="stable")[:SHADES]:
        where = wrong & (frame.object_index == number)
        if share[number] > MAJORITY and _is_its_own(frame, picture, where):
            found = yield from find_transform(frame, picture, where, pixels.case.curves or ())
            if found or _one_other_each(picture.at(where), frame.color[where]):
                name, how = pixels.case.scene.objects[number], found.name if found else ""
                pixels.out.shades.append(Shade(name, int(count[number]), how))
        yield 1.0


def _is_its_own(frame: Frame, picture: Picture, where: Mask) -> bool:
    """Return whether most of an object's pixels (h, w) show no colour of what is around it."""
    if picture.at(where).known(frame.instance_index[where]).all():
        return True
    own = np.pad(frame.object_index == frame.object_index[where][0], 1)
    rim = own[2:, 1:-1] | own[:-2, 1:-1] | own[1:-1, 2:] | own[1:-1, :-2]
    shown, taken = picture.color[where], np.zeros(int(where.sum()), bool)
    for color in np.unique(frame.color[rim & ~own[1:-1, 1:-1]], axis=0)[:ENOUGH]:
        taken |= (np.abs(shown - color) < _FIT).all(axis=1)
    return bool(taken.mean() < MAJORITY)


def _one_other_each(picture: Picture, colors: Array) -> bool:
    """Return whether each traced colour of n pixels is shown as one other."""
    some = slice(None, None, -(-len(colors) // ENOUGH))
    picture, colors = picture.at(some), colors[some]
    group = np.unique(colors, axis=0, return_inverse=True)[1].reshape(-1)
    _, medians = _medians(picture.color, group)
    if 2 * len(medians) > len(group) > 1:  # colours between corners: each is another
        return False
    alike = ~replace(picture, color=medians[group]).other_color(picture.color)
    return bool(alike.mean() > FITTED_SHARE)


def _medians(shown: Array, group: Index) -> tuple[Places, Reals]:
    """Return the first of each of k groups of n pixels, (k,), and what is shown of it, (k, 4)."""
    _, first = np.unique(group, return_index=True)
    order = np.argsort(group, kind="stable")
    parts = np.split(shown[order], np.cumsum(np.bincount(group))[:-1])
    return first, np.array([np.median(part, axis=0) for part in parts])


def _candidates(traced: Array, shown: Array, levels: int, more: Sequence[Curve]) -> Iterator[Curve]:
    """Yield what may turn traced colours (k, 3) into the shown ones, the likeliest first."""
    yield from more
    yield from CURVES
    if levels:
        for named in (Curve("values", lambda c: c), *CURVES[1:3]):
            yield Curve(f"{named.name} cut off, not rounded", _cut_off(named.of, levels))
    for power in (2.2, 1 / 2.2):
        yield _coded_power(power, levels, MAJORITY)
    a, b = traced.ravel(), shown.ravel()
    with np.errstate(invalid="ignore"):
        told = (a > _FIT) & (b > _FIT) & np.isfinite(b)
    if _several(a[told]):
        factor = float(np.median(b[told] / a[told]))
        if abs(factor - 1) > LEAST_CHANGE:
            name = f"an exposure of {np.log2(factor):+.3g} stops"
            yield Curve(name, lambda c: c * factor, FITTED_SHARE)
    told &= (a < 1 - _FIT) & (b < 1 - _FIT)
    if _several(a[told]):
        power = _power(a[told], b[told])
        if abs(power - 1) > LEAST_CHANGE:
            name = f"a gamma of {1 / power:.3g}"
            yield Curve(name, lambda c: np.clip(c, 0, None) ** power, FITTED_SHARE)
        times = float(np.median(curve(b[told]) / curve(a[told])))
        if abs(times - 1) > LEAST_CHANGE:
            name = f"a factor of {times:.3g} on coded (sRGB) values"
            yield Curve(name, lambda c: curve_undone(times * curve(np.clip(c, 0, 1))), FITTED_SHARE)
        coded = _power(curve(a[told]), curve(b[told]))
        if abs(coded - 1) > LEAST_CHANGE:
            yield _coded_power(coded, levels, FITTED_SHARE)


def _several(values: Array) -> bool:
    """Return whether values are told apart: one alone fits any curve of one number."""
    return len(values) > 0 and float(np.ptp(values)) > LEAST_CHANGE


def _power(a: Array, b: Array) -> float:
    """Return p of b = a**p: the median, then least squares of b among the values near to it."""
    x, y = np.log(a), np.log(b)
    power = float(np.median(y / x))
    near = np.abs(a**power - b) < _FIT
    if not near.any():
        return power
    x, y, weight = x[near], y[near], b[near] ** 2  # db = b d(log b)
    return float((weight * x * y).sum() / (weight * x * x).sum())


def _coded_power(power: float, levels: int, share: float) -> Curve:
    """Return a power of sRGB's coded values, which a picture of `levels` has rounded before."""

    def transform(color: Array) -> Array:
        stored = curve(np.clip(color, 0, 1))
        if levels:
            stored = np.rint(levels * stored) / levels
        return curve_undone(stored**power)

    return Curve(f"a gamma of {1 / power:.3g} applied to coded (sRGB) values", transform, share)


def _cut_off(of: Callable[[Array], Array], levels: int) -> Transform:
    def transform(color: Array) -> Array:
        stored = levels * curve(np.clip(of(color), 0, 1))
        return curve_undone(np.floor(stored + 1e-6) / levels)

    return transform

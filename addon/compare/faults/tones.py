"""Faults of all colours of a picture: curves, saturation, white balance, rounding, noise.

What is done to all colours is the same everywhere: it is looked for in the surfaces, each with one
traced colour, away from edges. A transform is told with no more slack than the picture's own
rounding. What allows for more, a level or noise, is `vague`: it gives way to what is exact.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...arrays import Array, Bools, Colors, Floats
from ...images import curve, curve_undone, encoded
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ..bounds import difference
from ..case import Case
from ..checks.color import find_transform, groups, medians
from ..curves import (
    EIGHT_BITS,
    FIT,
    FITTED_SHARE,
    KEYS,
    LEAST_CHANGE,
    ROUNDED,
    ROUNDED_ONCE,
    saturated,
    several,
    through,
)
from ..evidence import Evidence, spread
from ..metrics import boundary
from ..picture import Curve, Picture, Transform, straight
from .fault import Example, Fault, Find, Guess, Make, with_values

MOST = 1 << 14  # pixels of surfaces that are looked at
LINEAR: Transform = lambda c: c  # noqa: E731
# In which values a picture is graded, and what is said of it.
SPACES: tuple[tuple[Transform, Transform, str], ...] = (
    (LINEAR, LINEAR, "in linear values"),
    (lambda c: curve(np.clip(c, 0, 1)), lambda c: curve_undone(np.clip(c, 0, 1)), "in sRGB values"),
)
# What of a colour is its grey: Rec. 709 and Rec. 601, as ITU-R BT.709-6 and BT.601-7 have them.
GREYS = {"Rec. 709": (0.2126, 0.7152, 0.0722), "Rec. 601": (0.299, 0.587, 0.114)}
SLACKS = (-1.0, 0.0, 1.0)  # levels of 8 bits that grading may be off; below 0: it is not rounded
MOST_NOISE = 2  # levels that dithering adds, at most
FLAT = 0.3  # levels: the least deviation within a surface that noise has
ENOUGH = 32  # pixels of a surface to measure it
_BGRA = [2, 1, 0, 3]
_SEED = 27


def recolored(change: Callable[[Array], Array]) -> Make:
    """Return what changes the picture's colours, and its background, if it has one of its own."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case:
        picture = case.picture
        beneath = None if picture.beneath is None else change(picture.beneath)
        changed = replace(picture, color=change(picture.color), beneath=beneath)
        case = replace(case, picture=changed)
        return case if picture.background is None else case.before(change(picture.background))

    return make


def _of_straight(change: Callable[..., Array]) -> Make:
    """Return what changes straight RGB by a function of it and the guess' numbers."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case | None:
        def changed(color: Array) -> Colors:
            rgb = change(straight(color), *guess.values) * color[..., 3:]
            return np.concatenate((rgb, color[..., 3:]), axis=-1, dtype=np.float32)

        return recolored(changed)(case, frame, guess)

    return make


def _gamma(color: Array) -> Array:
    color = color.copy()
    color[..., :3] = np.sign(color[..., :3]) * np.abs(color[..., :3]) ** np.float32(1 / 2.2)
    return color


def _by_curve(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case whose traced colours go through what was done to the picture's."""
    if guess.curve is None:
        return None
    return replace(case, picture=replace(case.picture, transform=guess.curve.of))


# ---- the surfaces


class Surfaces(NamedTuple):
    """What k surfaces of one colour each are traced and shown in, away from edges."""

    traced: Colors  # (k, 4)
    shown: Colors  # (k, 4) the median of its pixels
    wrong: Bools  # (k,) most of its pixels are unexplained
    noisy: Bools  # (k,) its pixels differ from one another by more than rounding
    measured: Bools  # (k,) enough pixels are seen of it to say so


def _inside(evidence: Evidence) -> Bools:
    """Return the pixels (h, w) of surfaces, away from edges, of which something is known."""
    inside = ~boundary(evidence.frame) & (evidence.causes.blind < 0)
    inside &= evidence.open | evidence.judged
    return inside & (evidence.frame.instance_index != NOTHING)


def _surfaces(evidence: Evidence) -> Surfaces | None:
    """Return the surfaces, looked at once; None where colours say nothing, or none are wrong."""
    if "surfaces" not in evidence.known:
        evidence.known["surfaces"] = _looked_at(evidence)
    found: Surfaces | None = evidence.known["surfaces"]
    return found


def _looked_at(evidence: Evidence) -> Surfaces | None:
    picture, some = evidence.picture, spread(_inside(evidence), MOST)
    if picture.transform is not None or picture.lit or not len(some):
        return None
    traced, shown = (v.reshape(-1, 4)[some] for v in (evidence.frame.color, picture.color))
    if not np.isfinite(shown).all():
        return None
    group = groups(np.column_stack((evidence.frame.instance_index.ravel()[some], traced)))
    first, middle = medians(shown, group)
    count = np.bincount(group)
    wrong = np.bincount(group, evidence.open.ravel()[some]) > count / 2
    if not wrong.any():
        return None
    levels = EIGHT_BITS * encoded(shown)[:, :3]
    means = np.array([np.bincount(group, v) / count for v in levels.T])
    apart = (levels.T - means[:, group]) ** 2
    deviation = np.sqrt(np.max([np.bincount(group, v) / count for v in apart], axis=0))
    return Surfaces(traced[first], middle, wrong, deviation > FLAT, count >= ENOUGH)


def _agree(picture: Picture, found: Surfaces, of: Transform | None) -> Bools:
    """Return which of the k surfaces agree by a transform of the traced colours, (k,)."""
    one = replace(picture, color=found.shown.astype(np.float32), owner=None)
    return ~replace(one, transform=of).other_color(found.traced)


# ---- curves


def _curve_of(evidence: Evidence) -> Work[Curve | None]:
    """Return the transform that makes most unexplained surfaces agree; it is looked for once."""
    picture = evidence.picture
    if "curve" not in evidence.known and picture.transform is None and not picture.lit:
        more = evidence.case.curves or ()
        found = yield from find_transform(evidence.frame, picture, _inside(evidence), more)
        evidence.known["curve"] = found
    return evidence.known.get("curve")


def _rounded(evidence: Evidence) -> Sequence[Curve]:
    """Return the transforms with a rounding to 8 bits that say more than a plain one does.

    Where all that is shown is what one rounding gives, it may not be said to be of two.
    """
    found = _surfaces(evidence)
    if found is None:
        return ()
    if "rounded" not in evidence.known:
        once = (_agree(evidence.picture, found, ROUNDED_ONCE.of) & found.wrong).sum()
        evidence.known["rounded"] = [
            c
            for c in ROUNDED
            if (agree := _agree(evidence.picture, found, c.of)).mean() > FITTED_SHARE
            and (agree & found.wrong).sum() > once
        ]
    rounded: Sequence[Curve] = evidence.known["rounded"]
    return rounded


def _find_curve(key: str) -> Find:
    def find(evidence: Evidence) -> Work[list[Guess]]:
        best = yield from _curve_of(evidence)
        found = (*([best] if best else []), *_rounded(evidence))
        return [Guess(words=c.name, curve=c) for c in found if c.key == key]

    return find


def _nothing(case: Case, frame: Frame, guess: Guess) -> None:
    """Make nothing: what a curve does to a picture is found of pictures that have it."""


def _colors(key: str, make: Make = _nothing, *examples: Example) -> Fault:
    return Fault(
        key,
        "the picture's colours: {words}",
        "check the colour space of each file, and what is applied when it is saved or loaded",
        make,
        _find_curve(key),
        put_right=_by_curve,
        examples=examples,
    )


_OWN = {
    "gamma": (recolored(_gamma), Example("gamma", "a gamma of 2.2 applied to the picture")),
    "channels": (
        recolored(lambda color: color[..., _BGRA]),
        Example("channels", "red and blue swapped"),
    ),
}


# ---- grading


Grading = Iterator[tuple[tuple[float, ...], Transform, str]]  # the numbers, what it is, in words


def _with_slack(picture: Picture, slack: float) -> Picture:
    """Return a picture that may be as many levels of 8 bits off, beyond its rounding to these."""
    if slack < 0:
        return picture
    return replace(picture, levels=picture.levels or EIGHT_BITS, dither=picture.dither + slack)


def _ends(picture: Picture, shown: Colors) -> tuple[Floats, Floats]:
    """Return between which straight linear values a picture's rounding leaves (k, 4) colours."""
    _, allowed = difference(shown, shown, False, picture.levels, picture.sums, picture.dither)
    middle = straight(shown)
    if not picture.levels:
        return middle - allowed[..., :3], middle + allowed[..., :3]
    coded = curve(np.clip(middle, 0, 1))
    low, high = coded - allowed[..., :3], coded + allowed[..., :3]
    with np.errstate(invalid="ignore"):
        ends = np.where(low > 0, curve_undone(low), -np.inf), curve_undone(high)
    return ends[0], np.where(high < 1, ends[1], np.inf)


def _most_covered(low: Floats, high: Floats) -> float:
    """Return a number that lies in most of n intervals: the middle of where most of them meet."""
    places = np.concatenate((low, high))
    step = np.repeat((1, -1), len(low))
    order = np.lexsort((-step, places))
    most = int(np.argmax(np.cumsum(step[order])))
    ends = places[order[most : most + 2]]
    return float(ends.mean()) if np.isfinite(ends).all() else float(places[order[most]])


def _balances(traced: Floats, ends: tuple[Floats, Floats]) -> Grading:
    """Yield a factor for each channel, if each has several values to tell it by."""
    for into, back, words in SPACES:
        a, low, high = (into(v) for v in (traced, *ends))
        factors = []
        for channel in range(3):
            fits = a[:, channel] > FIT
            value = a[fits, channel]
            if several(value):
                first, second = low[fits, channel] / value, high[fits, channel] / value
                factors.append(_most_covered(first, second))
        if len(factors) == 3 and np.ptp(factors) > LEAST_CHANGE and min(factors) > 0:
            yield tuple(factors), through(into, back, np.array(factors).__mul__), words


def _saturations(traced: Floats, ends: tuple[Floats, Floats]) -> Grading:
    """Yield by how much colours lie farther from their grey than they should, or nearer."""
    for into, back, space in SPACES:
        a, low, high = (into(v) for v in (traced, *ends))
        for name, weights in GREYS.items():
            grey = (a @ np.array(weights))[:, None]
            apart = a - grey
            fits = np.abs(apart) > FIT
            if not several(apart[fits]):
                continue
            first, second = ((v - grey)[fits] / apart[fits] for v in (low, high))
            share = _most_covered(np.minimum(first, second), np.maximum(first, second))
            if share >= 0 and abs(share - 1) > LEAST_CHANGE:
                of = through(into, back, saturated(share, weights))
                yield (share,), of, f"{space}, with the grey of {name}"


def _find_graded(gradings: Callable[[Floats, tuple[Floats, Floats]], Grading]) -> Find:
    """Return what finds a grading by which nearly all surfaces agree: the one with least slack.

    A picture that was graded in 8 bits is rounded twice, or cut off: a level is allowed then,
    unless that alone makes the surfaces agree.
    """

    def find(evidence: Evidence) -> Work[list[Guess]]:
        found = _surfaces(evidence)
        for slack in SLACKS if found else ():
            assert found
            picture = _with_slack(evidence.picture, slack)
            if _agree(picture, found, None).mean() > FITTED_SHARE:
                return []
            ends = _ends(picture, found.shown)
            for values, of, words in gradings(straight(found.traced), ends):
                if _agree(picture, found, of).mean() > FITTED_SHARE:
                    told = Curve(words, of)
                    return [Guess((*values, slack), values, values, words=words, curve=told)]
            yield 0.0
        return []

    return find


def _by_grading(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case whose traced colours are graded; the last number is the slack."""
    picture = _with_slack(case.picture, guess.values[-1])
    return _by_curve(replace(case, picture=picture), frame, guess)


# ---- rounding and noise


def _of_levels(case: Case, frame: Frame, guess: Guess) -> Case:
    """Allow for some levels of 8 bits."""
    return replace(case, picture=_with_slack(case.picture, guess.values[0]))


def _is_noisy(found: Surfaces | None) -> bool:
    """Return whether nearly all surfaces are, of those that can be measured."""
    if found is None or not found.measured.any():
        return False
    return bool(found.noisy[found.measured].mean() > FITTED_SHARE)


def _find_rounding(evidence: Evidence) -> Work[list[Guess]]:
    """Return how many levels rounding is off, if each surface is shown in one colour."""
    if _is_noisy(_surfaces(evidence)):
        return []
    more = Guess((1.0,), words=", and up to one level more off")
    return [more] if evidence.picture.levels else [Guess((0.0,)), more]
    yield


def _find_noise(evidence: Evidence) -> Work[list[Guess]]:
    """Return how many levels of noise there are, if all surfaces have it."""
    if not _is_noisy(_surfaces(evidence)):
        return []
    return [Guess((float(n),), words="s" if n > 1 else "") for n in range(1, MOST_NOISE + 1)]
    yield


def _dithered(color: Array, levels: float) -> Array:
    """Return straight RGB with noise of up to some levels of 8 bits, rounded to these."""
    noise = np.random.default_rng(_SEED).uniform(-levels, levels, color.shape)
    stored = np.rint(EIGHT_BITS * curve(np.clip(color, 0, 1)) + noise)
    return curve_undone(np.clip(stored / EIGHT_BITS, 0, 1))


_TWICE = next(c for c in ROUNDED if c.key == "twice_rounded")

TONE_FAULTS = (
    *(_colors(key, *_OWN.get(key, ())) for key in KEYS),
    Fault(
        "white_balance",
        "the picture's white balance is another: red times {red:.4g}, green times {green:.4g}, "
        "blue times {blue:.4g}, {words}",
        "switch off white balance and colour grading",
        _of_straight(lambda color, *factors: color * np.array(factors[:3])),
        _find_graded(_balances),
        ("red", "green", "blue"),
        put_right=_by_grading,
        examples=(Example("white_balance", "a warmer white balance", with_values(1.1, 1.0, 0.85)),),
    ),
    Fault(
        "saturation",
        "the picture's saturation is {saturation:.4g} times what it should be, {words}",
        "switch off colour grading, and filters of the viewer that saved it",
        _of_straight(lambda color, share, *_: saturated(share, GREYS["Rec. 709"])(color)),
        _find_graded(_saturations),
        ("saturation",),
        put_right=_by_grading,
        examples=(Example("saturation", "more saturated by a quarter", with_values(1.25)),),
    ),
    Fault(
        "twice_rounded",
        "the picture's colours were rounded to 8 bits more than once: {words}",
        "convert colours as floats, and round them once, when the file is written",
        _of_straight(_TWICE.of),
        _find_curve("twice_rounded"),
        put_right=_by_curve,
        examples=(Example("twice_rounded", "colours rounded to 8 bits twice"),),
    ),
    Fault(
        "rounding_level",
        "the picture's colours are rounded to 8 bits{words}",
        "round, do not cut off; or store 16 bits or floats",
        _of_levels,
        _find_rounding,
        ("levels",),
        put_right=_of_levels,
        vague=True,
    ),
    Fault(
        "dithered",
        "noise of up to {levels:.0f} level{words} of 8 bits lies over the picture, as of dithering",
        "switch dithering off, or compare a PNG with --dither {levels:.0f}",
        _of_straight(_dithered),
        _find_noise,
        ("levels",),
        put_right=_of_levels,
        vague=True,
        examples=(Example("dithered", "noise of two levels, as of dithering", with_values(2.0)),),
    ),
)

"""Faults of the picture, after all is rendered: the order of its rows, its colours, its file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ..bounds import largest_within
from ..case import Case
from ..checks.color import find_transform
from ..curves import KEYS
from ..evidence import NEAR, Evidence
from ..metrics import boundary
from ..picture import Curve
from .fault import Example, Fault, Find, Guess, Make
from .pixels import PIXEL_FAULTS

RADII = (0.5, 0.75, 1.0, 1.5, 2.0)  # of filters that are tried, in pixels
EDGES = 0.4, 0.8  # the least share of edges that must be mixed: by less than a pixel, by more
MIXED = 0.5  # the least share of unexplained pixels that must show no colour of the scene
_BGRA = [2, 1, 0, 3]


def _moved_rows(change: Callable[[Array], Array]) -> Make:
    """Return what changes the order of the picture's rows."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case:
        return replace(case, picture=case.picture.at(change(np.arange(len(case.picture.color)))))

    return make


def _recolored(change: Callable[[Array], Array]) -> Make:
    """Return what changes the picture's colours, and its background, if it has one of its own."""

    def make(case: Case, frame: Frame, guess: Guess) -> Case:
        picture = case.picture
        beneath = None if picture.beneath is None else change(picture.beneath)
        changed = replace(picture, color=change(picture.color), beneath=beneath)
        case = replace(case, picture=changed)
        return case if picture.background is None else case.before(change(picture.background))

    return make


def _gamma(color: Array) -> Array:
    color = color.copy()
    color[..., :3] = np.sign(color[..., :3]) * np.abs(color[..., :3]) ** np.float32(1 / 2.2)
    return color


def _premultiplied(color: Array) -> Array:
    """Multiply colours by their alpha a second time."""
    return np.concatenate((color[..., :3] * color[..., 3:], color[..., 3:]), axis=-1)


def _straight(color: Array) -> Array:
    alpha = color[..., 3:]
    return np.concatenate((color[..., :3] / np.where(alpha > 0, alpha, 1), alpha), axis=-1)


def _find_partly(evidence: Evidence) -> Work[list[Guess]]:
    """Return the guess if pixels are covered in part: others have the same colour either way.

    Single pixels cannot say how good it is, as edges that are smoothed are such pixels.
    """
    alpha = evidence.picture.color[..., 3]
    return [Guess()] if ((alpha > 0) & (alpha < 1)).any() else []
    yield


def _by_curve(case: Case, frame: Frame, guess: Guess) -> Case | None:
    """Return the case whose traced colours go through what was done to the picture's."""
    if guess.curve is None:
        return None
    return replace(case, picture=replace(case.picture, transform=guess.curve.of))


def _curve_of(evidence: Evidence) -> Work[Curve | None]:
    """Return the transform that makes most unexplained surfaces agree; it is looked for once."""
    picture = evidence.picture
    if "curve" not in evidence.known and picture.transform is None and not picture.lit:
        inside = ~boundary(evidence.frame) & (evidence.causes.blind < 0)
        inside &= evidence.open | evidence.judged
        inside &= evidence.frame.instance_index != NOTHING
        more = evidence.case.curves or ()
        found = yield from find_transform(evidence.frame, picture, inside, more)
        evidence.known["curve"] = found
    return evidence.known.get("curve")


def _find_curve(key: str) -> Find:
    def find(evidence: Evidence) -> Work[list[Guess]]:
        curve = yield from _curve_of(evidence)
        return [Guess(words=curve.name, curve=curve)] if curve and curve.key == key else []

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
    "gamma": (
        _recolored(_gamma),
        Example("gamma", "a gamma of 2.2 applied to the picture"),
    ),
    "channels": (
        _recolored(lambda color: color[..., _BGRA]),
        Example("channels", "red and blue swapped"),
    ),
}


def _of_levels(case: Case, frame: Frame, guess: Guess) -> Case:
    """Allow a level of rounding in 8 bits."""
    picture = case.picture
    levels = picture.levels or 255
    return replace(
        case, picture=replace(picture, levels=levels, dither=picture.dither + guess.values[0])
    )


def _of_8_bits(evidence: Evidence) -> Work[list[Guess]]:
    return [Guess((0.0,)), Guess((1.0,))] if not evidence.picture.levels else [Guess((1.0,))]
    yield


def _filtered(case: Case, frame: Frame, guess: Guess) -> Case:
    return replace(case, picture=replace(case.picture, filter_radius=guess.values[0]))


def _find_filter(evidence: Evidence) -> Work[list[Guess]]:
    """Return the radii beyond the picture's own, if most unexplained pixels mix colours."""
    shown, scene = evidence.shown.at(np.flatnonzero(evidence.was_open)), evidence.case.scene
    pure = np.zeros(len(shown.color), bool)
    colors = np.unique(scene.color_table, axis=0)
    for color in colors if len(colors) <= 64 else ():
        pure |= ~shown.other_color(np.broadcast_to(color, shown.color.shape))
        yield 0.0
    if pure.mean() > 1 - MIXED:
        return []
    larger = [r for r in RADII if r > evidence.picture.filter_radius]
    return [
        Guess((r,), (r,), (r,)) for r in larger if _may_mix(evidence, r) and _edges_mix(evidence, r)
    ]


def _edges_mix(evidence: Evidence, radius: float) -> bool:
    """Return whether enough of the edges are unexplained for all of the picture to be filtered.

    Of the pixels beside an edge, two wide, a filter of half a pixel mixes about half (44 % in the
    test bed), one of a pixel nearly all. A picture that is blurred in a part has crisp edges, too.
    """
    if evidence.picture.filter_radius:
        return True  # most are mixed already
    made = evidence.picture.made_of(evidence.frame.color)
    apart = [largest_within(v, 1) + largest_within(-v, 1) for v in np.moveaxis(made, -1, 0)]
    edge = np.max(apart, axis=0) > 2 * NEAR
    return bool(edge.any() and evidence.open[edge].mean() >= EDGES[radius >= 1])


def _may_mix(evidence: Evidence, radius: float) -> bool:
    """Return whether most unexplained pixels lie between the colours that are traced around."""
    around = int(np.ceil(radius)) + 1
    at = tuple(v[evidence.was_open] for v in evidence.sample)
    made = evidence.picture.made_of(evidence.frame.color)
    shown = evidence.picture.color[at][:, : made.shape[-1]]
    inside = np.ones(len(shown), bool)
    for channel in range(made.shape[-1]):
        traced, here = made[..., channel], shown[:, channel]
        inside &= here <= largest_within(traced, around)[at] + NEAR
        inside &= here >= -largest_within(-traced, around)[at] - NEAR
    return bool(inside.mean() > MIXED)


PICTURE_FAULTS = (
    Fault(
        "row_off",
        "the picture's rows are one off, and the last is the first",
        "check where the border begins",
        _moved_rows(lambda rows: np.roll(rows, 1)),
        put_right=_moved_rows(lambda rows: np.roll(rows, -1)),
        examples=(Example("border", "the border off by one row"),),
    ),
    Fault(
        "rows",
        "the picture's rows are from top to bottom, or were turned once too often",
        "Blender's row 0 is at the bottom, that of most files at the top",
        _moved_rows(np.flip),
        examples=(Example("rows", "the picture's rows from top to bottom"),),
    ),
    *(_colors(key, *_OWN.get(key, ())) for key in KEYS),
    Fault(
        "premultiplied",
        "the picture's colours are multiplied by alpha twice",
        "store premultiplied colours as they are, straight ones as straight",
        _recolored(_premultiplied),
        _find_partly,
        put_right=_recolored(_straight),
        sampled=False,
    ),
    Fault(
        "straight_alpha",
        "the picture's colours are straight, not premultiplied by alpha",
        "multiply them by alpha",
        _recolored(_straight),
        _find_partly,
        put_right=_recolored(_premultiplied),
        sampled=False,
    ),
    Fault(
        "rounding_level",
        "the picture's colours are rounded to 8 bits, up to {levels:.0f} more level off",
        "round, do not cut off; or store 16 bits or floats",
        _of_levels,
        _of_8_bits,
        ("levels",),
        put_right=_of_levels,
    ),
    Fault(
        "filter_radius",
        "the picture is filtered: its pixels mix what is within {radius:g} px",
        "render one sample in each pixel's centre, or compare with --filter {radius:g}",
        _filtered,
        _find_filter,
        ("radius",),
        put_right=_filtered,
        sampled=False,
        effort=4,
        everywhere=True,
    ),
    *PIXEL_FAULTS,
)

"""Faults of all colours of a picture by a transform: gamma, exposure, channels, roundings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...arrays import Array
from ...causes.case import Case
from ...causes.checks.color import find_transform
from ...pictures.curves import ADVICE, FITTED_SHARE, KEYS, ROUNDED, ROUNDED_ONCE
from ...pictures.picture import Curve
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Example, Fault, Guess
from .recolor import recolored
from .surfaces import agree, inside, surfaces

_WHY = {  # for each of `KEYS`, why it happens, and who has seen it
    "channels": (
        "OpenCV and BMP files have blue first, most others red.",
        "unrealcv/unrealcv#100",
    ),
    "gamma": (
        "A screen's gamma was applied to linear values, or undone.",
        "baldurk/renderdoc#2787",
    ),
    "srgb_twice": (
        "The renderer wrote sRGB values, and the program that saved or read them took "
        "them for linear ones.",
        "gscept/nebula#228",
    ),
    "srgb_left_out": (
        "Linear values were written unchanged into a file of 8 bits, which is read as sRGB.",
        "miloyip/light2d#3",
    ),
    "power_for_srgb": (
        "A power of 2.2 is close to sRGB's curve, which is linear near black and "
        "then has an exponent of 2.4.",
        "ppy/osu-framework#283",
    ),
    "cut_off": (
        "`int(255 * x)` and numpy's `astype(uint8)` cut off instead of rounding.",
        "marcinz606/NegPy#897",
    ),
    "coded_gamma": (
        "The *Gamma* of Blender's color management, or of a viewer, is applied to the "
        "displayed values.",
        "ChaosGroup/blender_with_vray_additions#216",
    ),
    "exposure": (
        "Blender's color management, cameras and tone mappers have an exposure.",
        "LuxCoreRender/LuxCore#119",
    ),
    "view_transform": (
        "A new scene in Blender has the view transform AgX (Filmic from 2.80 to "
        "3.6), and every PNG is saved with it.",
        "appleseedhq/blenderseed#486",
    ),
    "rounding_level": (
        "Linear values were rounded to 8 bits of sRGB's curve, and read as floats again.",
        "Tom94/tev#150",
    ),
}


def _gamma(color: Array) -> Array:
    color = color.copy()
    color[..., :3] = np.sign(color[..., :3]) * np.abs(color[..., :3]) ** np.float32(1 / 2.2)
    return color


def _curve_of(evidence: Evidence) -> Work[Curve | None]:
    """Return the transform that makes most unexplained surfaces agree (cached)."""
    picture, more = evidence.picture, evidence.case.curves or ()
    if picture.transform is not None or picture.lit:
        return None
    finding = find_transform(evidence.frame, picture, inside(evidence), more)
    return (yield from evidence.done_once("curve", finding))


def _rounded(evidence: Evidence) -> Sequence[Curve]:
    """Return the transforms with roundings to 8 bits that explain more than one rounding.

    Where one rounding explains all, two must not be reported.
    """
    found = surfaces(evidence)
    if found is None:
        return ()
    once = (agree(evidence.picture, found, ROUNDED_ONCE.of) & found.wrong).sum()
    return [
        c
        for c in (ROUNDED_ONCE, *ROUNDED)
        if (same := agree(evidence.picture, found, c.of)).mean() > FITTED_SHARE
        and (same & found.wrong).sum() > (once if c is not ROUNDED_ONCE else 0)
    ]


@dataclass(frozen=True, eq=False)
class OfCurve(Guess):
    """A transform of the picture's colours."""

    curve: Curve


def _through(case: Case, guess: OfCurve) -> Case:
    return replace(case, picture=replace(case.picture, transform=guess.curve.of))


def _find_curve(key: str, evidence: Evidence) -> Work[list[OfCurve]]:
    best = yield from _curve_of(evidence)
    rounded = evidence.once("rounded", lambda: _rounded(evidence))
    return [OfCurve(c, words=c.name) for c in (best, *rounded) if c and c.key == key]


def _colors(key: str) -> Fault[OfCurve]:
    why, witness = _WHY[key]
    return Fault(
        key,
        "the picture's colours: {words}",
        why,
        ADVICE,
        _through,
        partial(_find_curve, key),
        examples=tuple(example for example in _EXAMPLES if example.name == key),
        words=KEYS[key],
        witness=witness,
    )


_EXAMPLES = (
    Example("gamma", "a gamma of 2.2 applied to the picture", make=recolored(_gamma)),
    Example("channels", "red and blue swapped", make=recolored(lambda c: c[..., [2, 1, 0, 3]])),
)
CURVE_FAULTS = (*map(_colors, KEYS),)

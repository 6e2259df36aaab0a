"""Changes a picture's colours, or takes a change of them out of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array, Colors
from ...causes.case import Case
from ...images import EIGHT_BITS
from ...pictures.picture import Picture, Transform, straight
from .fault import Guess, Make


def alpha_multiplied(color: Array) -> Array:
    """Return RGBA (..., 4) with its alpha multiplied in."""
    return np.concatenate((color[..., :3] * color[..., 3:], color[..., 3:]), axis=-1)


def alpha_divided(color: Array) -> Array:
    """Return RGBA (..., 4) with its alpha divided out."""
    return np.concatenate((straight(color), color[..., 3:]), axis=-1)


def recolored(change: Callable[[Array], Array]) -> Make[Guess]:
    """Return what changes the picture's colours, and its background, if it has one of its own."""

    def make(case: Case, guess: Guess) -> Case:
        picture = case.picture
        beneath = None if picture.beneath is None else change(picture.beneath)
        changed = replace(picture, color=change(picture.color), beneath=beneath)
        case = replace(case, picture=changed)
        return case if picture.background is None else case.before(change(picture.background))

    return make


def of_straight(change: Callable[..., Array]) -> Make[Guess]:
    """Return what changes straight RGB by a function of it and the guess' numbers."""

    def make(case: Case, guess: Guess) -> Case | None:
        def changed(color: Array) -> Colors:
            rgb = change(straight(color), *guess.values) * color[..., 3:]
            return np.concatenate((rgb, color[..., 3:]), axis=-1, dtype=np.float32)

        return recolored(changed)(case, guess)

    return make


def by_curve(case: Case, of: Transform) -> Case:
    """Return the case whose traced colours go through what was done to the picture's."""
    return replace(case, picture=replace(case.picture, transform=of))


def with_slack(picture: Picture, slack: float) -> Picture:
    """Return a picture that may be as many levels of 8 bits off, beyond its rounding to these."""
    if slack < 0:
        return picture
    return replace(picture, levels=picture.levels or EIGHT_BITS, dither=picture.dither + slack)

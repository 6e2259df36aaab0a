"""Changes the colours of a picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...arrays import Array, by_runs
from ...causes.case import Case
from ...pictures.picture import straight
from .fault import Guess, Make


def alpha_multiplied(color: Array) -> Array:
    """Premultiply RGBA (..., 4) by its alpha."""
    return np.concatenate((color[..., :3] * color[..., 3:], color[..., 3:]), axis=-1)


def alpha_divided(color: Array) -> Array:
    """Divide RGBA (..., 4) by its alpha."""
    return np.concatenate((straight(color), color[..., 3:]), axis=-1)


def recolored(of_pixels: Callable[[Array], Array]) -> Make[Guess]:
    """Return a function that changes the colours of a picture and of its own background.

    Equal colours are changed alike: one of each run of equal pixels is changed.
    """

    def change(color: Array) -> Array:
        flat = color.reshape(-1, color.shape[-1])
        return by_runs(of_pixels, flat).reshape(color.shape)

    def make(case: Case, guess: Guess) -> Case:
        picture = case.picture
        drawn = picture.drawn
        if drawn and drawn.beneath is not None:
            drawn = replace(drawn, beneath=change(drawn.beneath))
        changed = replace(picture, color=change(picture.color), drawn=drawn)
        case = replace(case, picture=changed)
        return case if picture.background is None else case.before(change(picture.background))

    return make

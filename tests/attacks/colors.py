"""Attacks that change the whole picture, or the colours of objects."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from reference_tracer.files.images import curve
from reference_tracer.pictures.identity import UNKNOWN

from .subject import Attacked, Make, Subject, damaged, neighbours

SEED = 12


# The whole picture


def moved(pixels: int) -> Make:
    def make(subject: Subject) -> Attacked:
        def shift(values: NDArray) -> NDArray:
            pad = [(0, 0), (pixels, 0)] + [(0, 0)] * (values.ndim - 2)
            return np.pad(values, pad, mode="edge")[:, :-pixels]

        return rearranged(shift)(subject)

    return make


def rearranged(change: Callable[[NDArray], NDArray]) -> Make:
    def make(subject: Subject) -> Attacked:
        owner = subject.owner
        return damaged(
            subject, change(subject.picture.color), None if owner is None else change(owner)
        )

    return make


def half_pixel(subject: Subject) -> Attacked:
    """Resample the picture half a pixel to the right, bilinearly."""
    color, owner = subject.picture.color, subject.owner
    color = (color + neighbours(color, 1, 1)) / 2
    if owner is not None:
        owner = np.where(owner == neighbours(owner, 1, 1), owner, UNKNOWN)
    return damaged(subject, color, owner)


def noise(subject: Subject) -> Attacked:
    """Random colours, and random objects."""
    rng, right = np.random.default_rng(SEED), subject.picture
    color = rng.uniform(0.01, 0.99, right.color.shape)
    color[..., 3] = 1
    count = len(right.owners.names) if right.owners else 1
    return damaged(subject, color, rng.integers(-1, max(count, 1), color.shape[:2]))


# Colours


def halved(rgb: NDArray) -> NDArray:
    return 0.5 * rgb


def exposed(rgb: NDArray) -> NDArray:
    return 2.0**0.75 * rgb


def gamma(rgb: NDArray) -> NDArray:
    return np.maximum(rgb, 0) ** 1.8


def swapped(rgb: NDArray) -> NDArray:
    return rgb[..., ::-1]


def encoded_twice(rgb: NDArray) -> NDArray:
    return curve(np.clip(rgb, 0, 1))


SHADES = {
    "halved": halved,
    "exposed": exposed,
    "gamma": gamma,
    "swapped": swapped,
    "encoded_twice": encoded_twice,
}


def shaded(color: NDArray, change: Callable[[NDArray], NDArray]) -> NDArray:
    """Return premultiplied colours (..., 4) with their straight RGB changed."""
    alpha = color[..., 3:].astype(np.float64)
    rgb = color[..., :3] / np.where(alpha > 0, alpha, 1)
    return np.concatenate((change(rgb) * alpha, alpha), axis=-1).astype(np.float32)


def target(subject: Subject) -> int | None:
    """Return the object to be recoloured: one of many, and not the largest."""
    return subject.seen[1] if len(subject.seen) > 2 else None


def one_recoloured(change: Callable[[NDArray], NDArray]) -> Make:
    """Show one object of many in another shade; whose surfaces are shown stays."""
    return _recoloured(change, True)


def all_but_one(change: Callable[[NDArray], NDArray]) -> Make:
    """Transform the whole picture, but leave one object out."""
    return _recoloured(change, False)


def _recoloured(change: Callable[[NDArray], NDArray], alone: bool) -> Make:
    """Change the shade of one object of many alone, or of all that it is not."""

    def make(subject: Subject) -> Attacked | None:
        number = target(subject)
        if number is None:
            return None
        right = subject.picture.color
        own = (subject.object == number)[..., None]
        made = damaged(subject, np.where(own == alone, shaded(right, change), right))
        return made._replace(object=subject.name(number))

    return make


def all_recoloured(change: Callable[[NDArray], NDArray]) -> Make:
    """Transform the whole picture: that is a transform, and no attack."""
    return lambda subject: damaged(subject, shaded(subject.picture.color, change))

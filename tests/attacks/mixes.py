"""Attacks on a picture that says it was anti-aliased: colours that are no mix."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from reference_tracer.pictures.identity import UNKNOWN
from reference_tracer.pictures.metrics import boundary

from .subject import Attacked, Subject, damaged

ROWS = 8  # in which mixes are attacked: a check of one asks for hundreds of samples
FILTER = 1.5  # pixels: the anti-aliasing that an attack claims to have


def _filtered(made: Attacked) -> Attacked:
    """Say of a wrong picture that it was anti-aliased."""
    picture = made.case.picture
    sampling = replace(picture.sampling, filter_radius=FILTER)
    case = replace(made.case, picture=replace(picture, sampling=sampling))
    return made._replace(case=case)


def _outside(subject: Subject, color: NDArray) -> NDArray[np.bool_]:
    """Return which colours (h, w, 4) are surely no mix of what the filter may reach.

    One channel lies beyond all colours that are seen within 3 pixels, or that an object has whose
    box reaches there (it may shine through a crack), by more than a mix is allowed to be off.
    """
    padded = np.pad(subject.frame.color, ((3, 3), (3, 3), (0, 0)), mode="edge")
    around = np.lib.stride_tricks.sliding_window_view(padded, (7, 7), axis=(0, 1))
    low, high = around.min(axis=(-2, -1)), around.max(axis=(-2, -1))
    for least, most, near in subject.reaches:
        low[near], high[near] = np.minimum(low[near], least), np.maximum(high[near], most)
    margin = 2.0**-5 * np.maximum(1, np.abs(color).max(axis=-1, keepdims=True))
    return ((color < low - margin) | (color > high + margin)).any(axis=-1)


def _no_mix(subject: Subject, color: NDArray, where: NDArray[np.bool_]) -> Attacked | None:
    """Show colours where they are no mix; say that the picture was anti-aliased."""
    where = where & _outside(subject, color) & subject.decidable
    inner = np.zeros(where.shape, bool)
    inner[4:-4, 4:-4] = True  # beyond the rim may be objects that no pixel shows
    where &= inner
    rows = np.convolve(where.sum(axis=1), np.ones(ROWS), "same")
    where[np.abs(np.arange(len(where)) - rows.argmax()) > ROWS // 2] = False
    if not where.any():
        return None
    owner = subject.owner
    owner = None if owner is None else np.where(where, UNKNOWN, owner)
    color = np.where(where[..., None], color, subject.picture.color)
    return _filtered(damaged(subject, color, owner))


def overshot(subject: Subject) -> Attacked | None:
    """Sharpen edges: colours beyond both of what is mixed there; whose they are is not known."""
    color = subject.picture.color
    mean = sum(np.roll(color, (y, x), (0, 1)) for y in (-1, 0, 1) for x in (-1, 0, 1)) / 9
    sharp = np.maximum(color + 0.8 * (color - mean), 0)
    sharp[..., 3] = color[..., 3]
    return _no_mix(subject, sharp, boundary(subject.frame))


def beyond_the_filter(subject: Subject) -> Attacked | None:
    """Smear edges by 15 x 15 pixels: as far as no sample of the filter reaches."""
    color = subject.picture.color
    for axis in (0, 1):
        pad = [(7, 7) if axis == n else (0, 0) for n in range(3)]
        wide = np.lib.stride_tricks.sliding_window_view(np.pad(color, pad, "edge"), 15, axis)
        color = wide.mean(axis=-1)
    return _no_mix(subject, color, np.ones(color.shape[:2], bool))


def of_no_one_near(subject: Subject) -> Attacked | None:
    """Edges in the colour of a third object, which no filter reaches from there."""
    rim = boundary(subject.frame)
    for number in subject.seen:
        there = tuple(np.argwhere((subject.object == number) & subject.decidable)[0])
        color = np.broadcast_to(subject.picture.color[there], subject.picture.color.shape)
        if (rim & _outside(subject, color)).sum() > rim.sum() / 4:
            return _no_mix(subject, color, rim)
    return None

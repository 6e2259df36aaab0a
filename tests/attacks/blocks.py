"""Attacks along edges and in blocks: few pixels, in the colour of what is near."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from reference_tracer.pictures.identity import NOTHING

from .subject import Attacked, Subject, damaged, neighbours, painted
from .surfaces import without_object

BLOCK, BLOCKS = 5, 4  # pixels a side, how many
SEED = 12


def _spread(subject: Subject, own: NDArray[np.bool_]) -> Attacked:
    """Draw what is in a mask (h, w) one pixel wider all around."""
    color, owner = subject.picture.color.copy(), subject.owner
    owner = None if owner is None else owner.copy()
    left = ~own
    for axis, step in ((1, 1), (1, -1), (0, 1), (0, -1)):
        take = left & neighbours(own, step, axis)
        color[take] = neighbours(subject.picture.color, step, axis)[take]
        if owner is not None:
            owner[take] = neighbours(subject.owner, step, axis)[take]
        left &= ~take
    return damaged(subject, color, owner)


def grown(subject: Subject) -> Attacked | None:
    """Draw an object one pixel wider all around: a line along its edge in its own colour."""
    return _spread(subject, subject.object == subject.seen[0]) if subject.seen else None


def shrunk(subject: Subject) -> Attacked | None:
    """Draw an object one pixel narrower: its outermost pixels show what is beside it."""
    return _spread(subject, subject.object != subject.seen[0]) if subject.seen else None


def blocks_within(allowed: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return some blocks within a mask (h, w): wholly, as far as there is room."""
    rng, out = np.random.default_rng(SEED), np.zeros(allowed.shape, bool)
    windows = np.lib.stride_tricks.sliding_window_view(allowed, (BLOCK, BLOCK))
    places = np.argwhere(windows.all(axis=(-2, -1)))
    if len(places):
        for y, x in rng.choice(places, BLOCKS):
            out[y : y + BLOCK, x : x + BLOCK] = True
    return out


def blocks_of_another(subject: Subject, allowed: NDArray | bool = True) -> Attacked | None:
    """Blocks inside surfaces, in the colour and as the surface of the object that is seen next."""
    color, owner = subject.picture.color.copy(), subject.owner
    owner = None if owner is None else owner.copy()
    where = blocks_within(subject.inside & (subject.object >= 0) & allowed)
    if len(subject.seen) < 2 or not where.any():
        return None
    number = np.full(len(subject.scene.objects) + 1, subject.seen[0])
    number[subject.seen] = np.roll(subject.seen, -1)
    of = number[subject.object]
    for other in np.unique(of[where]):
        own = np.argwhere((subject.object == other) & subject.decidable)[0]
        color[where & (of == other)] = subject.picture.color[tuple(own)]
        if owner is not None:
            owner[where & (of == other)] = subject.owner[tuple(own)]
    return damaged(subject, color, owner)


def blocks_of_what_is_behind(subject: Subject) -> Attacked | None:
    """Holes in a surface, through which one sees what lies behind the object."""
    for number in subject.seen[:4]:
        where = blocks_within(subject.inside & (subject.object == number))
        frame, instances = without_object(subject, number)
        behind = instances[frame.instance_index] != NOTHING
        if (where & behind).any():
            return painted(subject, frame, instances, where=where)
    return None

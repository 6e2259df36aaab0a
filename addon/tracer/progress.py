"""Long work in small steps: generators that yield the share of the work that is done, 0 to 1.

The caller decides what to show, and stops the work by not asking for the next step. A share may
say in words what is being done, and that nobody knows how long it takes.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Generator, MutableMapping
from contextlib import closing
from functools import wraps
from typing import TYPE_CHECKING, ParamSpec, TypeVar

if TYPE_CHECKING:
    from ..arrays import Array

A = TypeVar("A")
B = TypeVar("B")
P = ParamSpec("P")
T = TypeVar("T")
Work = Generator[float, None, T]
ROWS = 128  # a step, of work on the rows of a picture
LEAST_SHARE = 0.01  # of the work: before, nobody knows how long the rest takes
GROWN = 1.1  # times what was said before: an estimate that is more was no estimate
Steps = Generator[str, None, T]  # each step yields the name of its stage of the work


class Share(float):
    """A share of work, with words for what is being done."""

    doing: str
    known: bool  # whether it says how long the rest takes

    def __new__(cls, share: float, doing: str, known: bool = True) -> Share:
        """Make a share of a number and words."""
        self = super().__new__(cls, share)
        self.doing = doing
        self.known = known
        return self


class Left:
    """How many seconds are left, as far as that is known."""

    def __init__(self) -> None:
        self._least = math.inf  # that was said

    def seconds(self, past: float, share: float) -> float | None:
        """Return the seconds, by those that are past; None if nobody knows.

        What is returned never grows by more than a tenth.
        """
        known = not isinstance(share, Share) or share.known
        left = past * (1 - share) / share if known and share > LEAST_SHARE else math.inf
        if left == math.inf or left > GROWN * self._least:
            return None
        self._least = min(self._least, left)
        return left


def at_once(function: Callable[P, T]) -> Callable[P, Work[T]]:
    """Turn a plain function into work without steps."""

    @wraps(function)
    def work(*args: P.args, **kwargs: P.kwargs) -> Work[T]:
        yield from ()
        return function(*args, **kwargs)

    return work


def doing(share: float) -> str:
    """Return what is being done, in words; empty where nobody says so."""
    return share.doing if isinstance(share, Share) else ""


def called(work: Work[T], words: str, over: bool = True, known: bool = True) -> Work[T]:
    """Run work whose steps say in these words what is being done, over what its parts say.

    `known` says whether they tell how long the rest takes, as far as its parts do.
    """

    def with_words(share: float) -> Share:
        of_part = share if isinstance(share, Share) else Share(share, "")
        return Share(share, (not over and of_part.doing) or words, known and of_part.known)

    return mapped(work, with_words)


def result_of(work: Work[T], progress: Callable[[float], None] | None = None) -> T:
    """Run work to its end, call `progress` with every share, and return the result."""
    with closing(work):  # it may have changed Blender's data, where progress raises
        while True:
            try:
                share = next(work)
            except StopIteration as stop:
                return stop.value
            if progress:
                progress(share)


def mapped(work: Generator[A, None, T], of: Callable[[A], B]) -> Generator[B, None, T]:
    """Run work, and yield a function of what each of its steps yields."""
    while True:
        try:
            found = next(work)
        except StopIteration as stop:
            return stop.value
        yield of(found)


def scaled(work: Work[T], start: float, size: float) -> Work[T]:
    """Run work as a part of larger work: the share `size` of it, from the share `start` on."""

    def of_whole(share: float) -> float:
        whole = start + size * share
        return Share(whole, share.doing, share.known) if isinstance(share, Share) else whole

    return mapped(work, of_whole)


def by_rows(of: Callable[..., Array], *pictures: Array) -> Work[Array]:
    """Return what a function makes of pictures (h, w, ...) row by row, some rows a step."""
    import numpy as np  # late: Blender registers the add-on without numpy

    height = len(pictures[0])
    for bottom in range(0, height, ROWS):
        rows = slice(bottom, bottom + ROWS)
        found = of(*(p[rows] for p in pictures))
        if bottom == 0:
            made = np.empty((height, *found.shape[1:]), found.dtype)
        made[rows] = found
        yield bottom / height
    return made


def timed(steps: Steps[T], stages: MutableMapping[str, float], share: float = 0.0) -> Work[T]:
    """Add the seconds of each step to those of its stage; every step yields the same share."""
    while True:
        began = time.perf_counter()
        try:
            stage = next(steps)
        except StopIteration as stop:
            return stop.value
        stages[stage] = stages.get(stage, 0.0) + time.perf_counter() - began
        yield share


def quiet(work: Work[T]) -> Work[T]:
    """Run work without numpy's warnings: it looks for overflow and NaN itself."""
    import numpy as np  # late: Blender registers the add-on without numpy

    while True:
        try:
            with np.errstate(all="ignore"):
                share = next(work)
        except StopIteration as stop:
            return stop.value
        yield share

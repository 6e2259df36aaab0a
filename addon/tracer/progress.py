"""Long work in small steps: generators that yield events; their value is their result.

An event is `Progress`, where more is known of how far the work is or what it does; `Found`, for a
result that is there before the end; or None, which ends nothing: a step is over. The caller decides
what to show, and stops the work by not asking for more.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from contextlib import closing
from functools import wraps
from typing import TYPE_CHECKING, Any, NamedTuple, ParamSpec, TypeAlias, TypeVar

if TYPE_CHECKING:
    from ..arrays import Array


class Progress(NamedTuple):
    """How far work is, and what is being done."""

    share: float | None  # of the work that is done, 0 to 1; None where nobody knows
    words: str = ""


class Found(NamedTuple):
    """A result that is there before the work has ended."""

    result: Any
    words: str = ""  # for who waits at a terminal


P = ParamSpec("P")
T = TypeVar("T")
Event: TypeAlias = Progress | Found | None
Work = Generator[Event, None, T]
ROWS = 128  # a step, of work on the rows of a picture
LEAST_SHARE = 0.01  # of the work: before, nobody knows how long the rest takes
GROWN = 1.1  # times what was said before: an estimate that is more was no estimate


class Meter:
    """Reads events: how far the work is, what it does, and how long the rest takes."""

    def __init__(self) -> None:
        self.share = 0.0  # never falls
        self.words = ""
        self._is_known = False
        self._least = math.inf  # seconds that were said to be left

    def read(self, event: Event) -> None:
        """Take over what an event says."""
        if isinstance(event, Progress):
            self.words = event.words
            self._is_known = event.share is not None
            self.share = max(self.share, event.share or 0.0)

    def seconds(self, past: float) -> float | None:
        """Return the seconds that are left, by those that are past; None if nobody knows.

        What is returned never grows by more than a tenth.
        """
        is_known = self._is_known and self.share > LEAST_SHARE
        left = past * (1 - self.share) / self.share if is_known else math.inf
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


def result_of(work: Work[T], progress: Callable[[Event], object] | None = None) -> T:
    """Run work to its end, call `progress` with every event, and return the result."""
    with closing(work):  # it may have changed Blender's data, where progress raises
        while True:
            try:
                event = next(work)
            except StopIteration as stop:
                return stop.value
            if progress:
                progress(event)


def scaled(work: Work[T], start: float, size: float | None, words: str = "") -> Work[T]:
    """Run work as a part of larger work: the share `size` of it, from the share `start` on.

    Without a size, nobody knows how long it takes. The words stand before its own.
    """
    unsaid = bool(words)
    while True:
        try:
            event = next(work)
        except StopIteration as stop:
            return stop.value
        if event is None and unsaid:
            event = Progress(0.0)
        if isinstance(event, Progress):
            unsaid = False
            share = None
            if size is not None and event.share is not None:
                share = start + size * event.share
            event = Progress(share, ": ".join(filter(None, (words, event.words))))
        yield event


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
        yield None
    return made

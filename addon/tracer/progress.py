"""Long work as generators: each step yields the share that is done, 0 to 1, and the end returns.

Whoever drives one decides what to show, and stops by not asking for more.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Generator
from typing import TypeVar

A = TypeVar("A")
B = TypeVar("B")
T = TypeVar("T")
Work = Generator[float, None, T]
Steps = Generator[str, None, T]  # of which each says which stage of the work it was


def result_of(work: Work[T], progress: Callable[[float], None] | None = None) -> T:
    """Run work to its end, telling `progress` every share; returns its result."""
    while True:
        try:
            share = next(work)
        except StopIteration as stop:
            return stop.value
        if progress:
            progress(share)


def mapped(
    work: Generator[A, None, T], of: Callable[[A], B], step: Callable[[Generator], A] = next
) -> Generator[B, None, T]:
    """Run work whose steps, taken by `step`, yield what a function makes of what they are."""
    while True:
        try:
            share = step(work)
        except StopIteration as stop:
            return stop.value
        yield of(share)


def scaled(work: Work[T], start: float, size: float) -> Work[T]:
    """Run work as the part of a larger one that begins at `start` and has this size."""
    return mapped(work, lambda share: start + size * share)


def timed(steps: Steps[T], stages: Counter[str], share: float = 0.0) -> Work[T]:
    """Run steps as work of which this share is done, and count the seconds of their stages."""

    def step(steps: Steps[T]) -> float:
        began = time.perf_counter()
        stage = next(steps)
        stages[stage] += time.perf_counter() - began
        return share

    return mapped(steps, float, step)


def quiet(work: Work[T]) -> Work[T]:
    """Run work without numpy's warnings: what over- or underflows is not known, and found out."""
    import numpy as np  # late: to register, Blender needs none

    return mapped(work, float, np.errstate(all="ignore")(next))

"""Counts what work does for each pair of things, which no clock tells."""

from __future__ import annotations

import gc
import sys
import tracemalloc
from collections.abc import Callable
from types import FrameType
from typing import Any


def cost(work: Callable[[], object]) -> tuple[int, int]:
    """Return how many lines of Python some work takes, and the bytes that they allocate.

    Of what is allocated and freed within a line, as numpy's intermediate arrays, the most at a time
    counts. What C does without memory is not seen. Nothing is collected meanwhile: what others left
    would be freed, by their own lines, at any time.
    """
    lines = allocated = last = 0

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        nonlocal lines, allocated, last
        now, peak = tracemalloc.get_traced_memory()
        allocated += peak - last
        lines += 1
        tracemalloc.reset_peak()
        last = now
        return trace

    before = sys.gettrace()
    gc.collect()
    gc.disable()
    tracemalloc.start()
    sys.settrace(trace)
    try:
        work()
    finally:
        sys.settrace(before)
        tracemalloc.stop()
        gc.enable()
    return lines, allocated


def of_each_pair(work_of: Callable[[int], Callable[[], object]], count: int) -> tuple[float, float]:
    """Return the lines and the bytes that work takes for each pair of so many things.

    Of n things, 2 n and 3 n what each takes by itself cancels out: what is left is 2 n^2 of these.
    """
    cost(work_of(2))  # what is imported, or kept from now on
    one, two, three = (cost(work_of(times * count)) for times in (1, 2, 3))
    lines, allocated = (
        (a - 2 * b + c) / (2 * count**2) for a, b, c in zip(one, two, three, strict=True)
    )
    return lines, allocated

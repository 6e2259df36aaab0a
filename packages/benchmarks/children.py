"""Processes of our own, and how all stay on one core."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def one_core() -> Iterator[bool]:
    """Keep this process and those that it starts on one core; says whether that is possible.

    Libraries that would use more threads then share the core.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield False
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})  # the first has the system's own work
    try:
        yield True
    finally:
        os.sched_setaffinity(0, before)

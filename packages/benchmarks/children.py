"""Work that may take too long, and how all processes stay on one core."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from multiprocessing import get_context

LONGEST = 15.0  # seconds for an unproven method's picture: 100,000 slivers would take minutes


def takes_too_long(work: Callable[[], object]) -> bool:
    """Return whether some work takes longer than LONGEST, in a fork of this process."""
    if not hasattr(os, "fork"):
        return False
    child = get_context("fork").Process(target=_silent, args=(work,))
    child.start()
    try:
        child.join(LONGEST)
        return child.is_alive()
    finally:
        child.kill()
        child.join()


def _silent(work: Callable[[], object]) -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C ends it without a word
    work()


@contextmanager
def one_core() -> Iterator[None]:
    """Keep this process and those that it starts on one core, where the system can.

    Libraries that would use more threads then share the core.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})  # the first has the system's own work
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)

"""Processes of our own, and how all stay on one core."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from .peers import MissingPeerError

LONGEST = 15.0  # seconds for an unproven method's picture: 100,000 slivers would take minutes


class Child:
    """A process of its own that calls functions: it may crash, and nobody else notices.

    What it prints is not shown, but for the last line, where it ends by itself.
    """

    def __init__(self) -> None:
        with tempfile.NamedTemporaryFile(prefix="reftrace-bench-", delete=False) as printed:
            self._printed = Path(printed.name)
        context = get_context("spawn")
        self._ours, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, str(self._printed)))
        self._process.start()
        theirs.close()

    def call(self, work: Callable[..., Any], *arguments: Any) -> Any:
        """Return what a function of a module returns, there.

        Raises
        ------
        MissingPeerError
            If it fails, or the process ends.
        """
        try:
            self._ours.send((work, arguments))
            found = self._ours.recv()
        except (EOFError, OSError):
            self._process.join()
            lines = self._printed.read_text("utf-8", "replace").strip().splitlines()
            raise MissingPeerError(lines[-1] if lines else "no message") from None
        if isinstance(found, MissingPeerError):
            raise found
        return found

    @property
    def is_alive(self) -> bool:
        """Whether it may be asked."""
        return self._process.is_alive()

    def end(self) -> None:
        """End it."""
        self._process.kill()
        self._process.join()
        self._ours.close()
        with suppress(OSError):
            self._printed.unlink()


def _serve(theirs: Connection, printed: str) -> None:
    """Answer until nobody asks."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for who started it, and ends it
    with open(printed, "ab") as file:
        for stream in (1, 2):
            os.dup2(file.fileno(), stream)
    with suppress(EOFError):
        while True:
            work, arguments = theirs.recv()
            try:
                found = work(*arguments)
            except Exception as error:  # whoever asks is told, and goes on without
                found = MissingPeerError(f"{type(error).__name__}: {error}")
            sys.stdout.flush()
            theirs.send(found)


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

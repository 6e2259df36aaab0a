"""Hears the signals that end long work: Ctrl-C, and what systems send.

Python turns Ctrl-C into a KeyboardInterrupt at whatever it runs at that moment. Where that is a
callback from C, as in Blender, it is printed and forgotten; in the middle of an import it leaves
half a module. Of other signals it knows nothing, and would die without cleaning up.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass

_NAMED = {"SIGINT": "interrupted", "SIGTERM": "terminated", "SIGHUP": "hung up"}
# Signals that end the work, each with its word: those that this system has.
SIGNALS = {getattr(signal, name): word for name, word in _NAMED.items() if hasattr(signal, name)}


@dataclass
class _Signals:
    """The state of signals, one a process."""

    latest: int = 0
    are_held: bool = False

    def hear(self, number: int, _: object) -> None:
        self.latest = number
        if not self.are_held:
            raise KeyboardInterrupt


_signals = _Signals()


@contextmanager
def heard() -> Iterator[None]:
    """Remember every signal of SIGNALS until the block ends, so that :func:`check` can answer it.

    Nothing is printed then of a KeyboardInterrupt that Python swallows, as in a destructor. A
    handler that someone else has set, and all that is not the main thread, is left alone.
    """
    before = {}
    with suppress(ValueError):  # outside the main thread
        for number in SIGNALS:
            handler = signal.getsignal(number)
            if handler in (signal.SIG_DFL, signal.default_int_handler):
                signal.signal(number, _signals.hear)
                before[number] = handler
    if not before:
        yield
        return
    answered()
    told = sys.unraisablehook

    def unless_heard(swallowed: sys.UnraisableHookArgs) -> None:
        if not issubclass(swallowed.exc_type, KeyboardInterrupt):
            told(swallowed)

    sys.unraisablehook = unless_heard
    try:
        yield
    finally:
        sys.unraisablehook = told
        for number, handler in before.items():
            signal.signal(number, handler)
        answered()  # what comes later is not meant


def check() -> None:
    """Raise the KeyboardInterrupt that was swallowed or held."""
    if _signals.latest:
        raise KeyboardInterrupt


def answered() -> None:
    """Forget the signal that was heard: what it was to end has ended, and the rest goes on."""
    _signals.latest = 0


def ended() -> tuple[int, str]:
    """Return the exit code, as shells have it, of what a KeyboardInterrupt ended, and a word."""
    number = signal.Signals(_signals.latest or signal.SIGINT)
    return 128 + number, SIGNALS[number]


@contextmanager
def held() -> Iterator[None]:
    """Hold signals back until the block, and those around it, have ended without an error."""
    before = _signals.are_held
    _signals.are_held = True
    try:
        yield
    finally:
        _signals.are_held = before
    if not before:
        check()

"""Ctrl-C and its like, heard wherever they fall, and the bar of long work that they end.

Python turns Ctrl-C into a KeyboardInterrupt at whatever it runs at that moment. Where that is a
callback from C, as in Blender, it is printed and forgotten; in the middle of an import it leaves
half a module. Of other signals it knows nothing, and would die without cleaning up.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

_NAMED = {"SIGINT": "interrupted", "SIGTERM": "terminated", "SIGHUP": "hung up"}
# What ends the work, and in what word: those that this system has.
SIGNALS = {getattr(signal, name): word for name, word in _NAMED.items() if hasattr(signal, name)}

_heard = 0  # the latest signal
_holding = False


@contextmanager
def heard() -> Iterator[None]:
    """Remember every signal of SIGNALS until the block ends, so that :func:`check` can answer it.

    A handler that someone else has set, and all that is not the main thread, is left alone.
    """
    before = {}
    with suppress(ValueError):  # outside the main thread
        for number in SIGNALS:
            handler = signal.getsignal(number)
            if handler in (signal.SIG_DFL, signal.default_int_handler):
                signal.signal(number, _hear)
                before[number] = handler
    if not before:
        yield
        return
    answered()
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        answered()  # what comes later is not meant


def _hear(number: int, _: object) -> None:
    global _heard
    _heard = number
    if not _holding:
        raise KeyboardInterrupt


def check() -> None:
    """Raise the KeyboardInterrupt that was swallowed or held."""
    if _heard:
        raise KeyboardInterrupt


def answered() -> None:
    """Forget the signal that was heard: what it was to end has ended, and the rest goes on."""
    global _heard
    _heard = 0


def ended() -> tuple[int, str]:
    """Return the exit code, as shells have it, of what a KeyboardInterrupt ended, and a word."""
    number = signal.Signals(_heard or signal.SIGINT)
    return 128 + number, SIGNALS[number]


@contextmanager
def held() -> Iterator[None]:
    """Let signals wait until the block, and each one around it, has ended without an error."""
    global _holding
    before, _holding = _holding, True
    try:
        yield
    finally:
        _holding = before
    if not _holding:
        check()


@contextmanager
def progress_bar() -> Iterator[Callable[[float], None]]:
    """Show a bar on standard error, if it is a terminal and tqdm is there."""
    check()
    try:
        from tqdm import tqdm
    except ImportError:
        if sys.stderr.isatty():
            why = "no progress bar without tqdm: pip install 'reference_tracer[progress]'"
            print(f"reftrace: {why}", file=sys.stderr)
        yield lambda share: check()
        return
    layout = "{percentage:3.0f} %|{bar}| {elapsed}, {remaining} left"
    with tqdm(total=1.0, bar_format=layout, disable=None, leave=False) as bar:

        def show(share: float) -> None:
            check()
            bar.update(share - bar.n)

        yield show

"""Ctrl-C, heard wherever it falls, and the bar of long work that it ends.

Python turns Ctrl-C into a KeyboardInterrupt at whatever it runs at that moment. Where that is a
callback from C, as in Blender, it is printed and forgotten; in the middle of an import it leaves
half a module.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress

_heard = False
_holding = False


@contextmanager
def heard() -> Iterator[None]:
    """Remember every Ctrl-C until the end of the block, so that :func:`check` can answer it.

    A handler that someone else has set, and all that is not the main thread, is left alone.
    """
    ours = False
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        with suppress(ValueError):  # outside the main thread
            signal.signal(signal.SIGINT, _hear)
            ours = True
    if not ours:
        yield
        return
    answered()
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        answered()  # what comes later is not meant


def _hear(*_: object) -> None:
    global _heard
    _heard = True
    if not _holding:
        raise KeyboardInterrupt


def check() -> None:
    """Raise the KeyboardInterrupt that was swallowed or held."""
    if _heard:
        raise KeyboardInterrupt


def answered() -> None:
    """Forget the Ctrl-C that was heard: what it was to end has ended, and the rest goes on."""
    global _heard
    _heard = False


@contextmanager
def held() -> Iterator[None]:
    """Let Ctrl-C wait until the block, and each one around it, has ended without an error."""
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

"""What every command line does around its work: hears signals, prints, and says what is wrong.

Python turns Ctrl-C into a KeyboardInterrupt at whatever it runs at that moment. Where that is a
callback from C, as in Blender, it is printed and forgotten; in the middle of an import it leaves
half a module. Of other signals it knows nothing, and would die without cleaning up. Little is
imported here, so that a Ctrl-C is heard while the rest is.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from dataclasses import dataclass
from typing import TextIO

from ..wording import show, shown

_NAMED = {"SIGINT": "interrupted", "SIGTERM": "terminated", "SIGHUP": "hung up"}
# What ends the work, and in what word: those that this system has.
SIGNALS = {getattr(signal, name): word for name, word in _NAMED.items() if hasattr(signal, name)}

LINE_EVERY = 10.0  # seconds between two lines that say how much is done
LEAST_SHARE = 0.01  # of the work: before, nobody knows how long the rest takes


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


def run(work: Callable[[], int], program: str) -> int:
    """Do the work of a command line, then print what it said; return the exit code.

    Results are in place before anything is said. If nobody reads it, the exit code stays that of
    the work; if it cannot be printed, as to a full disk, that is an error like any other. Where
    argparse ends the work, its SystemExit is passed on.
    """
    _open_streams()
    with heard():
        try:
            return _said(work)
        except KeyboardInterrupt:
            code, word = ended()
            with suppress(OSError):
                show(f"{program}: {word}", file=sys.stderr)
            return code
        except Exception as error:  # Python's own exit code for it, 1, means warnings here
            return _failed(error, program)
        finally:
            _written(sys.stderr, "")


def _failed(error: Exception, program: str) -> int:
    """Say on stderr what is wrong, a fault of ours with its traceback; return the exit code."""
    from ..errors import EXPECTED, show_traceback, words
    from ..pictures.picture import SizeError
    from .parser import INPUT_ERROR, SIZES_DIFFER

    said = words(error)
    with suppress(OSError):  # of stderr itself: there is nowhere else to say it
        if not isinstance(error, EXPECTED):
            show_traceback(error)
            said = f"{type(error).__name__}: {error}"
        show(f"{program}: {said}", file=sys.stderr)
    return SIZES_DIFFER if isinstance(error, SizeError) else INPUT_ERROR


def _open_streams() -> None:
    """Have standard streams, also where whoever has started this closed them.

    No file of ours may become number 1 or 2, into which Blender prints.
    """
    while (null := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(null)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))
        with suppress(AttributeError):  # a script's own stream; another may not have each letter
            getattr(sys, name).reconfigure(errors="backslashreplace")


def keep_stdout() -> None:
    """Leave standard output to what Python prints: what C prints, as Blender does, goes to stderr.

    It is so until the process ends, since C may write what it has buffered only then. It is for
    processes that do nothing else: a script that calls `main` keeps its streams, and its warnings:
    those of numpy, which print its source, are no words for a user.
    """
    _open_streams()
    if not sys.warnoptions:
        warnings.simplefilter("ignore")
    try:
        is_own = sys.stdout.fileno() == 1
    except (AttributeError, OSError):  # a stream without a descriptor, into which no C prints
        return
    if is_own:
        sys.stdout.flush()
        sys.stdout = open(os.dup(1), "w", encoding=sys.stdout.encoding, errors="backslashreplace")
        os.dup2(2, 1)


def _said(work: Callable[[], int]) -> int:
    said = io.StringIO()
    try:
        with redirect_stdout(said):
            return work()
    finally:
        error = _written(sys.stdout, said.getvalue())
        if error and not isinstance(error, BrokenPipeError):
            raise OSError(f"standard output: {error.strerror}; files that were written stay")


def _written(stream: TextIO, text: str) -> OSError | None:
    """Write a stream to its end; return why not, and drop the rest: Python would try it again."""
    try:
        stream.write(text)
        stream.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        return error
    return None


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
    told, sys.unraisablehook = sys.unraisablehook, _unless_heard(sys.unraisablehook)
    try:
        yield
    finally:
        sys.unraisablehook = told
        for number, handler in before.items():
            signal.signal(number, handler)
        answered()  # what comes later is not meant


def _unless_heard(
    told: Callable[[sys.UnraisableHookArgs], object],
) -> Callable[[sys.UnraisableHookArgs], object]:
    """Return what tells of an exception that was swallowed, but for that of a signal."""

    def hook(swallowed: sys.UnraisableHookArgs) -> None:
        if not issubclass(swallowed.exc_type, KeyboardInterrupt):
            told(swallowed)

    return hook


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


named: list[str] = []  # what is done meanwhile, the innermost last


@contextmanager
def meanwhile(words: str) -> Iterator[None]:
    """Name what has no steps that could say how much is done: `watch.py` says it."""
    named.append(words)
    try:
        yield
    finally:
        named.pop()
        check()  # a handler of Blender's may have swallowed it


@contextmanager
def progress_bar(
    clock: Callable[[], float] = time.monotonic,
) -> Iterator[Callable[[float], None]]:
    """Show on standard error how much is done, and what is being done.

    That is a bar on a terminal, if tqdm is there; else a line every LINE_EVERY seconds.
    """
    from ..tracer.progress import doing

    check()
    try:
        from tqdm import tqdm
    except ImportError:
        is_bar = False
    else:
        is_bar = sys.stderr.isatty()
    if not is_bar:
        began = clock()
        lines = 1  # the number of the next one

        def tell(share: float) -> None:
            nonlocal lines
            check()
            past = clock() - began
            if past >= lines * LINE_EVERY:
                lines = int(past / LINE_EVERY) + 1
                said = ", ".join(filter(None, (f"{100 * share:3.0f} %", doing(share))))
                left = f", {past * (1 - share) / share:.0f} s left" if share > LEAST_SHARE else ""
                with suppress(OSError):  # nobody reads it
                    show(f"{said} ({past:.0f} s{left})", file=sys.stderr)

        yield tell
        return
    layout = "{percentage:3.0f} %|{bar}| {elapsed}, {remaining} left{postfix}"
    with tqdm(total=1.0, bar_format=layout, leave=False) as bar:

        def move(share: float) -> None:
            check()
            bar.set_postfix_str(shown(doing(share)), refresh=False)
            bar.update(share - bar.n)

        yield move

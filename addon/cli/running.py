"""Runs a command line's work: hears signals, prints, and reports errors.

Little is imported here, so that a Ctrl-C is heard while the rest is.
"""

from __future__ import annotations

import io
import os
import sys
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout, suppress
from typing import TYPE_CHECKING, Any, TextIO

from ..tracer.signals import check, ended, heard
from ..wording import show, shown

if TYPE_CHECKING:
    from ..tracer.progress import Event, Meter

LINE_EVERY = 10.0  # seconds between two lines that say how much is done


def run(work: Callable[[], int], program: str) -> int:
    """Do the work of a command line, then print its lines; return the exit code.

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
    from ..pictures.source import SizeError
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
) -> Iterator[Callable[[Event], None]]:
    """Show on standard error how much is done, what is being done, and what is found.

    That is a bar on a terminal, if tqdm is there; else a line every LINE_EVERY seconds.
    """
    from ..tracer.progress import Found, Meter

    check()
    began, meter, bar = clock(), Meter(), _bar()
    lines = 1  # the number of the next one

    def read(event: Event) -> None:
        nonlocal lines
        check()
        meter.read(event)
        past = clock() - began
        if isinstance(event, Found) and event.words:
            _tell(event.words)
        if bar is not None:
            bar.set_postfix_str(f"{shown(meter.words)}{_rest(meter, past)}", refresh=False)
            bar.update(meter.share - bar.n)
        elif past >= lines * LINE_EVERY:
            lines = int(past / LINE_EVERY) + 1
            said = ", ".join(filter(None, (f"{100 * meter.share:3.0f} %", meter.words)))
            _tell(f"{said} ({past:.0f} s{_rest(meter, past)})")

    with nullcontext() if bar is None else bar:
        yield read


def _bar() -> Any:
    """Return a bar on a terminal; None where there is no terminal, or no tqdm."""
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    layout = "{percentage:3.0f} %|{bar}| {elapsed}{postfix}"
    if not sys.stderr.isatty():
        return None
    # miniters: words change where the share does not.
    return tqdm(total=1.0, bar_format=layout, leave=False, miniters=0)


def _rest(meter: Meter, past: float) -> str:
    seconds = meter.seconds(past)
    return "" if seconds is None else f", {seconds:.0f} s left"


def _tell(line: str) -> None:
    with suppress(OSError):  # nobody reads it
        show(line, file=sys.stderr)

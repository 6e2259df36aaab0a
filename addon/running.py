"""What every command line does around its work: it hears signals, prints, and says what is wrong.

It imports little, so that a Ctrl-C is heard while the rest is imported.
"""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable
from contextlib import redirect_stdout, suppress

from . import interrupts


def run(work: Callable[[], int], program: str) -> int:
    """Do the work of a command line, then print what it said; return the exit code.

    Results are in place before anything is said. If nobody reads it, the exit code stays that of
    the work; if it cannot be printed, as to a full disk, that is an error like any other. Where
    argparse ends the work, its SystemExit is passed on.
    """
    _open_streams()
    with interrupts.heard():
        try:
            return _said(work)
        except KeyboardInterrupt:
            code, word = interrupts.ended()
            with suppress(OSError):
                print(f"{program}: {word}", file=sys.stderr)
            return code
        except Exception as error:  # Python's own exit code for it, 1, means warnings here
            from .arguments import failed

            return failed(error, program)
        finally:
            _written(sys.stderr, "")


def _open_streams() -> None:
    """Have standard streams, also where whoever has started this closed them.

    No file of ours may become number 1 or 2, into which Blender prints.
    """
    while (null := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(null)
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, "w"))
        with suppress(AttributeError):  # a script's own stream; another may not have each letter
            getattr(sys, name).reconfigure(errors="backslashreplace")


def _said(work: Callable[[], int]) -> int:
    said = io.StringIO()
    try:
        with redirect_stdout(said):
            return work()
    finally:
        error = _written(sys.stdout, said.getvalue())
        if error and not isinstance(error, BrokenPipeError):
            raise OSError(f"standard output: {error.strerror}; files that were written stay")


def _written(stream: io.TextIOBase, text: str) -> OSError | None:
    """Write a stream to its end; return why not, and drop the rest: Python would try it again."""
    try:
        stream.write(text)
        stream.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
        return error
    return None

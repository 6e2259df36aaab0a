"""Says in words what went wrong, and tells a user's mistakes from faults of this program."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Callable

from .certified.arithmetic import AssumptionError
from .files.exr import MissingLibraryError
from .pictures.source import SizeError
from .scene import SceneError
from .tracer.memory import PictureTooLargeError
from .wording import show, shown

# A user can do something about these; any other error is our fault, and its traceback is wanted.
EXPECTED = (SceneError, SizeError, OSError, MemoryError, MissingLibraryError, AssumptionError)


def words(error: BaseException) -> str:
    """Return the message of an error for a user, in one line."""
    text = " ".join(str(error).split())
    if isinstance(error, MemoryError) and not isinstance(error, PictureTooLargeError):
        return f"there is not enough memory{text and f' ({text})'}: choose a smaller size"
    return shown(text or type(error).__name__)  # Blender prints its reports itself


def show_traceback(error: BaseException) -> None:
    """Print where an error was raised, indented: its text may look like any line."""
    lines = "".join(traceback.format_exception(error)).splitlines()
    show(*(f"  {line}" for line in lines), file=sys.stderr)


def failure(work: Callable[..., object], *arguments: object) -> str:
    """Do some work; return in words what went wrong, or "" if nothing did."""
    try:
        work(*arguments)
    except (*EXPECTED, ValueError) as error:
        return words(error)
    except Exception as error:  # the user must hear of any error
        show_traceback(error)
        return f"Reference Tracer failed: {type(error).__name__}: {error}"
    return ""

"""The options of the command lines, `reftrace` and `blender --command`, and what each must be."""

from __future__ import annotations

import argparse
import traceback
from collections.abc import Callable, Iterable

import numpy as np

from ..certified.arithmetic import AssumptionError
from ..compare.picture import SizeError
from ..images import MissingLibraryError
from ..methods import PLAIN, Method
from ..scene import SceneError
from ..tracer.memory import PictureTooLargeError
from ..tracer.settings import Precision, Settings
from .camera_options import CAMERA_OPTIONS, refuse, refuse_camera, typed
from .parser import add_options

# What a user can do something about; all else is a fault of ours, and its traceback is wanted.
EXPECTED = (SceneError, SizeError, OSError, MemoryError, MissingLibraryError, AssumptionError)
_PLAIN = ", ".join(PLAIN)
_SETTINGS = "method", "precision", "samples", "color"

# What a number must be, by its option, where the type alone does not say it.
_RANGES = {
    **dict.fromkeys(("width", "height", "rays", "limit"), (lambda v: v >= 1, "at least 1")),
    **dict.fromkeys(("filter", "dither"), (lambda v: 0 <= v < np.inf, "a number of at least 0")),
    **dict.fromkeys(("eye", "target"), (lambda v: np.isfinite(v).all(), "three finite numbers")),
    "angle": (lambda v: 0 < v < 180, "between 0 and 180 degrees"),
    "frame": (lambda v: abs(v) <= 1048574, "from -1048574 to 1048574, as Blender's frames are"),
    "ortho_scale": (lambda v: v > 0, "above 0, as an orthographic scale is"),
}


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Add what the user can trade; without an option, what the scene stores holds."""
    methods, precisions = ({"choices": [m.value for m in kind]} for kind in (Method, Precision))
    add_options(parser, "settings", method=methods, precision=precisions)


def add_judge(parser: argparse.ArgumentParser, judges: Iterable[str]) -> None:
    """Add which of Blender's pictures, by the names of its judges, to compare with, and how."""
    add_options(parser, "judge", judge={"choices": ["auto", *judges, "all"]})
    parser.set_defaults(self_check=None)


def add_pixel(parser: argparse.ArgumentParser) -> None:
    """Add which pixel is explained, and where that is written."""
    from ..explain.candidates import LIMIT
    from ..explain.writers import WRITERS

    add_options(parser, "pixel", words={"writers": ", ".join(WRITERS), "limit": LIMIT})
    parser.set_defaults(endings={"out": tuple(WRITERS), "reproducer": (".json",)})


def check_options(options: argparse.Namespace) -> None:
    """Find what is wrong with the options themselves, before any work.

    Raises
    ------
    SceneError
        If a number is out of range, a file has another ending than it should, an option would not
        be heard, one that is needed is missing, or a method does not come in the precision.
    """
    for name, (holds, must) in _RANGES.items():
        value = getattr(options, name, None)
        if value is not None and not holds(value):
            shown = f"{value:g}" if isinstance(value, float) else value
            raise SceneError(f"{typed(name)} is {shown}; it must be {must}")
    for name, endings in getattr(options, "endings", {}).items():
        path = getattr(options, name)
        if path and path.suffix.lower() not in endings:
            raise SceneError(f"'{path}' must end in {' or '.join(endings)}")
    _refuse_unheard(options)
    if again := getattr(options, "reproducer", None):
        if options.out and options.out.resolve() == again.resolve():
            raise SceneError(f"--out and --reproducer are the same file, '{options.out}'")
    if getattr(options, "pixel", ()) is None and _suffix(options) != ".json":
        raise SceneError("--pixel X Y says which pixel; 0 0 is the picture's lower left")
    # A .blend stores a method, which may be plain; so may the file that is open in Blender.
    stores = _suffix(options) in (None, ".blend")
    settings_from(options, Settings(Method.TEXTBOOK) if stores else Settings())


def _refuse_unheard(options: argparse.Namespace) -> None:
    """Refuse options that the others leave without a meaning."""
    if (frames := getattr(options, "frames", None)) is not None:
        from ..compare.animation import frames_named

        why = "is for one frame, not for --frames"
        refuse(options, ("frame", "against", "trade", "extremes"), why)
        if options.judge == "all":
            raise SceneError("--judge all is for one frame: name one judge with --frames")
        try:
            frames_named(frames)
        except ValueError as error:
            raise SceneError(f"--frames {error}") from error
    if getattr(options, "against", ""):
        why = "is for Blender's picture, not for one of --against"
        refuse(options, ("judge", "identity", "as_is"), why)
    elif hasattr(options, "against"):
        refuse(options, ("filter", "dither"), "is for a picture of --against")
    refuse_camera(options, _suffix(options))
    if hasattr(options, "pixel") and _suffix(options) == ".json":
        why = f"is not for '{options.scene}', which is one pixel by itself"
        refuse(options, ("pixel", "limit", *CAMERA_OPTIONS), why)


def _suffix(options: argparse.Namespace) -> str | None:
    """Return the ending of the scene's file, None where no file is named."""
    scene = getattr(options, "scene", None)
    return scene and scene.suffix.lower()


def settings_from(options: argparse.Namespace, stored: Settings) -> Settings:
    """Return the stored settings with what the options say in their place.

    Raises
    ------
    SceneError
        If a value is out of range, or the method does not come in the precision.
    """
    given = {name: getattr(options, name, None) for name in _SETTINGS}
    chosen = {name: value for name, value in given.items() if value is not None}
    method = Method(chosen.get("method", stored.method))
    if not method.is_plain:  # float64 in place of another precision that is stored
        if chosen.setdefault("precision", Precision.FLOAT64) != Precision.FLOAT64:
            do = "name a --method with --precision float32"
            if "method" in chosen:
                do = "leave out --precision float32, or name another --method"
            raise SceneError(f"{do}, one of {_PLAIN}: {method} is proven for float64 only")
    try:
        return Settings(**vars(stored) | chosen)
    except ValueError as error:
        raise SceneError(f"--{error}") from error


def printable(text: str) -> str:
    """Return text that only shows: what steers a terminal, or is no letter, is spelt out."""
    return "".join(
        c if c.isprintable() or c in "\n\t" else c.encode("unicode_escape").decode() for c in text
    )


def words(error: BaseException) -> str:
    """Return what a user is told of an error, in one line."""
    text = " ".join(str(error).split())
    if isinstance(error, MemoryError) and not isinstance(error, PictureTooLargeError):
        return f"there is not enough memory{text and f' ({text})'}: choose a smaller size"
    return text or type(error).__name__


def failure(work: Callable[..., object], *arguments: object) -> str:
    """Do some work; returns what went wrong, if something did, in words."""
    try:
        work(*arguments)
    except (*EXPECTED, ValueError) as error:
        return words(error)
    except Exception as error:  # whatever it is, the user must hear of it
        traceback.print_exc()
        return f"Reference Tracer failed: {type(error).__name__}: {error}"
    return ""

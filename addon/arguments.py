"""The options of the command lines, `reftrace` and `blender --command`, and what each must be."""

from __future__ import annotations

import argparse
import traceback
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from .camera_options import CAMERA_OPTIONS, refuse, refuse_camera, typed
from .compare.picture import SizeError
from .images import MissingLibraryError
from .methods import PLAIN, Method
from .scene import SceneError
from .tracer.certified.certainty import AssumptionError
from .tracer.memory import PictureTooLargeError
from .tracer.settings import Precision, Settings

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
    group = parser.add_argument_group("how to trace (by default what the scene says)")
    method = "how a ray meets a triangle; auto is certified wherever this machine allows"
    precision = "floating-point type of rays and vertices; what is certified needs float64"
    samples = "colour is the mean of N x N rays a pixel"
    group.add_argument("--method", choices=[m.value for m in Method], help=method)
    group.add_argument("--precision", choices=[p.value for p in Precision], help=precision)
    group.add_argument("--samples", type=int, metavar="N", help=samples)


def add_judge(parser: argparse.ArgumentParser, judges: Iterable[str]) -> None:
    """Add which of Blender's pictures, by the names of its judges, to compare with, and how."""
    group = parser.add_argument_group("Blender's picture (by default as the scene says)")
    judge = (
        "which of Blender's pictures to compare with; all: a table of every one (and the "
        "viewport's, in a window)"
    )
    as_is = "leave Blender's shading as the scene has it, not like for like"
    identity = "draw once more, a colour an object, to know whose surface each pixel shows"
    self_check = (
        "then make known faults (a pixel off, mirrored, an object left out...) and see that each "
        "is found"
    )
    group.add_argument("--judge", choices=["auto", *judges, "all"], help=judge)
    group.add_argument("--as-is", action="store_true", help=as_is)
    group.add_argument("--identity", action=argparse.BooleanOptionalAction, help=identity)
    group.add_argument("--self-check", action="store_true", default=None, help=self_check)


def add_page(parser: argparse.ArgumentParser) -> None:
    """Add what the page shows beside the comparison, and of which frames there is one."""
    frames = (
        "compare an animation: 1-250, 1-250:5 for every fifth, 7, or all; frames that are whole in "
        "DIR, and made by the same file and options, are not done again"
    )
    parser.add_argument("--frames", metavar="FRAMES", help=frames)
    group = parser.add_argument_group("the page (page.html in DIR)")
    trade = "measure the trade on this scene, too: half a minute"
    extremes = "find where every method breaks: two minutes"
    group.add_argument("--trade", action="store_true", help=trade)
    group.add_argument("--extremes", action="store_true", help=extremes)


def add_pixel(parser: argparse.ArgumentParser) -> None:
    """Add which pixel is explained, and where that is written."""
    from .explain.candidates import LIMIT
    from .explain.writers import WRITERS

    pixel = "0 0 is the picture's lower left"
    out = f"{', '.join(WRITERS)}; without it, Markdown is printed"
    reproducer = (
        "write the pixel's ray and all that it may meet: `reftrace explain FILE.json` derives it "
        "again, without the scene"
    )
    limit = f"show so many triangles at most (default {LIMIT})"
    parser.add_argument("--pixel", type=int, nargs=2, metavar=("X", "Y"), help=pixel)
    parser.add_argument("--out", type=Path, metavar="FILE", help=out)
    parser.add_argument("--reproducer", type=Path, metavar="FILE.json", help=reproducer)
    parser.add_argument("--limit", type=int, metavar="N", help=limit)
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
        from .compare.animation import frames_named

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

"""Options that several commands share: the settings of the tracer, and where the work is done."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ..comparison.animation import frames_named
from ..methods import Method
from ..scene import SceneError
from ..tracer.settings import Precision, Settings
from .parser import INTEGER, Parser

# While it is entered, the parameters that have the work done elsewhere, as by a cluster; or none.
Place = AbstractContextManager[dict[str, Any]]


@dataclass(frozen=True)
class GivenSettings:
    """The settings that a command line names; where it names none, the stored setting stays."""

    method: str | None = None
    precision: str | None = None
    samples: int | None = None
    color: str | None = None

    def over(self, stored: Settings) -> Settings:
        """Return the stored settings with those that are named in their place.

        Raises
        ------
        SceneError
            If a value is out of range, or the method does not come in the precision.
        """
        chosen = {name: value for name, value in vars(self).items() if value is not None}
        if Method(self.method or stored.method).is_proven:
            # The stored setting is that of an unproven method.
            chosen.setdefault("precision", Precision.FLOAT64)
        try:
            return replace(stored, **chosen)
        except ValueError as error:
            raise SceneError(f"--{error}") from error


def add_settings(parser: Parser) -> None:
    """Add the options for the settings of the tracer."""
    group = parser.add_argument_group("how to trace (default: as the scene says)")
    group.add_argument(
        "--method",
        metavar="METHOD",
        choices=[m.value for m in Method],
        help=f"{', '.join(Method)}, which is certified wherever this machine allows a proof",
    )
    group.add_argument(
        "--precision",
        choices=[p.value for p in Precision],
        help="of rays and vertices; certified and auto need float64",
    )
    group.add_argument(
        "--samples", type=INTEGER, metavar="N", help="trace N x N rays a pixel and show their mean"
    )


def settings_from(given: Namespace) -> GivenSettings:
    """Return the settings that a command line names for its scene.

    Raises
    ------
    SceneError
        If a value is out of range, or the method does not come in the precision.
    """
    color = getattr(given, "color", None)
    chosen = GivenSettings(given.method, given.precision, given.samples, color)
    stores = is_blend(given.scene)  # a method, which may be an unproven one
    chosen.over(Settings(Method.TEXTBOOK) if stores else Settings())
    return chosen


def place_from(given: Namespace) -> Place:
    """Return where the work is done: here, unless a package's options say otherwise.

    Such a package adds its options to the parser, and sets the default `place` to a function that
    makes the answer of what was parsed.
    """
    place = getattr(given, "place", None)
    return place(given) if place else nullcontext({})


def refuse(given: object, names: Iterable[str], why: str) -> None:
    """Raise a SceneError if one of these options is given, since it would have no effect."""
    for name in names:
        value = getattr(given, name, None)
        if value is not None and value is not False:  # 0 is given
            typed = f"--{name.replace('_', '-')}"
            raise SceneError(f"{getattr(given, 'typed', {}).get(name, typed)} {why}")


def check_frames(given: Namespace, of_one: Iterable[str]) -> None:
    """Raise a SceneError if --frames names none, or stands beside an option for one frame."""
    refuse(given, ("frame", *of_one), "is for one frame, not for --frames")
    if not is_blend(given.scene):
        raise SceneError(f"--frames is for a .blend: '{given.scene}' has one frame")
    try:
        frames_named(given.frames)
    except ValueError as error:
        raise SceneError(f"--frames {error}") from error


def is_blend(path: Path) -> bool:
    """Return whether a file is Blender's."""
    return path.suffix.lower() == ".blend"

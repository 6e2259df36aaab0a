"""The options of `reftrace compare`, and which of them contradict each other."""

from __future__ import annotations

from argparse import ArgumentTypeError, BooleanOptionalAction, Namespace
from dataclasses import dataclass
from pathlib import Path

from ..framing import Choice
from ..pictures.given import GivenPicture, Making
from ..pictures.palette import By
from ..scene import SceneError
from .arguments import (
    GivenSettings,
    Place,
    add_settings,
    check_frames,
    place_from,
    refuse,
    settings_from,
)
from .camera_options import add_camera, choice_from
from .excuses import add_excuses, making_from
from .parser import Parser

# A frame of an animation stays the same whatever these are.
_NOT_OF_A_FRAME = (
    "scene",
    "out",
    "only_colors",
    "frames",
    "against",
    "data",
    "colors_out",
    "junit",
    "place",
)

# Options that have no effect where the colours alone are written.
_OF_COMPARISON = "judge", "against", "identity", "self_check", "trade", "extremes", "junit"

# Options for a picture of unknown origin.
_OF_GIVEN = "filter", "renderer"
_WHY_GIVEN = "is for a picture of --against, or of an add-on's engine that --judge names"


@dataclass(frozen=True)
class CompareOptions:
    """The options of `reftrace compare`."""

    scene: Path
    out: Path
    only_colors: Path | None  # nothing is compared: the colours are written there
    settings: GivenSettings
    choice: Choice
    # Blender's picture; None for what the scene stores.
    judge: str | None
    as_is: bool
    colors: By | Path | None
    identity: bool | None
    self_check: bool | None
    diagnosis: bool | None
    frames: str | None  # of an animation, as they are typed
    # Another picture, in place of Blender's.
    against: Path | None
    data: GivenPicture | None  # what it holds in place of colours
    making: Making  # how it was made, which excuses a pixel
    colors_out: Path | None  # where the colours are written that it should have
    junit: Path | None  # where the verdict is written as JUnit's XML
    # Studies on the page.
    trade: bool
    extremes: bool
    place: Place

    @classmethod
    def parsed(cls, given: Namespace) -> CompareOptions:
        """Return what was parsed; raises SceneError if options contradict one another."""
        if given.out is None:
            if given.colors_out is None:
                raise SceneError("name a folder with --out, or --colors-out alone for the colours")
            refuse(given, _OF_COMPARISON, "is for a comparison: name its folder with --out")
        _refuse_beside_frames(given)
        if given.judge == "all":
            refuse(given, ("colors_out",), "is for one judge, not for --judge all")
        if given.as_is:
            refuse(given, ("colors", "colors_out"), "is for a picture like for like, not --as-is")
        held = getattr(given, "held", None)  # as `place`, of a package beside the add-on
        if given.against is None:
            _check_judge(given.judge or "auto", given)
            refuse(given, ("dither",), "is for a picture of --against")
        else:
            why = "is for Blender's picture, not for one of --against"
            refuse(given, ("judge", "identity", "as_is"), why)
        return cls(
            scene=given.scene,
            out=given.out or Path(),
            only_colors=None if given.out else given.colors_out,
            settings=settings_from(given),
            choice=choice_from(given, given.scene, given.frames is not None),
            judge=given.judge,
            as_is=given.as_is,
            colors=given.colors,
            identity=given.identity,
            self_check=given.self_check,
            diagnosis=given.diagnosis,
            frames=given.frames,
            against=given.against,
            data=held and held(given),
            making=making_from(given),
            colors_out=given.colors_out,
            junit=given.junit,
            trade=given.trade,
            extremes=given.extremes,
            place=place_from(given),
        )

    def of_a_frame(self) -> dict[str, str]:
        """Return the options that a frame's comparison depends on, in words that can be stored."""
        return {k: str(v) for k, v in vars(self).items() if k not in _NOT_OF_A_FRAME}


def _check_judge(judge: str, given: Namespace) -> None:
    from ..blender.drawing.judges import GIVEN, choices

    if judge.upper() in GIVEN:
        raise SceneError(
            f"--judge {judge} names no engine: name one that an add-on registers, such as "
            "MY_ENGINE, or a picture with --against"
        )
    if judge.lower() in ("auto", "all", *choices()):
        refuse(given, _OF_GIVEN, _WHY_GIVEN)


def _refuse_beside_frames(given: Namespace) -> None:
    if given.frames is None:
        return
    check_frames(given, ("against", "trade", "extremes", "diagnosis", "colors_out"))
    if isinstance(given.colors, Path):
        raise SceneError(f"--colors {given.colors} is for one frame, not for --frames")
    if given.judge == "all":
        raise SceneError("--judge all is for one frame: name one judge with --frames")


def add_options(parser: Parser) -> None:
    """Add the command's options."""
    parser.add_scene("scene.blend; with --against also scene.npz or a mesh")
    parser.add_argument("--out", type=parser.path, metavar="DIR", help="folder for what is found")
    parser.add_argument(
        "--junit",
        type=parser.path_ending(".xml"),
        metavar="FILE",
        help="write the verdict as JUnit's XML, too",
    )
    add_settings(parser)
    _add_colors(parser)
    _add_blenders_picture(parser)
    _add_page(parser)
    _add_against(parser)
    add_camera(parser)


def _add_colors(parser: Parser) -> None:
    def read(text: str) -> By | Path:
        if text in list(By):
            return By(text)
        if text.lower().endswith(".json"):
            return parser.path(text)
        raise ArgumentTypeError(f"'{text}' is none of {', '.join(By)}, and no colors.json")

    group = parser.add_argument_group("the colours of both pictures")
    group.add_argument(
        "--colors",
        type=read,
        metavar="COLORS",
        help="viewport, object (one for each), material, automatic (viewport where these tell "
        "objects apart) or a colors.json (default: the scene's)",
    )
    group.add_argument(
        "--colors-out",
        type=parser.path_ending(".json"),
        metavar="FILE",
        help="write a colors.json; without --out nothing else",
    )


def _add_blenders_picture(parser: Parser) -> None:
    from ..blender.drawing.judges import choices

    names = ", ".join(("auto", *choices()))
    group = parser.add_argument_group("Blender's picture (default: as the scene says)")
    group.add_argument(
        "--judge",
        metavar="JUDGE",
        help=f"what draws it: {names}; an add-on's engine, as MY_ENGINE; or all, in a table",
    )
    group.add_argument(
        "--as-is",
        action="store_true",
        help="leave Blender's shading as it is, not like for like",
    )
    group.add_argument(
        "--identity",
        action=BooleanOptionalAction,
        help="draw it again to know which object a pixel shows",
    )
    group.add_argument(
        "--self-check",
        action="store_true",
        default=None,
        help="see that known faults, such as a pixel off, are found",
    )
    group.add_argument(
        "--diagnosis",
        action=BooleanOptionalAction,
        help="of unexplained pixels (default yes; no of --frames)",
    )
    group.add_argument(
        "--frames",
        metavar="FRAMES",
        help="of an animation: 1-250, 1-250:5, 7, or all; finished ones are not done again",
    )


def _add_page(parser: Parser) -> None:
    parser.add_argument(
        "--trade",
        action="store_true",
        help="also show what each method costs: 15 seconds",
    )
    parser.add_argument(
        "--extremes", action="store_true", help="also show where each breaks: half a minute"
    )


def _add_against(parser: Parser) -> None:
    group = parser.add_argument_group("another picture, in place of Blender's")
    group.add_argument(
        "--against",
        type=parser.path,
        metavar="FILE",
        help="a .png (sRGB) or .exr (linear) of the same camera and size, on a background of one "
        "colour or none",
    )
    add_excuses(group)

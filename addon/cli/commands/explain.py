"""`reftrace explain`: derives one pixel's ray, and prints or writes the derivation."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Sequence
from contextlib import redirect_stdout
from pathlib import Path

from ...derivation import reproducer
from ...derivation.candidates import LIMIT, gather_pixel
from ...derivation.pixel import Pixel
from ...files import exr
from ...framing import Choice
from ...report import pixel
from ...report.folders import place_of
from ...scene import SceneError
from ...wording import show
from ..arguments import refuse
from ..camera_options import CAMERA_OPTIONS, add_camera, choice_from
from ..opening import SOURCES, load
from ..parser import AGREE, COUNT, INTEGER, Parser
from ..running import meanwhile


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(explain, "reftrace explain scene.blend --pixel 480 270 --out pixel.html")
    parser.add_scene(f"{SOURCES}, or a pixel.json that --reproducer wrote")
    parser.add_argument(
        "--pixel",
        type=INTEGER,
        nargs=2,
        metavar=("X", "Y"),
        help="the pixel to explain; 0 0 is the picture's lower left",
    )
    parser.add_argument(
        "--out",
        type=parser.path_ending(*pixel.WRITERS),
        metavar="FILE",
        help=f"{', '.join(pixel.WRITERS)}; without it, Markdown is printed",
    )
    parser.add_argument(
        "--reproducer",
        type=parser.path_ending(".json"),
        metavar="FILE.json",
        help="write the pixel's ray and all that it may meet: `reftrace explain FILE.json` derives "
        "it again, without the scene",
    )
    parser.add_argument(
        "--limit",
        type=COUNT,
        metavar="N",
        help=f"show at most this many triangles (default {LIMIT})",
    )
    add_camera(parser)


def explain(given: Namespace) -> int:
    """Derive, and print or write it."""
    out, again = given.out, given.reproducer
    if out and again and place_of(out) == place_of(again):
        raise SceneError(f"--out and --reproducer are the same file, '{out}'")
    if given.scene.suffix.lower() == ".json":
        why = f"is not for '{given.scene}', which is one pixel by itself"
        refuse(given, ("pixel", "limit", *CAMERA_OPTIONS), why)
        found = reproducer.read(given.scene)
    elif given.pixel is None:
        raise SceneError("--pixel X Y says which pixel; 0 0 is the picture's lower left")
    else:
        choice = choice_from(given, given.scene)
        found = _gathered(given.scene, choice, given.pixel, given.limit or LIMIT)
    show(*pixel.write(found, out, again).removesuffix("\n").split("\n"))
    return AGREE


def _gathered(path: Path, choice: Choice, at: Sequence[int], limit: int) -> Pixel:
    x, y = at
    # Notes, Blender's too, are no part of the Markdown.
    with exr.redirected(1, 2), redirect_stdout(sys.stderr):
        scene, _ = load(path, choice)
    with meanwhile("finding what the ray may meet"):
        return gather_pixel(scene, x, y, limit, path.name)

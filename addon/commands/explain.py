"""`reftrace explain`: one pixel of a scene, step by step."""

from __future__ import annotations

import argparse
import sys
from contextlib import redirect_stdout
from pathlib import Path

from ..arguments import add_camera, refuse
from ..explain import reproducer
from ..explain.candidates import LIMIT, gather
from ..explain.derivation import derive_pixel
from ..explain.document import answer_sentence
from ..explain.output import WRITERS
from ..explain.pixel import Pixel
from ..opening import SOURCES, load
from ..report import folders
from ..scene import SceneError
from .parts import Commands, command


def add(commands: Commands) -> None:
    """Add the command."""
    parser = command(
        commands,
        "explain",
        run,
        "show the maths of one pixel's ray: every step, in float32, float64 and exactly",
        "reftrace explain scene.blend --pixel 480 270 --out pixel.html",
        f"{SOURCES}, or a pixel.json that --reproducer wrote",
    )
    parser.add_argument(
        "--pixel", type=int, nargs=2, metavar=("X", "Y"), help="0 0 is the picture's lower left"
    )
    endings = ", ".join(WRITERS)
    parser.add_argument(
        "--out", type=Path, metavar="FILE", help=f"{endings}; without it, Markdown is printed"
    )
    parser.add_argument(
        "--reproducer",
        type=Path,
        metavar="FILE.json",
        help="write the pixel's ray and all that it may meet: `reftrace explain FILE.json` "
        "derives it again, without the scene",
    )
    parser.add_argument(
        "--limit", type=int, metavar="N", help=f"show so many triangles at most (default {LIMIT})"
    )
    add_camera(parser)


def run(options: argparse.Namespace) -> int:
    """Derive, and print or write it."""
    _check(options)
    pixel = _pixel(options)
    derivation = derive_pixel(pixel)
    files = [(options.reproducer, lambda: reproducer.text(pixel))]
    if options.out:
        files.append((options.out, lambda: WRITERS[options.out.suffix.lower()](derivation)))
    else:
        print(WRITERS[".md"](derivation), end="")
    for path, text in files:
        if path:
            _write(path, text())
    if options.out:
        print(f"{answer_sentence(derivation)} {options.out}")
    return 0


def _check(options: argparse.Namespace) -> None:
    """Find what is wrong with the options before any work."""
    for name, endings in (("out", tuple(WRITERS)), ("reproducer", (".json",))):
        path = getattr(options, name)
        if path and path.suffix.lower() not in endings:
            raise SceneError(f"'{path}' must end in {' or '.join(endings)}")
    if options.limit is not None and options.limit < 1:
        raise SceneError(f"--limit is {options.limit}; it must be at least 1")
    if options.scene.suffix.lower() == ".json":
        own = "width", "height", "eye", "target", "angle", "ortho_scale"
        names = ("pixel", "limit", *own)
        refuse(options, names, f"is not for '{options.scene}', which is one pixel by itself")
    elif options.pixel is None:
        raise SceneError("--pixel X Y says which pixel; 0 0 is the picture's lower left")


def _pixel(options: argparse.Namespace) -> Pixel:
    if options.scene.suffix.lower() == ".json":
        return reproducer.read(options.scene)
    with redirect_stdout(sys.stderr):  # what was exported is no part of the Markdown
        scene, _ = load(options)
    limit = LIMIT if options.limit is None else options.limit
    return gather(scene, *options.pixel, limit, options.scene.name)


def _write(path: Path, text: str) -> None:
    with folders.made_for_file(path), folders.replacing_file(path) as new:
        new.write_text(text, encoding="utf-8")

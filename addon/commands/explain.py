"""`reftrace explain`: one pixel of a scene, step by step."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from pathlib import Path

from ..arguments import CAMERA_OPTIONS, Parser, add_camera, printable, refuse
from ..explain import reproducer
from ..explain.candidates import LIMIT, gather
from ..explain.derivation import derive_pixel
from ..explain.document import answer_sentence
from ..explain.output import WRITERS
from ..explain.pixel import Pixel
from ..opening import SOURCES, load
from ..report import folders
from ..scene import Scene, SceneError
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
    add_options(parser)
    add_camera(parser)


def add_options(parser: Parser) -> None:
    """Add what `blender --command` has, too."""
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


def run(options: argparse.Namespace) -> int:
    """Derive, and print or write it."""
    check_options(options)
    if options.scene.suffix.lower() == ".json":
        why = f"is not for '{options.scene}', which is one pixel by itself"
        refuse(options, ("pixel", "limit", *CAMERA_OPTIONS), why)
        return finish(options, reproducer.read(options.scene))
    with _told_aside():
        scene, _ = load(options)
    return finish(options, pixel_of(options, scene, options.scene.name))


@contextmanager
def _told_aside() -> Iterator[None]:
    """Send what is said meanwhile, by Blender too, to stderr: it is no part of the Markdown."""
    if sys.stdout is None:  # closed by who has started this
        yield
        return
    sys.stdout.flush()
    own = os.dup(1)
    os.dup2(2, 1)
    try:
        with redirect_stdout(sys.stderr):
            yield
    finally:
        os.dup2(own, 1)
        os.close(own)


def check_options(options: argparse.Namespace) -> None:
    """Find what is wrong with the options before any work."""
    for name, endings in (("out", tuple(WRITERS)), ("reproducer", (".json",))):
        path = getattr(options, name)
        if path and path.suffix.lower() not in endings:
            raise SceneError(f"'{path}' must end in {' or '.join(endings)}")
    if options.out and options.reproducer and options.out.resolve() == options.reproducer.resolve():
        raise SceneError(f"--out and --reproducer are the same file, '{options.out}'")
    if options.limit is not None and options.limit < 1:
        raise SceneError(f"--limit is {options.limit}; it must be at least 1")
    scene = getattr(options, "scene", None)
    if options.pixel is None and not (scene and scene.suffix.lower() == ".json"):
        raise SceneError("--pixel X Y says which pixel; 0 0 is the picture's lower left")


def pixel_of(options: argparse.Namespace, scene: Scene, source: str) -> Pixel:
    """Return the pixel of a scene that the options name."""
    limit = LIMIT if options.limit is None else options.limit
    return gather(scene, *options.pixel, limit, source)


def finish(options: argparse.Namespace, pixel: Pixel) -> int:
    """Derive a pixel, and print or write what the options want of it; return the exit code."""
    derivation = derive_pixel(pixel)
    if options.reproducer:
        folders.write_text(options.reproducer, reproducer.text(pixel))
    if not options.out:
        print(printable(WRITERS[".md"](derivation)), end="")
        return 0
    folders.write_text(options.out, WRITERS[options.out.suffix.lower()](derivation))
    print(printable(f"{answer_sentence(derivation)} {options.out}"))
    return 0

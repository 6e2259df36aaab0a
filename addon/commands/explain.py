"""`reftrace explain`: one pixel of a scene, step by step."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout

from ..arguments import add_camera, add_pixel, camera_from, printable
from ..explain import reproducer
from ..explain.candidates import LIMIT, gather
from ..opening import SOURCES, load
from ..report import pixel
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
    add_pixel(parser)
    add_camera(parser)


def run(options: argparse.Namespace) -> int:
    """Derive, and print or write it."""
    path = options.scene
    if path.suffix.lower() == ".json":
        found = reproducer.read(path)
    else:
        with _told_aside():
            scene, _ = load(path, *camera_from(options, path))
        found = gather(scene, *options.pixel, options.limit or LIMIT, path.name)
    print(printable(pixel.write(found, options.out, options.reproducer)), end="")
    return 0


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

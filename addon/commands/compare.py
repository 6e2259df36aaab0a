"""`reftrace compare`: a .blend and Blender's own picture of it."""

from __future__ import annotations

import argparse
import os
from contextlib import suppress
from pathlib import Path

from ..arguments import add_judge, add_page, add_processes, add_settings
from ..opening import open_blend
from ..report import files, folders
from ..report.progress_bar import progress_bar
from ..scene import SceneError
from ..tracer.processes import tracing
from .parts import Commands, command


def add(commands: Commands) -> None:
    """Add the command."""
    parser = command(
        commands,
        "compare",
        run,
        "trace a .blend and compare it with Blender's own picture",
        "reftrace compare scene.blend --out out/",
        "scene.blend",
    )
    parser.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
    add_settings(parser)
    add_processes(parser)
    add_judge(parser)
    add_page(parser)


def run(options: argparse.Namespace) -> int:
    """Compare; the exit code is the verdict's."""
    if options.out.startswith("//"):  # here it is the shell's: Blender's is beside the file
        options.out = os.path.realpath(options.out)
    with folders.made(Path(options.out)):
        try:
            if options.scene.suffix.lower() != ".blend":
                raise SceneError(f"'{options.scene}' is not a .blend: Blender draws only those")
            with open_blend(options.scene):
                from ..blender.commands import compare_open_file

                with tracing(options.processes) as trace, progress_bar() as progress:
                    return compare_open_file(options, progress, trace)
        except Exception as error:
            with suppress(OSError):
                files.write_failure(options.out, error)
            raise

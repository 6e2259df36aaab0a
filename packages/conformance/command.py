"""`reftrace conform`: a renderer or an exporter, judged on forty small scenes."""

from __future__ import annotations

import re
from argparse import Namespace
from difflib import get_close_matches
from pathlib import Path

from reference_tracer.cli.arguments import refuse
from reference_tracer.cli.excuses import FILTER, RENDERER, add_excuses
from reference_tracer.cli.parser import AGREE, EXIT_CODES_HELP, Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of
from reference_tracer.wording import count_of, say, show
from reference_tracer_meshes import FORMATS
from reference_tracer_processes.options import add_limits, limits_of
from reference_tracer_processes.running import check_starts, words_of
from reference_tracer_processes.sandbox import check_shown, sandbox

from . import report
from .judging import OUT, PICTURES, Program, conform
from .kit import FILES, write_kit
from .scenes import KitScene, kit_scenes

_DESCRIPTION = """\
Judge a renderer or an exporter on forty small scenes: cameras, transforms, instances, meshes.

It RUNS the command once for each scene, in a sandbox where bubblewrap is installed: then it reaches
no network and writes to no folder but the scene's. In the command stand for files
"""
MEMORY = 4.0  # GiB, by default
_RUN = "out", "only", "ending", "renderer", "filter", "time_limit", "memory_limit", "no_sandbox"


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        run,
        'reftrace conform "myrender {scene} {out}" --out report/\n  reftrace conform --write kit/',
        EXIT_CODES_HELP,
    )
    names = {f"{{{k}}}": f"{name}: {what}" for k, (name, what) in FILES.items()}
    names[OUT] = "what it has to write: a picture of the camera's size, nothing lit"
    parser.description = _DESCRIPTION + "\n".join(f"  {k:10}{what}" for k, what in names.items())
    parser.add_argument(
        "command", nargs="?", metavar="COMMAND", help="the command, with {out} and files of a scene"
    )
    parser.add_argument(
        "--write", type=parser.path, metavar="DIR", help="write the kit into a folder, run nothing"
    )
    parser.add_argument("--out", type=parser.path, metavar="DIR", help="folder for the report")
    parser.add_argument(
        "--only", nargs="+", metavar="NAME", help="only scenes whose names begin so"
    )
    parser.add_argument(
        "--ending",
        choices=(*PICTURES, *FORMATS),
        help="of {out}: a picture's (default .png), or of an exporter a mesh file's, which is "
        "traced through the scene's camera",
    )
    add_limits(parser, MEMORY)
    parser.add_argument(
        "--no-sandbox",
        action="store_true",
        help="run it outside of the sandbox, as what needs a graphics card or a screen",
    )
    add_excuses(parser, (RENDERER, FILTER))


def run(given: Namespace) -> int:
    """Write the kit, or judge."""
    if given.write:
        if given.command:
            raise SceneError("--write writes the kit and runs nothing: leave out the command")
        refuse(given, _RUN, "is for a run, not for --write")
        return _write(given.write)
    program = _program(given)
    scenes = _chosen(given.only)
    if program.boxed and not sandbox():
        say("the program is not kept from the network or from your files: bubblewrap is missing")
    with folders.made(given.out):
        for name in report.NAMES:  # those of an earlier run would pass for this one's
            (given.out / name).unlink(missing_ok=True)
        work = conform(program, scenes, given.out)
        with progress_bar() as progress:
            results = result_of(work, progress)
        report.write(given.out, program, results)
    show(*report.lines(results))
    show(f"written to {given.out}; open {given.out / report.PAGE} in a browser")
    return report.verdict(results).exit_code


def _write(folder: Path) -> int:
    scenes = kit_scenes()
    with folders.made(folder):
        write_kit(folder, scenes)
    show(f"{count_of(len(scenes), 'scene')} written to {folder}")
    return AGREE


def _program(given: Namespace) -> Program:
    """Return the program to be run.

    Raises
    ------
    SceneError
        If there is none, or no place to write to, the command names no file, or cannot be run.
    """
    if not given.command or not given.out:
        raise SceneError("name the command and --out DIR, or --write DIR for the kit alone")
    try:
        words = words_of(given.command)
    except ValueError as error:
        raise SceneError(f"the command {given.command!r} is not understood: {error}") from error
    if not any(OUT in word for word in words):
        raise SceneError(f"the command names no {OUT}, which is the file that it has to write")
    if not any(f"{{{key}}}" in word for word in words for key in FILES):
        names = ", ".join(f"{{{key}}}" for key in FILES)
        raise SceneError(f"the command names no file of a scene: one of {names}")
    for name in re.findall(r"{(\w+)}", given.command):
        for near in get_close_matches(name, FILES, 1):
            if near != name:
                raise SceneError(f"the command names {{{name}}}; {{{near}}} is the nearest")
    try:
        check_starts(words[0])
        if not given.no_sandbox:
            check_shown(words, ", or add --no-sandbox")
    except ValueError as error:
        raise SceneError(f"the command {given.command!r}: {error}") from error
    return Program(
        given.command,
        words,
        given.ending or PICTURES[0],
        given.renderer or "",
        given.filter or 0.0,
        limits_of(given, MEMORY),
        not given.no_sandbox,
    )


def _chosen(names: list[str] | None) -> tuple[KitScene, ...]:
    """Return the scenes whose names begin with one of these; by default all.

    Raises
    ------
    SceneError
        If a name begins none.
    """
    every = kit_scenes()
    if names is None:
        return every
    for name in names:
        if not any(kit.name.startswith(name) for kit in every):
            known = ", ".join(kit.name for kit in every)
            raise SceneError(f"--only {name}: no scene's name begins so; there are {known}")
    return tuple(kit for kit in every if kit.name.startswith(tuple(names)))

"""`reftrace judge`: students' own ray/triangle tests, judged against exact arithmetic."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

from reference_tracer.cli.arguments import printable
from reference_tracer.cli.camera_options import CAMERA_OPTIONS, add_camera, choice_from, typed
from reference_tracer.cli.commands.parts import command
from reference_tracer.cli.opening import SOURCES, load
from reference_tracer.cli.parser import AGREE, DIFFERENCES, INPUT_ERROR, WARNINGS, Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders
from reference_tracer.scene import Scene, SceneError
from reference_tracer.scene_files import load_scene
from reference_tracer.tracer.progress import Work, result_of, scaled

LEAST_MEMORY = 0.09  # GiB: Python and numpy by themselves take nearly as much
CODES = {"right": AGREE, "boundary": WARNINGS, "wrong": DIFFERENCES, "failed": DIFFERENCES}
_DESCRIPTION = """\
Judge ray/triangle tests that students wrote: files with a function
intersect(origins, directions, triangles) -> t, barycentrics. --template makes one to begin with.

It RUNS their code, in a process of its own with limits of time and memory. That is no sandbox:
the code may read, write and send whatever you may. Read it first, or run this where that is safe.
"""
_CODES = f"""exit codes:
  {AGREE}  all of them are right
  {WARNINGS}  right, but for pixels on edges where float64 may see either surface
  {DIFFERENCES}  one is wrong, or fails
  {INPUT_ERROR}  a file or a scene cannot be read
  130  interrupted by Ctrl-C"""


def add(parser: Parser) -> None:
    """Add the command's options."""
    command(
        parser,
        run,
        "reftrace judge --template my_test.py\n  reftrace judge my_test.py --out out/judged",
    )
    parser.description = _DESCRIPTION
    parser.epilog = f"{parser.epilog.split('exit codes:')[0]}{_CODES}"
    parser.add_argument(
        "files",
        nargs="*",
        type=Path,
        metavar="FILE",
        help=f"students' files (.py), then scenes: {SOURCES}; by default the exercise's four",
    )
    parser.add_argument("--template", type=Path, metavar="FILE", help="write a file to begin with")
    parser.add_argument("--out", metavar="DIR", help="folder for judge.json and judge.html")
    parser.add_argument(
        "--pixels",
        type=int,
        default=20_000,
        metavar="N",
        help="of a scene, about (%(default)s)",
    )
    parser.add_argument(
        "--time-limit",
        type=float,
        default=60.0,
        metavar="S",
        help="seconds for each scene (%(default)g)",
    )
    parser.add_argument(
        "--memory-limit",
        type=float,
        default=2.0,
        metavar="GIB",
        help="memory it may take, where the system can hold it to that (%(default)g)",
    )
    parser.add_argument(
        "--extremes", action="store_true", help="also see how far it holds at the extremes"
    )
    add_camera(parser)


def run(options: argparse.Namespace) -> int:
    """Write the template, or judge and print the tables."""
    if options.template:
        return _write_template(options.template)
    _check(options)
    from . import report
    from . import tables as judge_table
    from .student import Limits

    students, scenes = _sorted(options.files)
    limits = Limits(options.time_limit, int(options.memory_limit * 2**30))
    with folders.made(Path(options.out)) if options.out else nullcontext():
        opened = _opened(scenes, options) or built_in()
        with progress_bar() as progress:
            judgements = result_of(_work(options, students, opened, limits), progress)
        for j in judgements:
            print(printable("\n".join(judge_table.lines(j))), end="\n\n")
        if len(judgements) > 1:
            print("\n".join(judge_table.class_table(judgements)))
        if options.out:
            report.write(options.out, judgements)
            print(f"written to {options.out}")
    return max(CODES[j.verdict] for j in judgements)


Named = tuple[str, Scene, Path]


def _work(
    options: argparse.Namespace, students: list[Path], scenes: Sequence[Named], limits
) -> Work:
    from .checks import make_checks
    from .extremes import extreme_scenes
    from .judging import judge_all
    from .subject import prepare

    subjects = []
    for k, (name, scene, path) in enumerate(scenes):
        work = prepare(name, scene, str(path), options.pixels, _camera_options(options))
        subjects.append((yield from scaled(work, 0.3 * k / len(scenes), 0.3 / len(scenes))))
    hard = (yield from scaled(extreme_scenes(), 0.3, 0.3)) if options.extremes else []
    judging = judge_all(students, make_checks(), subjects, hard, limits)
    return (yield from scaled(judging, 0.6, 0.4))


def built_in() -> list[Named]:
    """Return the exercise's scenes, which need no Blender: what the sample scenes export to."""
    folder = Path(__file__).with_name("scenes")
    return [(path.stem, load_scene(path), path) for path in sorted(folder.glob("*.npz"))]


def _sorted(files: Sequence[Path]) -> tuple[list[Path], list[Path]]:
    """Return students' files and scenes, each once."""
    once = list(dict.fromkeys(files))
    return [f for f in once if f.suffix == ".py"], [f for f in once if f.suffix != ".py"]


def _opened(paths: Sequence[Path], options: argparse.Namespace) -> list[Named]:
    from .names import stems

    out = []
    for name, path in zip(stems(paths), paths, strict=True):
        out.append((name, load(path, choice_from(options, path))[0], path))
    return out


def _camera_options(options: argparse.Namespace) -> tuple[str, ...]:
    """Return the camera's options that were given, as they are typed."""
    out: list[str] = []
    for name in CAMERA_OPTIONS:
        value = getattr(options, name, None)
        if value is True:
            out.append(typed(name))
        elif value is not None and value is not False:
            values = value if isinstance(value, list) else [value]
            out += [typed(name), *map(str, values)]
    return tuple(out)


def _check(options: argparse.Namespace) -> None:
    """Find what is wrong with the options, before any work.

    Raises
    ------
    SceneError
        If no student's file is named, one is not there, or a number is out of range.
    """
    students, _ = _sorted(options.files)
    if not students:
        raise SceneError("name a student's file (.py), or --template FILE to make one")
    for path in students:
        if not path.is_file():
            raise SceneError(f"there is no file '{path}'")
    for name in ("pixels", "time_limit", "memory_limit"):
        value, least = getattr(options, name), LEAST_MEMORY if name == "memory_limit" else 0
        if not least < value < math.inf:
            option = f"--{name.replace('_', '-')}"
            raise SceneError(f"{option} is {value:g}; it must be a finite number above {least:g}")


def _write_template(path: Path) -> int:
    if path.exists():
        raise SceneError(f"'{path}' is there already: it is not overwritten")
    template = Path(__file__).with_name("template.py")
    folders.write_text(path, template.read_text(encoding="utf-8"))
    print(f"{path}: fill in the function, then: reftrace judge {path}", file=sys.stdout)
    return AGREE

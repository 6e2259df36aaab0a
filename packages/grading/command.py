"""`reftrace judge`: students' own ray/triangle tests, judged against exact arithmetic."""

from __future__ import annotations

import math
import sys
from argparse import Namespace
from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from reference_tracer.cli.arguments import refuse, typed
from reference_tracer.cli.camera_options import CAMERA_OPTIONS, add_camera, choice_from
from reference_tracer.cli.opening import SOURCES, load
from reference_tracer.cli.parser import (
    AGREE,
    COUNT,
    DIFFERENCES,
    INPUT_ERROR,
    POSITIVE,
    WARNINGS,
    Parser,
    number,
)
from reference_tracer.cli.running import printable, progress_bar
from reference_tracer.framing import Choice
from reference_tracer.report import folders
from reference_tracer.scene import Scene, SceneError
from reference_tracer.scene_files import load_scene
from reference_tracer.tracer.progress import Work, called, result_of, scaled

if TYPE_CHECKING:
    from .judging import Judgement

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


_MEMORY = number(
    float, lambda v: LEAST_MEMORY < v < math.inf, f"a finite number above {LEAST_MEMORY}"
)


@dataclass(frozen=True)
class JudgeOptions:
    """The options of `reftrace judge`."""

    students: tuple[Path, ...]
    scenes: tuple[tuple[Path, Choice], ...]  # none for the exercise's own
    camera_options: tuple[str, ...]  # those that were given, as they are typed
    out: Path | None
    pixels: int
    time_limit: float  # seconds for each scene
    memory_limit: int  # bytes
    extremes: bool

    @classmethod
    def parsed(cls, given: Namespace) -> JudgeOptions:
        """Return what was parsed.

        Raises
        ------
        SceneError
            If no student's file is named, one is not there, or an option has no effect.
        """
        files = dict.fromkeys(given.files)  # each once
        students = tuple(file for file in files if file.suffix == ".py")
        scenes = tuple(file for file in files if file.suffix != ".py")
        if not students:
            raise SceneError("name a student's file (.py), or --template FILE to make one")
        for path in students:
            if not path.is_file():
                raise SceneError(f"there is no file '{path}'")
        if not scenes:
            refuse(given, CAMERA_OPTIONS, "is for scenes of your own: name one")
        return cls(
            students=students,
            scenes=tuple((path, choice_from(given, path)) for path in scenes),
            camera_options=_camera_options(given),
            out=given.out,
            pixels=given.pixels,
            time_limit=given.time_limit,
            memory_limit=int(given.memory_limit * 2**30),
            extremes=given.extremes,
        )


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        run,
        "reftrace judge --template my_test.py\n  reftrace judge my_test.py --out out/judged",
        _CODES,
    )
    parser.description = _DESCRIPTION
    parser.add_argument(
        "files",
        nargs="*",
        type=Path,
        metavar="FILE",
        help=f"students' files (.py), then scenes: {SOURCES}; default: the exercise's four scenes",
    )
    parser.add_argument(
        "--template", type=parser.path, metavar="FILE", help="write a file to begin with"
    )
    parser.add_argument(
        "--out", type=parser.path, metavar="DIR", help="folder for judge.json and judge.html"
    )
    parser.add_argument(
        "--pixels",
        type=COUNT,
        default=20_000,
        metavar="N",
        help="judge about this many pixels of a scene (default %(default)s)",
    )
    parser.add_argument(
        "--time-limit",
        type=POSITIVE,
        default=60.0,
        metavar="S",
        help="seconds for each scene (default %(default)g)",
    )
    parser.add_argument(
        "--memory-limit",
        type=_MEMORY,
        default=2.0,
        metavar="GIB",
        help="memory it may take, where the system can limit it (default %(default)g)",
    )
    parser.add_argument(
        "--extremes", action="store_true", help="also find where it breaks at the extremes"
    )
    add_camera(parser)


def run(given: Namespace) -> int:
    """Write the template, or judge."""
    if given.template:
        return _write_template(given.template)
    return judge(JudgeOptions.parsed(given))


def judge(options: JudgeOptions) -> int:
    """Judge, and print the tables."""
    from . import report
    from . import tables as judge_table

    with folders.made(options.out) if options.out else nullcontext():
        opened = _opened(options.scenes) or built_in()
        with progress_bar() as progress:
            judgements = result_of(_work(options, opened), progress)
        for j in judgements:
            print(printable("\n".join(judge_table.lines(j))), end="\n\n")
        if len(judgements) > 1:
            print("\n".join(judge_table.class_table(judgements)))
        if options.out:
            report.write(options.out, judgements)
            print(f"written to {options.out}")
    return max(CODES[j.verdict] for j in judgements)


Named = tuple[str, Scene, Path]


def _work(options: JudgeOptions, scenes: Sequence[Named]) -> Work[list[Judgement]]:
    from .checks import make_checks
    from .extremes import extreme_scenes
    from .judging import judge_all
    from .student import Limits
    from .subject import prepare

    subjects = []
    for k, (name, scene, path) in enumerate(scenes):
        work = prepare(name, scene, str(path), options.pixels, options.camera_options)
        work = called(work, f"tracing {name}")
        subjects.append((yield from scaled(work, 0.3 * k / len(scenes), 0.3 / len(scenes))))
    hard = (yield from scaled(extreme_scenes(), 0.3, 0.3)) if options.extremes else []
    limits = Limits(options.time_limit, options.memory_limit)
    judging = judge_all(options.students, make_checks(), subjects, hard, limits)
    return (yield from scaled(called(judging, "judging"), 0.6, 0.4))


def built_in() -> list[Named]:
    """Return the exercise's scenes, which need no Blender: what the sample scenes export to."""
    folder = Path(__file__).with_name("scenes")
    return [(path.stem, load_scene(path), path) for path in sorted(folder.glob("*.npz"))]


def _opened(scenes: Sequence[tuple[Path, Choice]]) -> list[Named]:
    from .names import stems

    names = stems([path for path, _ in scenes])
    return [
        (name, load(path, choice)[0], path)
        for name, (path, choice) in zip(names, scenes, strict=True)
    ]


def _camera_options(given: Namespace) -> tuple[str, ...]:
    """Return the camera's options that were given, as they are typed."""
    out: list[str] = []
    for name in CAMERA_OPTIONS:
        value = getattr(given, name)
        if value is True:
            out.append(typed(name))
        elif value is not None and value is not False:
            values = value if isinstance(value, list) else [value]
            out += [typed(name), *map(str, values)]
    return tuple(out)


def _write_template(path: Path) -> int:
    if path.exists():
        raise SceneError(f"'{path}' is there already: it is not overwritten")
    template = Path(__file__).with_name("template.py")
    folders.write_text(path, template.read_text(encoding="utf-8"))
    print(f"{path}: fill in the function, then: reftrace judge {path}", file=sys.stdout)
    return AGREE

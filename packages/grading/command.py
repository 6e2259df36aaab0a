"""`reftrace judge`: what students wrote themselves, judged against exact arithmetic."""

from __future__ import annotations

import os
from argparse import Namespace
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from reference_tracer.cli.camera_options import add_camera, choice_from
from reference_tracer.cli.opening import SOURCES, load
from reference_tracer.cli.parser import (
    AGREE,
    COUNT,
    DIFFERENCES,
    INPUT_ERROR,
    WARNINGS,
    Parser,
)
from reference_tracer.cli.running import progress_bar
from reference_tracer.files.scenes import load_scene
from reference_tracer.framing import Choice
from reference_tracer.report import folders
from reference_tracer.scene import Scene, SceneError
from reference_tracer.tracer.progress import Work, result_of, scaled
from reference_tracer.wording import count_of, say, show
from reference_tracer_processes.options import add_limits, limits_of
from reference_tracer_processes.sandbox import sandbox, secret

from .exchange import EXCHANGES
from .external import Code
from .options import MEMORY, PIXELS, camera_options, checked
from .subjects import NAMES, subject

# As `formats.FORMATS`, which needs all of judging.
FORMATS = "csv", "gradescope", "json", "junit"

if TYPE_CHECKING:
    from .class_folder import ClassFolder
    from .judging import Judgement
    from .report import Student

CODES = {"right": AGREE, "boundary": WARNINGS, "wrong": DIFFERENCES, "failed": DIFFERENCES}
_DESCRIPTION = """\
Judge what students wrote: ray/triangle tests, files with a function
intersect(origins, directions, triangles) -> t, barycentrics, or another --subject.
--template makes a file to begin with.

It RUNS their code, in a process of its own with limits of time and memory, and in bubblewrap where
that works. Elsewhere that is no sandbox: the code may read, write and send whatever you may. Read
it first, or run this where that is safe.
"""
_CODES = f"""exit codes:
  {AGREE}  all of them are right
  {WARNINGS}  right, but for pixels on edges where float64 may see either surface
  {DIFFERENCES}  one is wrong, or fails
  {INPUT_ERROR}  a file or a scene cannot be read
  130  interrupted by Ctrl-C"""


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(
        judge,
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
        "--run",
        dest="programs",
        action="append",
        metavar="COMMAND",
        help="judge a program in any language: a command in which {rays} and {answers} stand for "
        "the files that it reads and writes; may be given several times",
    )
    parser.add_argument(
        "--exchange",
        choices=EXCHANGES,
        help="what these files hold: csv, lines of numbers (default), or raw, float64",
    )
    parser.add_argument(
        "--subject",
        choices=NAMES,
        default="triangle",
        help="what the students' code computes (default %(default)s); --template shows the form",
    )
    parser.add_argument(
        "--template", type=parser.path, metavar="FILE", help="write a file to begin with"
    )
    parser.add_argument(
        "--out",
        type=parser.path,
        metavar="DIR",
        help="folder for judge.html, judge.json and a page for each student; after Ctrl-C the "
        "same command goes on there",
    )
    parser.add_argument(
        "--again", action="store_true", help="judge also those whom the folder has, unchanged"
    )
    parser.add_argument(
        "--format",
        dest="format",
        action="append",
        choices=FORMATS,
        help="write this, too, into the folder: " + ", ".join(FORMATS),
    )
    parser.add_argument(
        "--pixels",
        type=COUNT,
        metavar="N",
        help=f"judge about this many pixels of a scene (default {PIXELS})",
    )
    add_limits(parser, MEMORY)
    parser.add_argument(
        "--jobs",
        type=COUNT,
        metavar="N",
        help="students that are run at a time (default: the cores)",
    )
    add_camera(parser)


def judge(given: Namespace) -> int:
    """Write the template; or judge, and print the tables."""
    if given.template:
        return _write_template(given.template, given.subject)
    from .judging import names
    from .tables import class_table

    students, paths = checked(given)
    scenes = [(path, choice_from(given, path)) for path in paths]
    if not sandbox():
        say(
            "students' code is not kept from the network or from your files, and nothing that was "
            "judged before is believed: bubblewrap is missing"
        )
    submissions = dict(zip(names(students), students, strict=True))
    with folders.made(given.out) if given.out else nullcontext():
        folder = _folder(given, scenes, submissions)
        found = folder.kept_of(submissions) if folder and not given.again else {}
        if found:
            show(f"{count_of(len(found), 'student')} judged before, unchanged: not judged again")
        new = {name: each for name, each in submissions.items() if name not in found}
        if new:
            try:
                found |= _judged(given, scenes, new, folder)
            finally:  # by Ctrl-C, too: who has been judged is not judged again
                if folder:
                    folder.save()
        every = [found[name] for name in submissions]
        if len(every) > 1:
            show(*class_table(every))
        if folder:
            folder.write(every, dict.fromkeys(given.format or ()))
            show(f"written to {given.out}")
    return max(CODES[s["verdict"]] for s in every)


Named = tuple[str, Scene, Path]
Scenes = Sequence[tuple[Path, Choice]]


def _folder(
    given: Namespace, scenes: Scenes, submissions: Mapping[str, Code]
) -> ClassFolder | None:
    """Return where the judgements are kept, if anywhere."""
    from .class_folder import ClassFolder

    if given.out is None:
        return None
    files = [(path.read_bytes(), choice) for path, choice in scenes]
    depends = files, given.pixels or PIXELS, limits_of(given, MEMORY)
    return ClassFolder(given.out, subject(given.subject), tuple(submissions), depends, secret())


def _judged(
    given: Namespace,
    scenes: Scenes,
    submissions: Mapping[str, Code],
    folder: ClassFolder | None,
) -> dict[str, Student]:
    """Judge students, print what is said of each, and keep it."""
    from .report import student
    from .tables import lines

    printed: dict[str, list[str]] = {}

    def told(j: Judgement) -> Student:
        printed[j.name] = [*lines(j), ""]
        return folder.keep(submissions[j.name], j) if folder else student(j)

    own = built_in() if given.subject == "triangle" else []
    opened = _opened(scenes) or own
    with progress_bar() as progress:
        found = result_of(_work(given, submissions, opened, told), progress)
    for name in found:
        show(*printed[name])
    return found


def _work(
    given: Namespace,
    submissions: Mapping[str, Code],
    scenes: Sequence[Named],
    told: Callable[[Judgement], Student],
) -> Work[dict[str, Student]]:
    from .judged_scene import prepare
    from .judging import judge_all

    judged = []
    for k, (name, scene, path) in enumerate(scenes):
        work = prepare(name, scene, str(path), given.pixels or PIXELS, camera_options(given))
        share = 0.5 / len(scenes)
        judged.append((yield from scaled(work, k * share, share, f"tracing {name}")))
    cases, limits = subject(given.subject).cases(), limits_of(given, MEMORY)
    jobs = given.jobs or os.cpu_count() or 1
    judging = judge_all(submissions, cases, judged, limits, told=told, jobs=jobs)
    return (yield from scaled(judging, 0.5, 0.5, "judging"))


def built_in() -> list[Named]:
    """Return the exercise's scenes, which need no Blender: what the sample scenes export to."""
    folder = Path(__file__).with_name("scenes")
    return [(path.stem, load_scene(path), path) for path in sorted(folder.glob("*.npz"))]


def _opened(scenes: Scenes) -> list[Named]:
    from .names import stems

    names = stems([path for path, _ in scenes])
    return [
        (name, load(path, choice)[0], path)
        for name, (path, choice) in zip(names, scenes, strict=True)
    ]


def _write_template(path: Path, name: str) -> int:
    if path.exists():
        raise SceneError(f"'{path}' is there already: it is not overwritten")
    template = Path(__file__).with_name("templates") / f"{name}.py"
    folders.write_text(path, template.read_text(encoding="utf-8"))
    option = "" if name == "triangle" else f" --subject {name}"
    show(f"{path}: fill in the function, then: reftrace judge {path}{option}")
    return AGREE

"""Judges a student's file: on the checks, on scenes, and at the extremes.

Whatever the file does wrong is in the `Judgement`: it is never an error of ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from reference_tracer.tracer.progress import Work, scaled

from .answers import Answers
from .checks import Checks
from .examples import Example, find_examples
from .extremes import ExtremeRow, ExtremeScene, try_extremes
from .faults import Fault, dependence, find_faults
from .names import distinct
from .picture import Look, look
from .shared_edges import SharedEdges, try_edges
from .student import Limits, Student
from .student_error import StudentError
from .subject import Subject
from .tally import Tally, score_of

CHECKS = "the checks"  # where an error happened


@dataclass(eq=False)
class Judgement:
    """What is said of one file."""

    path: Path
    name: str  # what a reader calls it
    checks: Tally | None = None  # None: not finished
    faults: list[Fault] = field(default_factory=list)
    edges: SharedEdges | None = None  # None: it failed before
    scenes: list[str] = field(default_factory=list)  # the names of all
    looks: list[Look] = field(default_factory=list)  # of those that were finished
    examples: dict[str, list[Example]] = field(default_factory=dict)  # by the scene's name
    errors: list[tuple[str, StudentError]] = field(default_factory=list)  # where, and what
    extremes: list[ExtremeRow] = field(default_factory=list)
    seconds: float = 0.0  # that the function itself has taken
    printed: int = 0  # bytes
    said: str = ""  # the first of them

    @property
    def tallies(self) -> list[Tally | None]:
        """Those of the checks and of every scene; None where the file has failed."""
        of = {k.subject.name: k.tally for k in self.looks}
        return [self.checks, *(of.get(name) for name in self.scenes)]

    @property
    def score(self) -> float:
        """0 to 100: the mean of the checks and every scene; what has failed counts as 0."""
        return score_of(self.tallies)

    @property
    def leaks(self) -> str:
        """What is to be said of edges between two triangles, if any leaks: it does not count."""
        return self.edges.sentence if self.edges else ""

    @property
    def verdict(self) -> str:
        """Failed, wrong, boundary (where float64 may have it otherwise, it has) or right."""
        if self.errors:
            return "failed"
        if self.faults or not all(t and t.all_right for t in self.tallies):
            return "wrong"
        return "boundary" if any(k.lost for k in self.looks) else "right"


def judge(
    path: Path,
    checks: Checks,
    subjects: Sequence[Subject],
    extremes: Sequence[ExtremeScene] = (),
    limits: Limits | None = None,
    name: str = "",
) -> Work[Judgement]:
    """Judge one file; yields the share of the work done.

    Parameters
    ----------
    path : Path
    checks : Checks
    subjects : sequence of Subject
    extremes : sequence of ExtremeScene
        What is lost there is reported, and does not count in the score.
    limits : Limits, optional
        The time is that of each scene, and of the checks.
    name : str, optional
        What a reader calls it; by default the file's name.
    """
    path = Path(path)
    out = Judgement(path, name or distinct([path])[0], scenes=[s.name for s in subjects])
    with Student(path, limits) as student:
        try:
            _on_checks(out, student, checks)
        except StudentError as error:
            out.errors.append((CHECKS, error))  # it would fail again: the scenes are not tried
            subjects, extremes = (), ()
        size = 0.5 if extremes else 1.0
        for k, subject in enumerate(subjects):
            share = size / len(subjects)
            yield from scaled(_on_scene(out, student, subject), k * share, share)
        if extremes:
            yield from scaled(_on_extremes(out, student, extremes), size, 1 - size)
        out.seconds = student.seconds
    out.printed, out.said = student.printed, student.said  # all of it, now that it has ended
    return out


def _on_checks(out: Judgement, student: Student, checks: Checks) -> None:
    student.new_scene()
    t, s = student.ask(checks.origins, checks.directions, checks.triangles)
    answers = Answers(checks, t, s)
    out.faults = find_faults(answers) + dependence(checks, answers, student.ask)
    out.edges = try_edges(student.ask)
    wrong, known = answers.hit != checks.known.hit, checks.known
    out.checks = Tally.of(
        answers.hit | known.hit,
        wrong,
        known.doubt,
        answers.both,
        ~answers.wrong_t,
        ~answers.wrong_s,
    )


def _on_scene(out: Judgement, student: Student, subject: Subject) -> Work[None]:
    student.new_scene()
    try:
        found = yield from look(subject, student.ask, lambda: student.seconds)
        out.examples[subject.name] = find_examples(found, student.ask)
        out.looks.append(found)
    except StudentError as error:
        out.errors.append((subject.name, error))


def _on_extremes(out: Judgement, student: Student, scenes: Sequence[ExtremeScene]) -> Work[None]:
    try:
        out.extremes = yield from try_extremes(scenes, student.ask, student.new_scene)
    except StudentError as error:
        out.errors.append(("the extremes", error))


def judge_all(
    paths: Sequence[Path],
    checks: Checks,
    subjects: Sequence[Subject],
    extremes: Sequence[ExtremeScene] = (),
    limits: Limits | None = None,
) -> Work[list[Judgement]]:
    """Judge several files, each by itself."""
    out = []
    for k, (path, name) in enumerate(zip(paths, distinct(paths), strict=True)):
        work = judge(path, checks, subjects, extremes, limits, name)
        out.append((yield from scaled(work, k / len(paths), 1 / len(paths))))
    return out

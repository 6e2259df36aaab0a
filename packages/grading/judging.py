"""Judges a student's file: on the checks, on scenes, and at the extremes.

Whatever the file does wrong is in the `Judgement`: it is never an error of ours.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain, count
from pathlib import Path
from typing import TypeVar

from reference_tracer.arrays import Floats
from reference_tracer.cli.running import printable
from reference_tracer.tracer.progress import Work, scaled

from .answers import Answers
from .checks import Checks
from .examples import Example, find_examples
from .external import Program, Run
from .extremes import ExtremeRow, ExtremeScene, try_extremes
from .faults import Fault, dependence, find_faults
from .matching import Match, Questions, Replies
from .names import distinct
from .picture import Look, look
from .shared_edges import SharedEdges, try_edges
from .student import Limits, Student
from .student_error import StudentError
from .subject import Subject
from .tally import COST, Tally, score_of

T = TypeVar("T")

CHECKS = "the checks"  # where an error happened


@dataclass(eq=False)
class Judgement:
    """What is said of one file."""

    name: str  # what a reader calls it
    checks: Tally | None = None  # None: not finished
    faults: list[Fault] = field(default_factory=list)
    alike: Match | None = None  # the wrong program that gives the same answers, everywhere
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
    def as_is(self) -> float:
        """0 to 100: the mean of the checks and every scene; what has failed counts as 0."""
        return score_of(self.tallies)

    @property
    def score(self) -> float:
        """0 to 100: the file as it is, or with the mistakes put right, each at a cost.

        They are put right only if they are all that is wrong: if the wrong program that they make
        gives the file's own answers to the checks and in every scene.
        """
        if self.alike is None or self.errors:
            return self.as_is
        return max(self.as_is, 100 - COST * len(self.faults))

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
    submission: Path | Run,
    checks: Checks,
    subjects: Sequence[Subject],
    extremes: Sequence[ExtremeScene] = (),
    limits: Limits | None = None,
    name: str = "",
) -> Work[Judgement]:
    """Judge one file or program; yields the share of the work done.

    Parameters
    ----------
    submission : Path or Run
        A Python file, or how a program of any language is started.
    checks : Checks
    subjects : sequence of Subject
    extremes : sequence of ExtremeScene
        What is lost there is reported, and does not count in the score.
    limits : Limits, optional
        The time is that of each scene, and of the checks.
    name : str, optional
        What a reader calls it; by default the file's name, or the command.
    """
    out = Judgement(name or names([submission])[0], scenes=[s.name for s in subjects])
    with _started(submission, limits) as student:
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


def _started(submission: Path | Run, limits: Limits | None) -> Student | Program:
    if isinstance(submission, Run):
        return Program(submission, limits)
    return Student(submission, limits)


def names(submissions: Sequence[Path | Run]) -> list[str]:
    """Return what a reader calls each: a file's name, or a command; none twice."""
    files = iter(distinct([s for s in submissions if isinstance(s, Path)]))
    out: list[str] = []
    for each in submissions:
        name = printable(each.command) if isinstance(each, Run) else next(files)
        numbered = chain([name], (f"{name} ({n})" for n in count(2)))
        out.append(next(own for own in numbered if own not in out))
    return out


def _on_checks(out: Judgement, student: Student | Program, checks: Checks) -> None:
    student.new_scene()
    t, s = student.ask(checks.origins, checks.directions, checks.triangles)
    answers = Answers(checks, t, s)
    out.faults, out.alike = find_faults(answers)
    if depends := dependence(checks, answers, student.ask):
        out.faults, out.alike = [*out.faults, *depends], None
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


def _on_scene(out: Judgement, student: Student | Program, subject: Subject) -> Work[None]:
    student.new_scene()

    def ask(*rays: Floats) -> tuple[Floats, Floats]:
        t, s = student.ask(*rays)
        if out.alike and not out.alike.agrees(Questions(*rays), Replies(t, s)):
            out.alike = None
        return t, s

    try:
        found = yield from look(subject, ask, lambda: student.seconds)
        out.examples[subject.name] = find_examples(found, student.ask)
        out.looks.append(found)
    except StudentError as error:
        out.errors.append((subject.name, error))


def _on_extremes(
    out: Judgement, student: Student | Program, scenes: Sequence[ExtremeScene]
) -> Work[None]:
    try:
        out.extremes = yield from try_extremes(scenes, student.ask, student.new_scene)
    except StudentError as error:
        out.errors.append(("the extremes", error))


def judge_all(
    submissions: Mapping[str, Path | Run],
    checks: Checks,
    subjects: Sequence[Subject],
    extremes: Sequence[ExtremeScene] = (),
    limits: Limits | None = None,
    *,
    told: Callable[[Judgement], T],
) -> Work[dict[str, T]]:
    """Judge several, each by itself, by what a reader calls them.

    Returns what is made of each judgement once it is there: it holds pictures, and is not kept.
    """
    out = {}
    share = 1 / max(len(submissions), 1)
    for k, (name, each) in enumerate(submissions.items()):
        work = judge(each, checks, subjects, extremes, limits, name)
        out[name] = told((yield from scaled(work, k * share, share)))
    return out

"""Judges a student's file: on the checks, and on scenes.

Whatever the file does wrong is in the `Judgement`: it is never an error of ours.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor, wait
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.tracer.progress import Meter, Progress, Work, result_of, scaled
from reference_tracer.wording import printable
from reference_tracer_processes.running import Limits

from .cases import TableCases
from .examples import find_examples
from .external import Code, Program, Run
from .faults import Fault, dependence, find_faults, raising
from .form import Arrays
from .judged_scene import JudgedScene
from .matching import Match
from .names import distinct, numbered
from .picture import Look, in_scenes, look
from .shared_edges import SharedEdges, try_edges
from .student import Student
from .student_error import StudentError
from .subjects.subject import Subject
from .subjects.triangle import TRIANGLE
from .submission import Submission
from .tally import COST, Tally, score_of
from .wrong_case import WrongCase

T = TypeVar("T")

CHECKS = "the checks"  # where an error happened


@dataclass(eq=False)
class Judgement:
    """The judgement of one file."""

    name: str  # what a reader calls it
    subject: Subject
    checks: Tally | None = None  # None: not finished
    faults: list[Fault] = field(default_factory=list)
    alike: Match | None = None  # a wrong program that gives the same answers to the checks
    mended: list[Tally | None] = field(
        default_factory=list
    )  # with what is wrong with that put right
    wrong: list[WrongCase] = field(default_factory=list)  # some of the cases
    edges: SharedEdges | None = None  # None: it failed before
    scenes: list[str] = field(default_factory=list)  # the names of all
    looks: list[Look] = field(default_factory=list)  # of those that were finished
    errors: list[tuple[str, StudentError]] = field(default_factory=list)  # where, and what
    seconds: float = 0.0  # that the function itself has taken
    printed: int = 0  # bytes
    said: str = ""  # the first of them

    @property
    def tallies(self) -> list[Tally | None]:
        """Those of the checks and of every scene; None where the file has failed."""
        of = {k.judged.name: k.tally for k in self.looks}
        return [self.checks, *(of.get(name) for name in self.scenes)]

    @property
    def as_is(self) -> float:
        """0 to 100: the mean of the checks and every scene; what has failed counts as 0."""
        return score_of(self.tallies)

    @property
    def score(self) -> float:
        """0 to 100: the file as it is, or with the mistakes put right, each at a cost.

        What is put right is what the wrong program that they make answers as the file does. What
        else is wrong stays wrong.
        """
        if self.alike is None:
            return self.as_is
        return max(self.as_is, round(self.put_right - COST * len(self.alike.wrong), 1))

    @property
    def put_right(self) -> float:
        """0 to 100: what the file would have with its mistakes put right, if they cost nothing."""
        return score_of(self.mended)

    @property
    def leaks(self) -> str:
        """A sentence on edges between two triangles, if any leaks: it does not count."""
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
    submission: Code,
    cases: TableCases,
    scenes: Sequence[JudgedScene] = (),
    limits: Limits | None = None,
    name: str = "",
    started: list[Submission] | None = None,
) -> Work[Judgement]:
    """Judge one file or program.

    Parameters
    ----------
    submission : Path or Run
        A Python file, or how a program of any language is started.
    cases : TableCases
        What it is asked, of any subject.
    scenes : sequence of JudgedScene
        Of ray/triangle tests alone.
    limits : Limits, optional
        The time is that of each scene, and of the cases.
    name : str, optional
        What a reader calls it; by default the file's name, or the command.
    started : list of Submission, optional
        Where the running program is entered, for who may stop it.
    """
    subject = cases.subject
    out = Judgement(name or names([submission])[0], subject, scenes=[s.name for s in scenes])
    with (
        Program(submission, subject.form, limits)
        if isinstance(submission, Run)
        else Student(submission, subject.form, limits)
    ) as student:
        if started is not None:
            started.append(student)
        try:
            _on_cases(out, student, cases)
        except StudentError as error:
            out.errors.append((CHECKS, error))  # it would fail again: the scenes are not tried
            scenes = ()
        for k, scene in enumerate(scenes):
            share = 1 / len(scenes)
            yield from scaled(_on_scene(out, student, scene), k * share, share)
        out.faults += raising(student)
        if not (out.faults or out.errors or all(t and t.all_right for t in out.tallies)):
            out.faults.append(in_scenes(out.looks))
        out.seconds = student.seconds
    out.printed, out.said = student.printed, student.said  # all of it, now that it has ended
    return out


def names(submissions: Sequence[Code]) -> list[str]:
    """Return what a reader calls each: its file's or folder's name, or a command; none twice.

    A program lies in the last file or folder that its command names.
    """
    paths = [s.named[-1:] if isinstance(s, Run) else [s] for s in submissions]
    files = iter(distinct([path for each in paths for path in each]))
    every = [
        printable(each.command) if isinstance(each, Run) and not path else next(files)
        for each, path in zip(submissions, paths, strict=True)
    ]
    return list(numbered(every, "{} ({})"))


def _on_cases(out: Judgement, student: Submission, cases: TableCases) -> None:
    student.new_scene()
    rows = cases.subject.rows(*student.ask(*cases.given))
    rows[np.repeat(student.raised, cases.each)] = -np.inf
    raises = student.raises
    answers = cases.answers(rows)
    out.faults, out.alike = find_faults(answers)
    if depends := dependence(answers, student.ask):
        out.faults += depends
        out.alike = None
    if cases.subject is TRIANGLE:
        out.edges = try_edges(student.ask)
    else:
        out.wrong = answers.examples  # a triangle's are shown in the scenes
    student.raises = raises  # what is asked again counts once
    out.checks = answers.tally
    if out.alike:
        out.mended = [cases.answers(out.alike.put_right(cases.letters, rows)).tally]


def _on_scene(out: Judgement, student: Submission, scene: JudgedScene) -> Work[None]:
    student.new_scene()

    mended: list[Arrays] = []

    def ask(*rays: Floats) -> Arrays:
        replies = student.ask(*rays)
        if out.alike:
            right = out.alike.put_right(TRIANGLE.letters(*rays), TRIANGLE.rows(*replies))
            mended.append(TRIANGLE.form.answers(right))
        return replies

    before = student.seconds
    try:
        found = yield from look(scene, ask)
        found = replace(found, seconds=student.seconds - before)
        out.looks.append(replace(found, examples=find_examples(found, student.ask)))
        if out.alike:
            again = iter(mended)
            out.mended.append(result_of(look(scene, lambda *_: next(again))).tally)
    except StudentError as error:
        out.errors.append((scene.name, error))
        out.mended.append(None)


def judge_all(
    submissions: Mapping[str, Code],
    cases: TableCases,
    scenes: Sequence[JudgedScene] = (),
    limits: Limits | None = None,
    *,
    told: Callable[[Judgement], T],
    jobs: int = 1,
) -> Work[dict[str, T]]:
    """Judge several, `jobs` at a time, each by itself, by what a reader calls them.

    Returns what is made of each judgement once it is there: it holds pictures, and is not kept.
    """
    meters = {name: Meter() for name in submissions}
    started: list[Submission] = []

    def judged(name: str) -> T:
        work = judge(submissions[name], cases, scenes, limits, name, started)
        found = result_of(work, meters[name].read)
        if any(each.stopped for each in started):
            raise CancelledError
        return told(found)

    with ThreadPoolExecutor(jobs) as pool:
        found = {name: pool.submit(judged, name) for name in submissions}
        try:
            while wait(found.values(), 0.1).not_done:
                yield Progress(sum(m.share for m in meters.values()) / len(meters))
            return {name: future.result() for name, future in found.items()}
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            for each in started:
                each.stop()

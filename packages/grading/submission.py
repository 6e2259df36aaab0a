"""A student's code, whatever it is written in: it is asked, and answers within limits."""

from __future__ import annotations

import subprocess
from abc import ABC, abstractmethod
from collections import deque
from typing import NamedTuple, Self

import numpy as np
from reference_tracer.arrays import Array, Bools, Floats
from reference_tracer.wording import printable
from reference_tracer_processes.running import Limits, kill

from .form import Arrays, Form
from .student_error import StudentError

MOST = 0.75  # share of cases: what raises in more of them raises whatever it is asked
TRIED = 16  # cases that are asked by themselves first: who raises in all of these does so in MOST


class Raising(NamedTuple):
    """Some cases, one after the other, and what is raised when they are asked together."""

    part: range
    error: StudentError


class Submission(ABC):
    """A student's submission; to be used in a `with` block."""

    raising: str  # the kind of error after which a part of what was asked is asked again
    parts = float("inf")  # how many parts of a question are asked at most

    def __init__(self, form: Form, limits: Limits | None = None) -> None:
        self.form, self.limits = form, limits or Limits()
        self.seconds = 0.0  # that it has taken itself
        self.printed = 0  # bytes
        self._said = b""
        self._left = self.limits.seconds
        self.raised: Bools = np.zeros(0, bool)  # which cases of the last question raise, (n,)
        self.first: tuple[StudentError, Arrays] | None = None  # that, and its case
        self.raises = 0  # how many cases have
        self.unasked = 0  # of these in groups: too many raise to ask each by itself
        self._has_answered = False
        self.stopped = False
        self._process: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.end()

    @property
    def said(self) -> str:
        """The first of what it has printed; what steers a terminal is spelt out."""
        return printable(self._said.decode("utf-8", "replace"))

    def new_scene(self) -> None:
        """Let the time limit begin anew."""
        self._left = self.limits.seconds

    def ask(self, *given: Array) -> Arrays:
        """Return what it answers to n cases: the arrays of its form, (n, ...) each.

        Raises
        ------
        StudentError
            If it fails, takes too long, or answers something else; also if it raises in nearly
            all cases of the first question. Else these are `raised`, with answers of no meaning.
        """
        if not len(given[0]):
            return self.form.answers(np.zeros((0, self.form.numbers)))
        if self.stopped:
            raise StudentError("ended", "it was stopped")
        self._begin()
        question = self.form.question(given)
        table = np.full((len(question), self.form.numbers), -np.inf)
        self.raised = np.zeros(len(question), bool)
        before = self.unasked
        for whole in self._raising(question, table, range(len(question))):
            first, error = self._halved(question, table, whole)
            self.raised = np.isneginf(table[:, 0])
            untried = self.unasked - before  # which says nothing of them
            raising = self.raised.sum() - untried
            if raising > MOST * (len(question) - untried) and not self._has_answered:
                raise error
            self.first = self.first or (error, tuple(a[first.start] for a in given))
            self.raises += int(self.raised.sum())
        self._has_answered = True
        return self.form.answers(table)

    def _raising(self, question: Floats, table: Floats, *parts: range) -> list[Raising]:
        """Enter what is answered of parts of a question; return the parts that raise."""
        out = []
        for part in parts:
            rows = slice(part.start, part.stop)
            try:
                answers = self._answered(question[rows])
            except StudentError as error:
                if error.kind != self.raising:
                    raise
                out.append(Raising(part, error))
            else:  # of a miss it may write either: -inf is what raises
                table[rows] = np.where(np.isneginf(answers), np.inf, answers)
        return out

    def _halved(self, question: Floats, table: Floats, whole: Raising) -> Raising:
        """Ask halves of what raises, down to single cases; return the first of these.

        It is found first, then both ends of whatever raises as a whole: so a bounded number of
        questions tells one case, or a run of cases, from all others.

        Raises
        ------
        StudentError
            If some raise together, and neither half of them does.
        """
        if not self._has_answered:
            some = np.unique(np.arange(TRIED) * len(question) // TRIED).tolist()
            if all(self._raising(question, table, range(k, k + 1)) for k in some):
                raise whole.error
        left, alone, asked = deque([whole]), None, 0
        until = self._left / 2  # the rest is for other questions
        while left and asked < self.parts and self._left > until:
            part, error = left.popleft()
            if len(part) == 1:
                alone = alone or Raising(part, error)
                continue
            half = len(part) // 2
            found = self._raising(question, table, part[:half], part[half:])
            asked += 2
            if not found:
                raise error
            if alone is None or len(found) == 1:
                left.appendleft(found.pop(0))
            left += found
        self.unasked += sum(len(part) for part, _ in left if len(part) > 1)
        return alone or left[0]

    def stop(self) -> None:
        """End what runs, and let nothing begin anew; from any thread."""
        self.stopped = True
        if self._process:
            kill(self._process)

    @abstractmethod
    def _begin(self) -> None:
        """Start what goes on between two questions, if anything does."""

    def _runs(self, process: subprocess.Popen[bytes]) -> None:
        """Note what has just been started."""
        self._process = process
        if self.stopped:
            kill(process)

    @abstractmethod
    def _answered(self, question: Floats) -> Floats:
        """Return a line of answers (n, numbers) for each line of a question (n, columns)."""

    @abstractmethod
    def end(self) -> None:
        """End what still runs."""

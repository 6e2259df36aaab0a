"""A student's code, whatever it is written in: it is asked, and answers within limits."""

from __future__ import annotations

import subprocess
from abc import ABC, abstractmethod
from typing import Self

import numpy as np
from reference_tracer.arrays import Array, Floats
from reference_tracer.wording import printable
from reference_tracer_processes.running import Limits, kill

from .form import Form
from .programs import Mask
from .student_error import StudentError

MOST = 0.75  # share of cases: what raises in more of them raises whatever it is asked


class Submission(ABC):
    """What a student handed in; to be used in a `with` block."""

    def __init__(self, form: Form, limits: Limits | None = None) -> None:
        self.form, self.limits = form, limits or Limits()
        self.seconds = 0.0  # that it has taken itself
        self.printed = 0  # bytes
        self._said = b""
        self._left = self.limits.seconds
        self._errors: list[StudentError] = []  # what was raised by cases that were asked alone
        self.raised: Mask = np.zeros(0, bool)  # which cases of the last question raise, (n,)
        self.first: tuple[StudentError, tuple[Floats, ...]] | None = None  # that, and its case
        self.raises = 0  # how many cases have
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

    def ask(self, *given: Array) -> tuple[Floats, ...]:
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
        table = self._answered(self.form.question(given))
        self.raised = np.isneginf(table[:, 0])
        if self._errors and self.raised.any():
            if self.raised.mean() > MOST and not self._has_answered:
                raise self._errors[0]
            case = int(np.argmax(self.raised))
            self.first = self.first or (self._errors[0], tuple(a[case] for a in given))
            self.raises += int(self.raised.sum())
        self._has_answered = True
        return self.form.answers(table)

    def stop(self) -> None:
        """End what runs, and let nothing begin anew; from any thread."""
        self.stopped = True
        if self._process:
            kill(self._process)

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

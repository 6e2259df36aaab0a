"""A student's code, whatever it is written in: it is asked, and answers within limits."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Self

import numpy as np
from reference_tracer.arrays import Array, Floats
from reference_tracer.wording import printable
from reference_tracer_processes.running import Limits

from .form import Form


class Submission(ABC):
    """What a student handed in; to be used in a `with` block."""

    def __init__(self, form: Form, limits: Limits | None = None) -> None:
        self.form, self.limits = form, limits or Limits()
        self.seconds = 0.0  # that it has taken itself
        self.printed = 0  # bytes
        self._said = b""
        self._left = self.limits.seconds

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
            If it fails, takes too long, or answers something else.
        """
        if not len(given[0]):
            return self.form.answers(np.zeros((0, self.form.numbers)))
        return self.form.answers(self._answered(self.form.question(given)))

    @abstractmethod
    def _answered(self, question: Floats) -> Floats:
        """Return a line of answers (n, numbers) for each line of a question (n, columns)."""

    @abstractmethod
    def end(self) -> None:
        """End what still runs."""

"""Reads a student's process's answer: the seconds that it took, and what it did wrong."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from reference_tracer.wording import printable

KINDS = frozenset({"syntax", "exception", "answer", "exit", "memory", "time", "ended"})
# What an error is, or what numpy says of it -> what a student needs to know.
_ADVICE = {
    "exit": "the file must not call sys.exit or quit",
    "memory": "the limit is {:.3g} GiB",
    "read-only": "the arrays that the function is given must not be changed: write a = a - b, "
    "not a -= b, or copy them first",
}


class StudentError(Exception):
    """An error of a student's code.

    `kind` is one of KINDS ("answer": of a wrong form); `trace` has the lines of the student's own
    files, (file, line, function, text), outermost first.
    """

    def __init__(self, kind: str, message: str, trace: tuple[tuple, ...] = ()) -> None:
        super().__init__(message)
        self.kind, self.message, self.trace = kind, message, trace

    @property
    def line(self) -> int | None:
        """The line of the student's file where it happened, if there is one."""
        return self.trace[-1][1] if self.trace else None

    @property
    def lines(self) -> list[str]:
        """The lines of its own files that lead there, each once."""
        return list(dict.fromkeys(f"{file}, line {n}: {text}" for file, n, _, text in self.trace))

    def to_dict(self) -> dict[str, Any]:
        """Return the error as JSON can hold it."""
        names = "file", "line", "function", "text"
        return {
            "kind": self.kind,
            "message": self.message,
            "line": self.line,
            "trace": [dict(zip(names, t, strict=True)) for t in self.trace],
        }


def parsed(line: bytes, memory: int) -> tuple[float, StudentError | None]:
    """Return the seconds that an answer has taken, and the error that it is, if any.

    The student's code shares the process that writes it, and may have written it: nothing is taken
    for granted.
    """
    answer = json.loads(line)
    seconds = float(answer.get("seconds", 0.0))
    if not 0 <= seconds < np.inf:
        raise ValueError(seconds)
    return seconds, None if answer["ok"] else _error(answer, memory)


def _error(answer: Mapping[str, Any], memory: int) -> StudentError:
    kind, message = answer["kind"], printable(answer["message"])
    if kind not in KINDS:
        raise ValueError(kind)
    trace = tuple(
        (printable(file), None if number is None else int(number), printable(name), printable(text))
        for file, number, name, text in answer["trace"]
    )
    for sign, advice in _ADVICE.items():
        if sign == kind or (kind == "exception" and sign in message):
            message += f" ({advice.format(memory / 2**30)})"
    return StudentError(kind, message, trace)

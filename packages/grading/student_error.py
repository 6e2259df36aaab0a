"""What a student's process answers -> the seconds that it took, or what it did wrong."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from reference_tracer.wording import printable

KINDS = frozenset({"syntax", "exception", "answer", "exit", "memory", "time", "ended"})


class StudentError(Exception):
    """What a student's code did wrong.

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

    def to_dict(self) -> dict[str, Any]:
        """Return the error as JSON can hold it."""
        names = "file", "line", "function", "text"
        return {
            "kind": self.kind,
            "message": self.message,
            "line": self.line,
            "trace": [dict(zip(names, t, strict=True)) for t in self.trace],
        }


def parsed(line: bytes) -> float | tuple[str, str, tuple[tuple, ...]]:
    """Return the seconds that an answer has taken, or an error's kind, message and trace.

    The student's code shares the process that writes it, and may have written it: nothing is taken
    for granted.
    """
    answer = json.loads(line)
    if answer["ok"]:
        seconds = float(answer.get("seconds", 0.0))
        if not 0 <= seconds < np.inf:
            raise ValueError(seconds)
        return seconds
    if answer["kind"] not in KINDS:
        raise ValueError(answer["kind"])
    trace = tuple(
        (printable(file), None if number is None else int(number), printable(name), printable(text))
        for file, number, name, text in answer["trace"]
    )
    return answer["kind"], printable(answer["message"]), trace

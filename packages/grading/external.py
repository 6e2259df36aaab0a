"""A student's program in any language: it reads rays from a file or a pipe, and writes answers.

It is started anew for each call, in `bubblewrap` where that works: then it reaches no network, sees
no other process, knows nothing of its user's environment, and writes nowhere but to a folder of its
own. It may still read what its user may. `docs/programs.md` says what it reads and writes.
"""

from __future__ import annotations

import os
import re
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

from reference_tracer.arrays import Floats
from reference_tracer_processes.running import KEPT, Limits, ProgramError, filled, run, words_of

from .exchange import ANSWERS, CSV, RAYS, all_of, answers_in, most_bytes, read, write
from .form import Form
from .student_error import StudentError
from .submission import Submission


@dataclass(frozen=True)
class Run:
    """How a student's program is started: a command with {rays} and {answers} for its files.

    Without these it reads its standard input, or writes to its standard output.
    """

    command: str
    exchange: str = CSV  # one of EXCHANGES

    @property
    def words(self) -> tuple[str, ...]:
        """Its words; raises ValueError if there is none, or a quotation has no end."""
        return words_of(self.command)

    @property
    def named(self) -> list[Path]:
        """The files and folders that it names."""
        parts = (part for word in self.words for part in re.split(r"[\s=]", word))
        return [Path(part) for part in parts if part and Path(part).exists()]


Code = Path | Run  # a student's: a Python file, or how a program of any language is started


class Program(Submission):
    """A student's program, as `student.Student` is a student's file."""

    raising = "ended"
    parts = 128  # it is started for each

    def __init__(self, run: Run, form: Form, limits: Limits | None = None) -> None:
        super().__init__(form, limits)
        self.words = run.words
        self._exchange = run.exchange

    def end(self) -> None:
        """Nothing is left running after a call."""

    def _begin(self) -> None:
        """Nothing runs between two calls."""

    def _answered(self, question: Floats) -> Floats:
        with tempfile.TemporaryDirectory(
            prefix="reftrace-judge-", ignore_cleanup_errors=True
        ) as name:
            answers = read(self._run(Path(name), question), self.form, self._exchange)
        if len(answers) != len(question):
            text = (
                f"it answered {len(answers):,} lines of {len(question):,}: one for each is wanted"
            )
            raise StudentError("answer", text)
        return answers

    def _run(self, folder: Path, rays: Floats) -> bytes:
        """Run the program, and return what it wrote as its answers.

        What it prints is kept outside of the folder that it may write to.
        """
        own = folder / "own"
        own.mkdir()
        given, made = (own / f"{name}.{self._exchange}" for name in ("rays", "answers"))
        write(given, rays, self._exchange)
        paths = {RAYS: str(given), ANSWERS: str(made)}
        words = filled(self.words, paths)
        by_pipe = not any(ANSWERS in word for word in self.words)
        with (
            given.open("rb") as source,
            (folder / "said").open("w+b") as err,
            (folder / "printed").open("w+b") as out,
        ):
            began = time.monotonic()
            try:
                limits = replace(self.limits, seconds=self._left)
                run(words, own, limits, (source, out, err), started=self._runs)
            except ProgramError as error:
                of_limit = f" of {self.limits.seconds:g} s for one scene"
                text = error.message + of_limit * (error.kind == "time")
                raise StudentError(error.kind, text) from error
            finally:
                took = time.monotonic() - began
                self._left -= took
                self.seconds += took
                self._keep(err, *(() if by_pipe else (out,)))
            most = most_bytes(self.form, len(rays))
            if by_pipe:
                out.seek(0)
                return all_of(out, most)
            return answers_in(made, most)

    def _keep(self, *printed: IO[bytes]) -> None:
        """Keep the first of what it printed."""
        for file in printed:
            self.printed += file.seek(0, os.SEEK_END)
            file.seek(0)
            self._said += file.read(KEPT - len(self._said))

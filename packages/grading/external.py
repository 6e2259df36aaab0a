"""A student's program in any language: it reads rays from a file or a pipe, and writes answers.

It is started anew for each call, in `bubblewrap` where that works: then it reaches no network, sees
no other process, and writes nowhere but to a folder of its own. It may still read what its user
may. `docs/programs.md` says what it reads and writes.
"""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import IO, Any

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.cli.running import printable

from .student import KEPT, Limits
from .student_error import StudentError

RAYS, ANSWERS = "{rays}", "{answers}"
COLUMNS = 15  # of rays: o, d, p1, p2, p3
NUMBERS = 4  # of an answer: t, s1, s2, s3
_LARGEST_FILE = 1 << 30  # bytes that a program may write to one
_SANDBOX = (
    *("bwrap", "--die-with-parent", "--unshare-all", "--ro-bind", "/", "/"),
    *("--dev", "/dev", "--proc", "/proc"),
)


@cache
def sandbox() -> tuple[str, ...]:
    """Return the command that keeps a program in, without its folder; () where there is none."""
    if not shutil.which("bwrap"):
        return ()
    tried = subprocess.run([*_SANDBOX, "true"], capture_output=True, check=False)
    return _SANDBOX if tried.returncode == 0 else ()


@dataclass(frozen=True)
class Exchange:
    """How rays and answers are written: as text with commas, or as the numbers lie in memory."""

    ending: str
    is_text: bool

    def write(self, path: Path, rays: Floats) -> None:
        """Write rays (n, 15)."""
        if self.is_text:
            np.savetxt(path, rays, fmt="%.17g", delimiter=",")
        else:
            path.write_bytes(rays.astype("<f8").tobytes())

    def read(self, data: bytes) -> Floats:
        """Return answers (m, 4).

        Raises
        ------
        StudentError
            If they are none.
        """
        if self.is_text:
            return _from_text(data)
        if len(data) % (8 * NUMBERS):
            text = f"it wrote {len(data):,} bytes: no whole number of answers of 32 bytes"
            raise StudentError("answer", text)
        return np.frombuffer(data, "<f8").reshape(-1, NUMBERS)


EXCHANGES = {"csv": Exchange(".csv", True), "raw": Exchange(".raw", False)}


def _from_text(data: bytes) -> Floats:
    """Return answers from lines of t, s1, s2, s3; of a miss `inf` is enough."""
    out = []
    for number, line in enumerate(data.decode("utf-8", "replace").splitlines(), start=1):
        try:
            values = [float(v) for v in line.split(",")]
        except ValueError:
            values = []
        if len(values) == 1 and not np.isfinite(values[0]):
            values *= NUMBERS
        if len(values) != NUMBERS:
            text = f"line {number} of its answers is no 't,s1,s2,s3': {printable(line)[:80]!r}"
            raise StudentError("answer", text)
        out.append(values)
    return np.array(out, np.float64).reshape(-1, NUMBERS)


@dataclass(frozen=True)
class Run:
    """How a student's program is started: a command with {rays} and {answers} for its files.

    Without these it reads its standard input, or writes to its standard output.
    """

    command: str
    words: tuple[str, ...]
    exchange: str = "csv"  # one of EXCHANGES

    @classmethod
    def parsed(cls, command: str, exchange: str = "csv") -> Run:
        """Return how a command is run.

        Raises
        ------
        ValueError
            If a quotation has no end, or there is no word.
        """
        words = tuple(shlex.split(command))
        if not words:
            raise ValueError("there is no command")
        return cls(command, words, exchange)


class Program:
    """A student's program, as `student.Student` is a student's file."""

    def __init__(self, run: Run, limits: Limits | None = None) -> None:
        self.words, self.limits = run.words, limits or Limits()
        self._exchange = EXCHANGES[run.exchange]
        self.seconds = 0.0
        self.printed = 0
        self._said = b""
        self._left = self.limits.seconds

    def __enter__(self) -> Program:
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing is left running between two calls."""

    @property
    def said(self) -> str:
        """The first of what it printed, beside its answers."""
        return printable(self._said.decode("utf-8", "replace"))

    def new_scene(self) -> None:
        """Let the time limit begin anew."""
        self._left = self.limits.seconds

    def ask(self, origins: Floats, directions: Floats, triangles: Floats) -> tuple[Floats, Floats]:
        """Return what the program makes of n pairs: t (n,), barycentrics (n, 3).

        Raises
        ------
        StudentError
            If it fails, takes too long, or answers something else.
        """
        count = len(origins)
        if not count:
            return np.zeros(0), np.zeros((0, 3))
        rays = np.concatenate((origins, directions, triangles.reshape(count, 9)), axis=1)
        with tempfile.TemporaryDirectory(prefix="reftrace-judge-") as name:
            answers = self._exchange.read(self._run(Path(name), rays))
        if len(answers) != count:
            text = f"it answered {len(answers):,} rays of {count:,}: one line for each is wanted"
            raise StudentError("answer", text)
        return answers[:, 0].copy(), answers[:, 1:].copy()

    def _run(self, folder: Path, rays: Floats) -> bytes:
        """Run the program in its folder, and return what it wrote as its answers."""
        given = folder / f"rays{self._exchange.ending}"
        made = folder / f"answers{self._exchange.ending}"
        said, printed = folder / "said.txt", folder / "printed.txt"
        self._exchange.write(given, rays)
        own = {RAYS: str(given), ANSWERS: str(made)}
        words = [_filled(word, own) for word in self.words]
        by_pipe = not any(ANSWERS in word for word in self.words)
        with given.open("rb") as source, said.open("wb") as err, printed.open("wb") as out:
            code = self._waited(words, folder, source, out, err)
        self._keep(said, *(() if by_pipe else (printed,)))
        answers = printed if by_pipe else made
        if code:
            raise StudentError("ended", f"{_how(code)}: {_last(said)}".rstrip(": "))
        if not answers.exists():
            raise StudentError("answer", f"it wrote no answers to {ANSWERS}, its second file")
        return answers.read_bytes()

    def _waited(
        self, words: list[str], folder: Path, source: IO[bytes], out: IO[bytes], err: IO[bytes]
    ) -> int:
        kept = sandbox()
        if kept:
            words = [
                *kept,
                "--bind",
                str(folder),
                str(folder),
                "--chdir",
                os.getcwd(),
                "--",
                *words,
            ]
        own = {"TMPDIR": str(folder), "OMP_NUM_THREADS": "1"}
        began = time.monotonic()
        try:
            process = subprocess.Popen(
                words,
                stdin=source,
                stdout=out,
                stderr=err,
                env=os.environ | own,
                start_new_session=True,
                **_limited(self.limits),
            )
        except OSError as error:
            raise StudentError("ended", f"it cannot be started: {error}") from error
        try:
            return process.wait(max(self._left, 0.0))
        except subprocess.TimeoutExpired as error:
            text = f"took longer than the time limit of {self.limits.seconds:g} s for one scene"
            raise StudentError("time", text) from error
        finally:
            _end(process)
            self._left -= time.monotonic() - began
            self.seconds += time.monotonic() - began

    def _keep(self, *printed: Path) -> None:
        """Keep the first of what it printed."""
        for path in printed:
            self.printed += path.stat().st_size
            with path.open("rb") as file:
                self._said += file.read(KEPT - len(self._said))


def _filled(word: str, own: dict[str, str]) -> str:
    for name, value in own.items():
        word = word.replace(name, value)
    return word


def _limited(limits: Limits) -> dict[str, Any]:
    """Return what has the system limit a process, where it can: memory, files, core dumps."""
    try:
        import resource
    except ImportError:  # Windows
        return {}

    def limit() -> None:
        for kind, most in (
            (resource.RLIMIT_DATA, limits.memory),
            (resource.RLIMIT_FSIZE, _LARGEST_FILE),
            (resource.RLIMIT_CORE, 0),
        ):
            with suppress(ValueError, OSError):
                resource.setrlimit(kind, (most, most))

    return {"preexec_fn": limit}


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a program, and what it has started."""
    with suppress(OSError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    process.wait()


def _how(code: int) -> str:
    if code < 0:
        return f"the program was ended by {signal.Signals(-code).name}"
    return f"the program ended with exit code {code}"


def _last(path: Path) -> str:
    """Return the last line of what a program has printed."""
    lines: Iterable[str] = path.read_text("utf-8", "replace")[-KEPT:].strip().splitlines()
    return printable([*lines][-1])[:200] if lines else ""

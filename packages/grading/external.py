"""A student's program in any language: it reads rays from a file or a pipe, and writes answers.

It is started anew for each call, in `bubblewrap` where that works: then it reaches no network, sees
no other process, knows nothing of its user's environment, and writes nowhere but to a folder of its
own. It may still read what its user may. `docs/programs.md` says what it reads and writes.
"""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import stat
import subprocess
import tempfile
import time
from collections.abc import Iterator
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
    # Sockets of other programs lie here, which a read-only folder would not keep it from.
    *("--tmpfs", "/run", "--tmpfs", "/tmp", "--tmpfs", "/var/tmp"),
    "--clearenv",
)
_KEPT_ENVIRONMENT = "PATH", "LANG", "HOME", "JAVA_HOME"
_BYTES = 1 << 10  # of one answer, at most
_SPELT = {"1.#INF": "inf", "-1.#INF": "-inf", "1.#QNAN": "nan", "-1.#IND": "nan"}  # by old C


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
    lines = data.decode("utf-8-sig", "replace").rstrip().splitlines()
    for number, line in enumerate(lines, start=1):
        try:
            words = [word.strip() for word in line.split(",")]
            values = [float(_SPELT.get(word.rstrip("0"), word)) for word in words]
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
        words = tuple(w.strip('"') for w in shlex.split(command, posix=os.name != "nt"))
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
        with tempfile.TemporaryDirectory(
            prefix="reftrace-judge-", ignore_cleanup_errors=True
        ) as name:
            answers = self._exchange.read(self._run(Path(name), rays))
        if len(answers) != count:
            text = f"it answered {len(answers):,} rays of {count:,}: one line for each is wanted"
            raise StudentError("answer", text)
        return answers[:, 0].copy(), answers[:, 1:].copy()

    def _run(self, folder: Path, rays: Floats) -> bytes:
        """Run the program, and return what it wrote as its answers.

        What it prints is kept outside of the folder that it may write to.
        """
        own = folder / "own"
        own.mkdir()
        given, made = (own / f"{name}{self._exchange.ending}" for name in ("rays", "answers"))
        self._exchange.write(given, rays)
        paths = {RAYS: str(given), ANSWERS: str(made)}
        words = [_filled(word, paths) for word in self.words]
        by_pipe = not any(ANSWERS in word for word in self.words)
        with (
            given.open("rb") as source,
            (folder / "said").open("w+b") as err,
            (folder / "printed").open("w+b") as out,
        ):
            code = self._waited(words, own, source, out, err)
            self._keep(err, *(() if by_pipe else (out,)))
            if code:
                raise StudentError("ended", f"{_how(code)}: {_last(err)}".rstrip(": "))
            most = _BYTES * (len(rays) + 1)
            if by_pipe:
                out.seek(0)
                return _all_of(out, most)
            return _answers_in(made, most)

    def _waited(
        self, words: list[str], folder: Path, source: IO[bytes], out: IO[bytes], err: IO[bytes]
    ) -> int:
        own = {"TMPDIR": str(folder), "OMP_NUM_THREADS": "1"}
        if kept := sandbox():
            own |= {k: os.environ[k] for k in _KEPT_ENVIRONMENT if k in os.environ}
            words = [*kept, *_seen(words, folder, own), "--", *words]
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

    def _keep(self, *printed: IO[bytes]) -> None:
        """Keep the first of what it printed."""
        for file in printed:
            self.printed += file.seek(0, os.SEEK_END)
            file.seek(0)
            self._said += file.read(KEPT - len(self._said))


def _seen(words: list[str], folder: Path, environment: dict[str, str]) -> Iterator[str]:
    """Yield the sandbox's options for what a program may see and write, and its environment."""
    named = [Path(word).resolve() for word in words if Path(word).is_absolute()]
    folders = [path if path.is_dir() else path.parent for path in named if path.exists()]
    for path in dict.fromkeys((*folders, Path.cwd())):
        yield from ("--ro-bind", str(path), str(path))
    yield from ("--bind", str(folder), str(folder), "--chdir", str(Path.cwd()))
    for name, value in environment.items():
        yield from ("--setenv", name, value)


def _answers_in(path: Path, most: int) -> bytes:
    """Return what a program left as its answers: it may have left anything there.

    Raises
    ------
    StudentError
        If it is no file, or too large a one.
    """
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        with os.fdopen(os.open(path, flags | getattr(os, "O_BINARY", 0)), "rb") as file:
            if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise StudentError("answer", f"what it left as {ANSWERS} is no file")
            return _all_of(file, most)
    except FileNotFoundError as error:
        raise StudentError("answer", f"it wrote no answers to {ANSWERS}") from error
    except OSError as error:
        raise StudentError("answer", f"its answers cannot be read: {error.strerror}") from error


def _all_of(file: IO[bytes], most: int) -> bytes:
    data = file.read(most + 1)
    if len(data) > most:
        text = f"its answers take more than {most:,} bytes, which is too much for so few rays"
        raise StudentError("answer", text)
    return data


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

    return {"preexec_fn": limit}  # beside a thread it may import nothing and take no lock


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


def _last(file: IO[bytes]) -> str:
    """Return the last line of what a program has printed."""
    file.seek(max(0, file.seek(0, os.SEEK_END) - KEPT))
    lines = file.read().decode("utf-8", "replace").strip().splitlines()
    return printable(lines[-1])[:200] if lines else ""

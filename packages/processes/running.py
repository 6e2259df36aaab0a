"""Runs a program of somebody else until it ends: in a sandbox, with limits of time and memory."""

from __future__ import annotations

import os
import shlex
import shutil
import signal
import subprocess
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from reference_tracer.wording import printable

from .sandbox import kept_in, limited

SECONDS = 60.0
MEMORY = 2 << 30  # bytes of data
KEPT = 4000  # bytes of what a program prints


@dataclass(frozen=True)
class Limits:
    """The limits of a program: seconds a scene, bytes."""

    seconds: float = SECONDS
    memory: int = MEMORY


class ProgramError(Exception):
    """A program did not end well; `kind` is "ended" or "time"."""

    def __init__(self, kind: str, message: str) -> None:
        super().__init__(message)
        self.kind, self.message = kind, message


def words_of(command: str) -> tuple[str, ...]:
    """Split a command as a shell does.

    Raises
    ------
    ValueError
        If a quotation has no end, or there is no word.
    """
    words = tuple(w.strip('"') for w in shlex.split(command, posix=os.name != "nt"))
    if not words:
        raise ValueError("there is no command")
    return words


def check_starts(program: str) -> None:
    """Raise a ValueError if the first word of a command is no program that can be executed."""
    if shutil.which(program):
        return
    if os.path.exists(program):
        raise ValueError(f"'{program}' cannot be executed: name its interpreter, or chmod +x it")
    raise ValueError(f"there is no program '{program}': name one in the PATH, or its whole path")


def filled(words: Sequence[str], names: Mapping[str, str]) -> list[str]:
    """Return the words with what stands for files replaced by their paths."""
    out = list(words)
    for name, path in names.items():
        out = [word.replace(name, path) for word in out]
    return out


def run(
    words: Sequence[str],
    folder: Path,
    limits: Limits,
    streams: tuple[IO[bytes] | None, IO[bytes], IO[bytes]],
    boxed: bool = True,
    started: Callable[[subprocess.Popen[bytes]], None] = lambda _: None,
) -> None:
    """Run a command until it ends, and end what it has started.

    Parameters
    ----------
    words : sequence of str
    folder : Path
        The one that it may write to.
    limits : Limits
    streams : (file, file, file)
        Its standard input, output and error.
    boxed : bool
        Whether it is kept in the sandbox, where there is one.
    started : callable, optional
        Takes the process, for who may end it.

    Raises
    ------
    ProgramError
        If it cannot be started, takes too long, or ends with another exit code than 0.
    """
    given, out, err = streams
    own = {"TMPDIR": str(folder), "OMP_NUM_THREADS": "1"}
    try:
        process = subprocess.Popen(
            kept_in(list(words), folder, own) if boxed else words,
            stdin=given or subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            env=os.environ | own,
            start_new_session=True,
            **limited(limits.memory),
        )
    except OSError as error:
        raise ProgramError("ended", f"it cannot be started: {error}") from error
    started(process)
    try:
        code = process.wait(max(limits.seconds, 0.0))
    except subprocess.TimeoutExpired as error:
        raise ProgramError("time", "took longer than the time limit") from error
    finally:
        kill(process)
        process.wait()
    if code:
        raise ProgramError("ended", f"the program {how(code)}: {_last(err)}".rstrip(": "))


def kill(process: subprocess.Popen[bytes]) -> None:
    """End a process, and what it has started, but for what has a session of its own."""
    with suppress(OSError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()


def how(code: int) -> str:
    """Say how a process ended: in the sandbox, 128 and a signal's number are its exit code."""
    known = {s.value: s.name for s in signal.Signals}  # not all of the realtime ones
    number = -code if code < 0 else code - 128
    if code < 0 or number in known:
        return f"was ended by {known.get(number, f'signal {number}')}"
    return f"ended with exit code {code}"


def _last(file: IO[bytes]) -> str:
    """Return the last line of what a program has printed."""
    file.seek(max(0, file.seek(0, os.SEEK_END) - KEPT))
    lines = file.read().decode("utf-8", "replace").strip().splitlines()
    return printable(lines[-1])[:200] if lines else ""

"""How a program's questions and answers are written: lines of text, or numbers as in memory."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import IO

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.wording import printable

from .form import Form
from .student_error import StudentError

RAYS, ANSWERS = "{rays}", "{answers}"  # stand for the files in a command
_BYTES = 1 << 10  # of one answer, at most; of one with more than 32 numbers 32 for each
_SPELT = {"1.#INF": "inf", "-1.#INF": "-inf", "1.#QNAN": "nan", "-1.#IND": "nan"}  # by old C


# How rays and answers are written: as text with commas, or as the numbers lie in memory.
CSV, RAW = EXCHANGES = "csv", "raw"


def write(path: Path, rays: Floats, exchange: str) -> None:
    """Write lines of numbers, (n, columns)."""
    if exchange == CSV:
        np.savetxt(path, rays, fmt="%.17g", delimiter=",")
    else:
        path.write_bytes(rays.astype("<f8").tobytes())


def read(data: bytes, form: Form, exchange: str) -> Floats:
    """Return answers (m, numbers).

    Raises
    ------
    StudentError
        If they are none.
    """
    if exchange == CSV:
        return _from_text(data, form)
    size = 8 * form.numbers
    if len(data) % size:
        text = f"it wrote {len(data):,} bytes: no whole number of answers of {size} bytes"
        raise StudentError("answer", text)
    return np.frombuffer(data, "<f8").reshape(-1, form.numbers)


def _from_text(data: bytes, form: Form) -> Floats:
    """Return answers from lines of numbers; of a miss `inf` is enough."""
    out = []
    lines = data.decode("utf-8-sig", "replace").rstrip().splitlines()
    for number, line in enumerate(lines, start=1):
        try:
            words = [word.strip() for word in line.split(",")]
            values = [float(_SPELT.get(word.rstrip("0"), word)) for word in words]
        except ValueError:
            values = []
        if len(values) == 1 and not np.isfinite(values[0]):
            values *= form.numbers
        if len(values) != form.numbers:
            text = f"line {number} of its answers is no '{form.line}': {printable(line)[:80]!r}"
            raise StudentError("answer", text)
        out.append(values)
    return np.array(out, np.float64).reshape(-1, form.numbers)


def most_bytes(form: Form, count: int) -> int:
    """Return how many bytes so many answers may take."""
    return max(_BYTES, 32 * form.numbers) * (count + 1)


def answers_in(path: Path, most: int) -> bytes:
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
            return all_of(file, most)
    except FileNotFoundError as error:
        raise StudentError("answer", f"it wrote no answers to {ANSWERS}") from error
    except OSError as error:
        raise StudentError("answer", f"its answers cannot be read: {error.strerror}") from error


def all_of(file: IO[bytes], most: int) -> bytes:
    """Return what a file holds.

    Raises
    ------
    StudentError
        If that is more bytes than `most`.
    """
    data = file.read(most + 1)
    if len(data) > most:
        text = f"its answers take more than {most:,} bytes, which is too much for so few rays"
        raise StudentError("answer", text)
    return data

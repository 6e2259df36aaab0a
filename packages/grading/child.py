"""The process that runs a student's file: started as a script, it imports nothing but numpy.

    python child.py FILE BYTES

Over its standard input come requests, over what was its standard output go answers: each a line of
JSON, then float64 numbers as they lie in memory. The student's own printing goes to standard error.
Whatever the student's code does wrong is an answer, too. This is no sandbox: the code may do
whatever its user may.
"""

from __future__ import annotations

import importlib.util
import json
import linecache
import os
import random
import sys
import time
import traceback
import warnings
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

LONGEST = 2000  # characters of a message

Answer = tuple[np.ndarray, np.ndarray]


class Refused(Exception):  # noqa: N818  # it is what the student reads, not a name that we raise by
    """What the function returned is not what it has to return; the message says what it is."""


def serve(path: Path, requests: BinaryIO, answers: BinaryIO) -> None:
    """Load the student's file and answer requests until there are no more."""
    function = _guarded(path, answers, lambda: _load(path))
    if function is None:
        return
    _say(answers, {"ok": True})
    while line := requests.readline():
        head = json.loads(line)
        limit_time(head["seconds"])
        rays = _received(requests, head["count"])
        began = time.perf_counter()
        found = _guarded(path, answers, lambda rays=rays: checked(function(*rays), len(rays[0])))
        if found is None:
            return
        _say(answers, {"ok": True, "seconds": time.perf_counter() - began}, *found)


def _load(path: Path) -> Any:
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location("student", path)
    assert spec and spec.loader, path  # it is a .py
    module = importlib.util.module_from_spec(spec)
    sys.modules["student"] = module
    spec.loader.exec_module(module)
    function = getattr(module, "intersect", None)
    if not callable(function):
        raise Refused("the file has no function 'intersect(origins, directions, triangles)'")
    return function


def checked(result: Any, count: int) -> Answer:
    """Return t (n,) and barycentrics (n, 3) as float64, or say what they are instead.

    Raises
    ------
    Refused
        If the function returned something else.
    """
    if not isinstance(result, tuple | list) or len(result) != 2:
        what = type(result).__name__
        if isinstance(result, tuple | list):
            what += f" of {len(result)}"
        raise Refused(f"intersect must return two arrays, t and barycentrics, not {what}")
    t, s = result
    return _numbers("t", t, (count,)), _numbers("barycentrics", s, (count, 3))


def _numbers(name: str, value: Any, shape: tuple[int, ...]) -> np.ndarray:
    try:
        array = np.asarray(np.ma.filled(value, np.inf))
    except Exception as error:
        raise Refused(f"{name} is no array of numbers: {error}") from None
    if array.dtype.kind not in "fiub":
        raise Refused(f"{name} has the dtype {array.dtype}; it must be float64")
    if array.shape != shape:
        turned = " (transposed?)" if array.shape == shape[::-1] and len(shape) == 2 else ""
        must = f"for n = {shape[0]} rays it must be {shape}"
        raise Refused(f"{name} has the shape {array.shape}{turned}; {must}")
    return array.astype(np.float64)


def _guarded(path: Path, answers: BinaryIO, work: Any) -> Any:
    """Return what some work gives; if it raises, answer with that, and return None."""
    try:
        return work()
    except BaseException as error:  # also sys.exit, and Ctrl-C that the code sends itself
        _say(answers, {"ok": False, **described(error, path)})
        return None


def described(error: BaseException, path: Path) -> dict[str, Any]:
    """Return what a student is told: the kind of error, the message, and the lines of the file."""
    kinds = {
        Refused: "answer",
        SyntaxError: "syntax",
        SystemExit: "exit",
        MemoryError: "memory",
        RecursionError: "exception",
    }
    kind = next((kinds[c] for c in type(error).__mro__ if c in kinds), "exception")
    try:
        text = str(error)
    except Exception:  # its own __str__ fails
        text = ""
    message = text if kind == "answer" else f"{type(error).__name__}: {text}".rstrip(": ")
    trace = [
        [
            Path(f.filename).name,
            f.lineno,
            f.name,
            linecache.getline(f.filename, f.lineno or 0).strip(),
        ]
        for f in traceback.extract_tb(error.__traceback__)
        if Path(f.filename).parent == path.parent
    ]
    file = Path(error.filename or "") if isinstance(error, SyntaxError) else None
    if isinstance(error, SyntaxError) and file and file.parent == path.parent:
        trace.append([file.name, error.lineno, "", (error.text or "").strip()])
        message = f"{type(error).__name__}: {error.msg}"
    return {"kind": kind, "message": message[:LONGEST], "trace": trace[-20:]}


def _received(requests: BinaryIO, count: int) -> tuple[np.ndarray, ...]:
    """Read origins, directions and triangles; nobody can write to them."""
    shapes = (count, 3), (count, 3), (count, 3, 3)
    return tuple(
        np.frombuffer(requests.read(8 * int(np.prod(shape))), np.float64).reshape(shape)
        for shape in shapes
    )


def _say(answers: BinaryIO, head: dict[str, Any], *arrays: np.ndarray) -> None:
    answers.write(json.dumps(head).encode() + b"\n")
    for array in arrays:
        answers.write(array.tobytes())
    answers.flush()


# What comes of a limit that the system does not know, or holds to be too large: there is none.
_NO_LIMIT = ImportError, ValueError, OSError, OverflowError


def limit_memory(size: int) -> None:
    """Let this process have so many bytes and no more, where the system can do that."""
    with suppress(*_NO_LIMIT):  # Windows has none of it, macOS not the first: time is limited
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (size, size))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def limit_time(seconds: float) -> None:
    """Let the system end this process, should nobody be left who does."""
    with suppress(*_NO_LIMIT):
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_CPU)
        resource.setrlimit(resource.RLIMIT_CPU, (int(time.process_time() + seconds) + 5, most))


def keep_from_forks(*streams: BinaryIO) -> None:
    """Give processes that the student's code forks nothing in place of these streams.

    Else two would answer a request, or one that outlives this process would keep the answers open.
    """
    if hasattr(os, "register_at_fork"):
        nothing, ends = os.open(os.devnull, os.O_RDWR), [s.fileno() for s in streams]
        os.register_at_fork(after_in_child=lambda: [os.dup2(nothing, end) for end in ends])


def main() -> None:
    """Serve over the standard streams, which the student's code gets others in place of."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    keep_from_forks(requests, answers)
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    limit_memory(int(sys.argv[2]))
    np.seterr(all="ignore")  # a ray that is parallel to a plane divides by zero, and may
    warnings.simplefilter("ignore")
    random.seed(0)
    np.random.seed(0)
    serve(Path(sys.argv[1]), requests, answers)
    answers.flush()
    os._exit(0)  # whatever threads the student's code has left


if __name__ == "__main__":
    main()

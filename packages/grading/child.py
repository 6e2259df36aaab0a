"""The process that runs a student's file: started as a script, it imports nothing but numpy.

    python child.py FILE FORM

Over its standard input come requests, over what was its standard output go answers: each a line of
JSON, then float64 numbers as they lie in memory. FORM is a `form.Form` as JSON. The student's own
printing goes to standard error. Whatever the student's code does wrong is an answer, too.
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

Form = dict[str, Any]


class Refused(Exception):  # noqa: N818  # it is what the student reads, not a name that we raise by
    """The function returned something of the wrong form; the message says what."""


def serve(path: Path, form: Form, requests: BinaryIO, answers: BinaryIO) -> None:
    """Load the student's file and answer requests until there are no more."""
    function = _guarded(path, answers, lambda: _load(path, form))
    if function is None:
        return
    _say(answers, {"ok": True})
    while line := requests.readline():
        head = json.loads(line)
        limit_time(head["seconds"])
        given = _received(requests, form, head["count"])
        began = time.perf_counter()
        found = _guarded(
            path, answers, lambda given=given: checked(function(*given), form, len(given[0]))
        )
        if found is not None:
            seconds = time.perf_counter() - began
            _say(answers, {"ok": True, "seconds": seconds}, found.tobytes())


def _load(path: Path, form: Form) -> Any:
    sys.path.insert(0, str(path.parent))
    spec = importlib.util.spec_from_file_location("student", path)
    assert spec and spec.loader, path  # it is a .py
    module = importlib.util.module_from_spec(spec)
    sys.modules["student"] = module
    spec.loader.exec_module(module)
    function = getattr(module, form["function"], None)
    if not callable(function):
        raise Refused(f"the file has no function '{form['signature']}'")
    return function


def checked(result: Any, form: Form, count: int) -> np.ndarray:
    """Return lines of answers (n, numbers) as float64, or say what they are instead.

    Raises
    ------
    Refused
        If the function returned something else.
    """
    wanted = form["answered"]
    if len(wanted) == 1:
        result = (result,)
    if not isinstance(result, tuple | list) or len(result) != len(wanted):
        what = type(result).__name__
        if isinstance(result, tuple | list):
            what += f" of {len(result)}"
        names = " and ".join(name for name, _ in wanted)
        raise Refused(f"{form['function']} must return {len(wanted)} arrays, {names}, not {what}")
    parts = [
        _numbers(name, value, (count, *shape)).reshape(count, -1)
        for (name, shape), value in zip(wanted, result, strict=True)
    ]
    return np.concatenate(parts, axis=1)


def _numbers(name: str, value: Any, shape: tuple[int, ...]) -> np.ndarray:
    if np.ma.isMaskedArray(value) and value.dtype.kind in "iub":
        value = value.astype(np.float64)  # whole numbers hold no infinity
    try:
        array = np.asarray(np.ma.filled(value, np.inf))
    except Exception as error:
        raise Refused(f"{name} is no array of numbers: {error}") from None
    if array.dtype.kind not in "fiub":
        raise Refused(f"{name} has the dtype {array.dtype}; it must be float64")
    if array.shape != shape:
        turned = " (transposed?)" if array.shape == shape[::-1] and len(shape) == 2 else ""
        must = f"for n = {shape[0]} it must be {shape}"
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
    }
    kind = next((kinds[c] for c in type(error).__mro__ if c in kinds), "exception")
    try:
        text = str(error)
    except Exception:  # its own __str__ fails
        text = ""
    message = text if kind == "answer" else f"{type(error).__name__}: {text}".rstrip(": ")
    if kind == "exception" and isinstance(error, TypeError | ValueError):  # as of code for one ray
        message += " (what it is given are arrays, a row for each ray: reftrace judge --template)"
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
    if isinstance(error, SyntaxError):
        file = Path(error.filename or "")
        if file.parent == path.parent:
            trace.append([file.name, error.lineno, "", (error.text or "").strip()])
            message = f"{type(error).__name__}: {error.msg}"
    return {"kind": kind, "message": message[:LONGEST], "trace": trace[-20:]}


def _received(requests: BinaryIO, form: Form, count: int) -> list[np.ndarray]:
    """Read what the function is given, (n, ...) each; nobody can write to it."""
    line = np.dtype([(name, np.float64, tuple(shape)) for name, shape in form["given"]])
    lines = np.frombuffer(requests.read(line.itemsize * count), line)
    given = [np.ascontiguousarray(lines[name]) for name in line.names or ()]
    for array in given:
        array.flags.writeable = False
    return given


def _say(answers: BinaryIO, head: dict[str, Any], numbers: bytes = b"") -> None:
    answers.write(json.dumps(head).encode() + b"\n" + numbers)
    answers.flush()


def limit_time(seconds: float) -> None:
    """Let the system end this process, should nobody be left who does."""
    # What comes of a limit that the system does not know, or holds to be too large: there is none.
    with suppress(ImportError, ValueError, OSError, OverflowError):
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
    np.seterr(all="ignore")  # a ray that is parallel to a plane divides by zero, and may
    warnings.simplefilter("ignore")
    random.seed(0)
    np.random.seed(0)
    serve(Path(sys.argv[1]), json.loads(sys.argv[2]), requests, answers)
    os._exit(0)  # whatever threads the student's code has left


if __name__ == "__main__":
    main()

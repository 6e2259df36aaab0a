"""A student's file as a function: run in a process of its own, with limits.

In goes what its function is given; out come the answers, or a `StudentError` which says what the
student's code did wrong. Nothing that it does ends or stops this process. In bubblewrap, where that
is, it writes nothing and reaches nobody (`processes/sandbox.py`); else it may do what its user may.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer_processes.running import KEPT, Limits, how, kill
from reference_tracer_processes.sandbox import kept_in, limited

from .form import Form
from .student_error import StudentError, parsed
from .submission import Submission

_LONGEST = 1 << 20  # bytes of a line that answers

_CHILD = Path(__file__).with_name("child.py")
_OWN = {  # of its environment
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "PYTHONHASHSEED": "0",
    "PYTHONIOENCODING": "utf-8",
    "PYTHONDONTWRITEBYTECODE": "1",
    "PYTHONUNBUFFERED": "1",  # what is printed is there when it is ended
}


class Student(Submission):
    """A student's file, running."""

    raising = "exception"

    def __init__(self, path: Path, form: Form, limits: Limits | None = None) -> None:
        super().__init__(form, limits)
        self.path = path.resolve()

    def _answered(self, question: Floats) -> Floats:
        with self._watched() as (to, back):
            head = {"count": len(question), "seconds": self._left}
            to.write(json.dumps(head).encode() + b"\n")
            to.write(question.tobytes())
            to.flush()
            self._hear(back)
            size = 8 * len(question) * self.form.numbers
            numbers = back.read(size)
            if len(numbers) < size:
                raise EOFError
            return np.frombuffer(numbers).reshape(-1, self.form.numbers)

    def end(self) -> None:
        """End the process, and what it has started, but for what has a session of its own."""
        process, self._process = self._process, None
        if process is None:
            return
        kill(process)
        process.wait()
        assert process.stdin and process.stdout
        for stream in (process.stdin, process.stdout):
            with suppress(OSError):
                stream.close()
        self._reader.join(1.0)

    def _begin(self) -> None:
        if self._process:
            return
        words = [sys.executable, "-P", str(_CHILD), str(self.path), self.form.to_json()]
        libraries = Path(sys.base_prefix), Path(sys.prefix), Path(np.__file__).parents[1]
        process = subprocess.Popen(
            kept_in(words, None, _OWN, self.path.parent, libraries),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            cwd=self.path.parent,
            env=os.environ | _OWN,
            start_new_session=True,  # Ctrl-C is for this process, which ends that one
            **limited(self.limits.memory),
        )
        self._runs(process)
        self._reader = threading.Thread(target=self._listen, args=(process.stderr,), daemon=True)
        self._reader.start()
        with self._watched() as (_, back):
            self._hear(back)

    def _listen(self, stream: IO[bytes]) -> None:
        """Read all that is printed, so that nobody waits for it, and keep the first of it."""
        # It closes its end itself: on a busy machine, or where what lives on has the other end
        # open, nobody else knows when.
        with suppress(OSError, ValueError), stream:
            while part := os.read(stream.fileno(), 1 << 16):
                self.printed += len(part)
                self._said += part[: KEPT - len(self._said)]

    @contextmanager
    def _watched(self) -> Iterator[tuple[IO[bytes], IO[bytes]]]:
        """Give the two ends for one exchange, which ends with the time limit."""
        process, late = self._process, threading.Event()
        assert process and process.stdin and process.stdout

        def stop() -> None:
            late.set()
            kill(process)

        watch = threading.Timer(min(max(self._left, 0.0), threading.TIMEOUT_MAX), stop)
        watch.daemon = True
        began, well = time.monotonic(), False
        watch.start()
        try:
            yield process.stdin, process.stdout
            well = True
        except StudentError as error:
            well = error.kind == self.raising  # it may be asked again
            raise
        except (EOFError, OSError) as error:
            code = process.wait()
            if late.is_set():
                text = f"took longer than the time limit of {self.limits.seconds:g} s for one scene"
                text += " (does it ever end? If it is only slow, raise it with --time-limit)"
                raise StudentError("time", text) from error
            text = f"the process {how(code)}, before it had answered"
            raise StudentError("ended", text) from error
        finally:
            watch.cancel()
            self._left -= time.monotonic() - began
            if not well:
                self.end()

    def _hear(self, back: IO[bytes]) -> None:
        """Read the head of an answer, and note the seconds that it has taken.

        Raises
        ------
        StudentError
            If the answer is one.
        """
        line = back.readline(_LONGEST)
        if not line.endswith(b"\n") and len(line) < _LONGEST:
            raise EOFError
        try:
            seconds, wrong = parsed(line, self.limits.memory)
        except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            text = "its process answered something that is no answer: does the file write to other"
            text += " streams than the standard ones, or change numpy or json?"
            raise StudentError("ended", text) from error
        self.seconds += seconds
        if wrong:
            raise wrong

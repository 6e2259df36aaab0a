"""A process that traces bands of pictures: what it is told, what it answers, how it is started.

Over the connection come a `Job`, then bands, then None for the end of the job; and so on, until the
connection is closed. Out go `Ready` at the start, `Prepared` for a job, and for a band the shares
of it that are done, then `Done`; or `Failed`, which is the end.
"""

from __future__ import annotations

import pickle
import signal
import sys
import time
import traceback
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from types import ModuleType

from .frame import Frame
from .hits import Name, Statistics
from .progress import result_of
from .render import prepare
from .settings import Settings
from .shared import FrameTicket, SceneTicket, clear

_OFTEN = 0.1  # seconds between two shares


@dataclass(frozen=True)
class Job:
    """A picture that bands will be asked of; the settings are resolved."""

    scene: SceneTicket
    frame: FrameTicket
    settings: Settings


class Ready:
    """The process has started."""


@dataclass(frozen=True)
class Prepared:
    """The job's bands may come."""

    refused: int  # of the statistics


@dataclass(frozen=True)
class Done:
    """A band is traced: what it took, and all that may be seen where that is open."""

    statistics: Statistics
    ties: dict[int, frozenset[Name]]


@dataclass(frozen=True)
class Failed:
    """What was raised, and where."""

    error: Exception
    traceback: str


@contextmanager
def started_apart() -> Iterator[None]:
    """Let processes that are spawned in the block be none of this one's business, nor it of theirs.

    They do not run its main script again, which need not be made for that and may import Blender;
    and Ctrl-C, which a terminal sends to all, does not reach them: it ends them through this one.
    """
    main, sys.modules["__main__"] = sys.modules["__main__"], ModuleType("__main__")
    masked = hasattr(signal, "pthread_sigmask")
    if masked:
        from multiprocessing import resource_tracker

        resource_tracker.ensure_running()  # by now, as it unblocks the signal
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # which is inherited
    try:
        yield
    finally:
        if masked:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        sys.modules["__main__"] = main


def serve(connection: Connection) -> None:
    """Do what the other end of the connection asks for, until that is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # where it could not be blocked
    with suppress(EOFError, OSError):  # whoever asks is gone
        connection.send(Ready())
        while True:
            job = connection.recv()
            try:
                _trace(connection, job)
            except EOFError:
                raise
            except Exception as error:
                connection.send(Failed(_sendable(error), traceback.format_exc()))
                return


def _trace(connection: Connection, job: Job) -> None:
    scene = job.scene.open()
    frame = job.frame.open(scene)
    band_tracer = result_of(prepare(scene, job.settings, frame))
    connection.send(Prepared(frame.statistics.refused))
    first = scene.camera.region.y0
    while (band := connection.recv()) is not None:
        clear(frame, slice(band.y0 - first, band.y1 - first))
        said = time.monotonic()
        for share in band_tracer(band):
            if (now := time.monotonic()) > said + _OFTEN:
                connection.send(share)
                said = now
        connection.send(_taken(frame))


def _taken(frame: Frame) -> Done:
    """Take what the last band has counted and found out of a frame."""
    counted, ties = frame.statistics, frame.ties
    taken = replace(counted, reasons=Counter(counted.reasons), stages=Counter(counted.stages))
    counted.pairs_tested = 0
    counted.reasons.clear()
    counted.stages.clear()
    frame.ties = {}
    return Done(taken, ties)


def _sendable(error: Exception) -> Exception:
    """Return the error, or what says the same where the error cannot be sent."""
    try:
        pickle.loads(pickle.dumps(error))
    except Exception:
        return RuntimeError(f"{type(error).__name__}: {error}")
    return error

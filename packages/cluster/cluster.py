"""Tasks that are given to Dask's workers, and their answers.

Dask says who works on what: it does a task anew that fails, or whose worker is lost.
"""

from __future__ import annotations

import asyncio
import warnings
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from threading import Event
from typing import Any

from distributed import Client, Future
from distributed.client import FutureCancelledError
from reference_tracer.arrays import Floats
from reference_tracer.errors import words
from reference_tracer.scene import Scene
from reference_tracer.tracer.progress import Work

from . import tasks

RETRIES = 2  # of a task that fails
TICK = 0.2  # seconds, after which whoever waits may show progress, or stop
PATIENCE = 10.0  # seconds for an answer to come, once there is one; then it is asked for again


class ClusterError(OSError):
    """The workers cannot do it; the message names which, and why."""


@dataclass(eq=False)
class Cluster:
    """The workers of a scheduler."""

    client: Client
    address: str
    sent: tuple[Scene, Future] | None = None  # the last scene, and where it is there

    def workers(self) -> dict[str, int]:
        """Return the address of each worker, and how many tasks it does at a time."""
        return self.client.nthreads()

    def keep(self, data: Scene | Floats) -> Future:
        """Send data, once; a task that is given the result is given the data.

        Dask brings them to who needs them, from one worker to another.
        """
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # that it is large
            return self.client.submit(tasks.kept, data, pure=False)

    def ask(self, task: Callable, *arguments: Any) -> Future:
        """Have a task done."""
        return self.client.submit(task, tasks.about(), *arguments, retries=RETRIES, pure=False)

    def answer(self, asked: Future) -> Work[Any]:
        """Wait for the answer; return it.

        Raises
        ------
        ClusterError
            If there is none to come.
        """
        try:
            done = Event()
            asked.add_done_callback(lambda _: done.set())
            while True:
                yield None
                done.wait(TICK)
                done.clear()
                if asked.done():
                    with suppress(TimeoutError):  # whoever has it is slow, or was lost meanwhile
                        return asked.result(PATIENCE)
                elif not self.workers():
                    raise ClusterError(f"no worker of the scheduler at {self.address} is left")
        except ClusterError:
            raise
        except (OSError, FutureCancelledError, asyncio.CancelledError):
            raise ClusterError(f"the scheduler at {self.address} has ended") from None
        except Exception as error:
            raise ClusterError(words(error)) from error

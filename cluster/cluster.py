"""Tasks that are given to workers, and their answers: retried, or asked for elsewhere, until there.

Dask says who works on what; here is only what it leaves open. A worker that is silent, neither dead
nor alive, is not waited for: its task is given to another one, too, and the first answer counts.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from hashlib import sha256
from queue import Empty, SimpleQueue
from typing import Any

from distributed import Client, Future
from distributed.client import FutureCancelledError
from distributed.utils_comm import gather_from_workers
from reference_tracer.arguments import words
from reference_tracer.tracer.progress import Work

from . import tasks

RETRIES = 2  # of a task that fails
LATE = 20.0  # seconds after which a task is given to another worker, too; then twice as many, ...
TICK = 0.2  # seconds, after which whoever waits may show progress, or stop


class ClusterError(OSError):
    """The workers cannot do it; the message names which, and why."""


@dataclass(eq=False)
class Asked:
    """A task that was given away, perhaps more than once, and its answers as they come."""

    task: Callable[..., bytes]
    arguments: tuple
    without: frozenset[str]  # the workers that must not do it
    answers: SimpleQueue = field(default_factory=SimpleQueue)
    futures: list[Future] = field(default_factory=list)


@dataclass(eq=False)
class Cluster:
    """The workers of a scheduler."""

    client: Client
    address: str
    sent: tuple[tuple, str] | None = None  # the parts of the last scene, and its name
    kept: dict[str, bytes] = field(default_factory=dict)  # what workers are sent, by name
    silent: set[str] = field(default_factory=set)  # workers that have not answered in time

    def workers(self) -> dict[str, int]:
        """Return the address of each worker, and how many tasks it does at a time."""
        return self.client.nthreads()

    def keep(self, data: bytes) -> str:
        """Send bytes to each worker, once; return the name by which tasks find them there."""
        name = sha256(data).hexdigest()
        if name not in self.kept:
            self.kept[name] = data
            workers = [worker for worker in self.workers() if worker not in self.silent]
            self.client.run(tasks.keep, name, data, workers=workers)
        return name

    def ask(self, task: Callable, *arguments: Any, without: frozenset[str] = frozenset()) -> Asked:
        """Have a task done, with plain arguments."""
        asked = Asked(task, arguments, without)
        self._send(asked)
        return asked

    def answer(self, asked: Asked) -> Work[tuple[bytes, str]]:
        """Wait for the answer, yielding 0; return it, and whose it is.

        Raises
        ------
        ClusterError
            If there is none to come.
        """
        began, patience = time.monotonic(), LATE
        while True:
            try:
                found, worker = asked.answers.get(timeout=TICK)
                if not (isinstance(found, LookupError) and found.args[0] in self.kept):
                    break
                name, worker = found.args  # it has come later than what was sent to all
                self.client.run(tasks.keep, name, self.kept[name], workers=[worker])
                self._send(asked)
            except Empty:
                yield 0.0
            if time.monotonic() - began > patience:
                patience *= 2
                self._send_elsewhere(asked)
        if isinstance(found, OSError | FutureCancelledError | asyncio.CancelledError):
            raise ClusterError(f"the scheduler at {self.address} has ended") from None
        if isinstance(found, BaseException):
            raise ClusterError(words(found)) from found
        asked.futures.clear()
        return found, worker

    def _send(self, asked: Asked) -> None:
        others = [a for a in self.workers() if a not in asked.without] if asked.without else None
        options = {"workers": others, "retries": RETRIES, "pure": False}
        future = self.client.submit(asked.task, *asked.arguments, **options)
        asked.futures.append(future)
        loop = self.client.loop.asyncio_loop
        future.add_done_callback(
            lambda _: asyncio.run_coroutine_threadsafe(self._fetch(asked, future), loop)
        )

    async def _fetch(self, asked: Asked, future: Future) -> None:
        """Fetch an answer by itself, in the client's own thread.

        Awaited, it would come with others: they wait for each other where a worker is silent.
        """
        try:
            if future.status != "finished":
                await future  # which raises what is wrong
            [worker] = (await self.client.who_has([future]))[future.key] or ["that is gone"]
            if self.address.startswith("local:"):  # else there may be no way but the scheduler's
                got, *_ = await gather_from_workers({future.key: [worker]}, rpc=self.client.rpc)
            else:
                got = (await self.client.scheduler.gather(keys=[future.key])).get("data", {})
            found = got[future.key] if future.key in got else await future
        except BaseException as error:
            found, worker = error, ""
        asked.answers.put((found, worker))

    def _send_elsewhere(self, asked: Asked) -> None:
        """Give a late task to another worker, too, if there is one."""
        workers, keys = self.workers(), {future.key for future in asked.futures}
        if not workers:
            raise ClusterError(f"no worker of the scheduler at {self.address} is left")
        busy = {a for a, own in self.client.processing().items() if keys & set(own)}
        busy |= {a for some in self.client.who_has(asked.futures).values() for a in some}
        if busy and set(workers) - busy - asked.without:
            self.silent |= busy
            asked.without |= busy
            self._send(asked)

"""Tasks that are given to workers, and their answers: retried, or asked for elsewhere, until there.

Dask says who works on what; here is only what it leaves open. A worker that is silent, neither dead
nor alive, is not waited for: its task is given to another one, too, and the first answer counts.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from hashlib import sha256
from queue import Empty, SimpleQueue
from typing import Any

from distributed import Client, Future
from distributed.client import FutureCancelledError
from distributed.utils_comm import gather_from_workers
from reference_tracer.errors import words
from reference_tracer.tracer.progress import Work

from . import tasks

RETRIES = 2  # of a task that fails
LATE = 20.0  # seconds after which a task is given to another worker, too; then twice as many, ...
TICK = 0.2  # seconds, after which whoever waits may show progress, or stop
PATIENCE = 10.0  # seconds in which a worker answers a short question
SLOWEST = 1e6  # bytes a second that reach workers
KEPT = 3  # things that are sent to all, here as there


class ClusterError(OSError):
    """The workers cannot do it; the message names which, and why."""


class NobodyError(ClusterError):
    """Nobody is left who may do a task."""


@dataclass(eq=False)
class Asked:
    """A task that was given away, perhaps more than once, and its answers as they come."""

    task: Callable[..., Any]
    arguments: tuple
    busy: set[str] = field(default_factory=set)  # those that are late with it
    only: set[str] | None = None  # those it was last given to, where not to all
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

    @property
    def _nobody(self) -> str:
        return f"no worker of the scheduler at {self.address} is left"

    def workers(self) -> dict[str, int]:
        """Return the address of each worker, and how many tasks it does at a time."""
        return self.client.nthreads()

    def told(self, task: Callable[[], Any]) -> dict[str, Any]:
        """Return what each worker says to a short question; from who does not, none is expected."""
        asked = [worker for worker in self.workers() if worker not in self.silent]

        async def answer(worker: str) -> Any:
            options = {"workers": [worker], "on_error": "return", "asynchronous": True}
            return (await self.client.run(task, **options, callback_timeout=PATIENCE))[worker]

        async def every() -> list:
            return await asyncio.gather(*map(answer, asked), return_exceptions=True)

        said = dict(zip(asked, self.client.sync(every), strict=True))
        self.silent |= {worker for worker, answer in said.items() if isinstance(answer, OSError)}
        return {worker: said[worker] for worker in asked if worker not in self.silent}

    def keep(self, data: bytes) -> str:
        """Send bytes to each worker, once; return the name by which tasks find them there."""
        name = sha256(data).hexdigest()
        is_new = name not in self.kept
        self.kept[name] = self.kept.pop(name, data)
        for old in list(self.kept)[:-KEPT]:
            del self.kept[old]
        if is_new:
            self._bring(name, list(self.told(tasks.about)))
        return name

    def _bring(self, name: str, workers: list[str]) -> None:
        """Send bytes to workers; who has not got them in time will say so."""
        data = self.kept[name]
        patience = PATIENCE + len(data) / SLOWEST
        options = {"workers": workers, "on_error": "return", "callback_timeout": patience}
        with suppress(TimeoutError):
            self.client.run(tasks.keep, name, data, **options)

    def ask(self, task: Callable, *arguments: Any) -> Asked:
        """Have a task done, with plain arguments."""
        asked = Asked(task, arguments)
        self._send(asked)
        return asked

    def answer(self, asked: Asked) -> Work[Any]:
        """Wait for the answer; return it.

        Raises
        ------
        NobodyError
            If nobody is left who may give it.
        ClusterError
            If there is none to come.
        """
        began, patience, brought = time.monotonic(), LATE, 0
        while True:
            yield None
            try:
                found, worker = asked.answers.get(timeout=TICK)
            except Empty:
                is_late = time.monotonic() - began > patience
                if is_late:
                    patience *= 2
                if is_late or asked.only is not None:
                    self._send_elsewhere(asked, is_late)
                continue
            if not (isinstance(found, LookupError) and found.args[0] in self.kept):
                break
            name, worker = found.args  # it has come later than what was sent to all
            if brought == RETRIES:
                raise ClusterError(f"worker {worker} does not keep what it is sent")
            brought += 1
            self._bring(name, [worker])
            self._send(asked)
        if isinstance(found, NobodyError):
            raise found
        if isinstance(found, OSError | FutureCancelledError | asyncio.CancelledError):
            raise ClusterError(f"the scheduler at {self.address} has ended") from None
        if isinstance(found, BaseException):
            raise ClusterError(words(found)) from found
        asked.futures.clear()
        self.silent.discard(worker)
        return found

    def _send(self, asked: Asked) -> None:
        if asked.busy or self.silent:
            may = set(self.workers())
            asked.only = may - asked.busy - self.silent or may - asked.busy or may
            if not may:  # no workers are all workers to Dask
                asked.answers.put((NobodyError(self._nobody), ""))
                return
        options = {"workers": asked.only and list(asked.only), "retries": RETRIES, "pure": False}
        future = self.client.submit(asked.task, *asked.arguments, **options)
        asked.futures.append(future)
        loop = self.client.loop.asyncio_loop

        def done(future: Future) -> None:
            if future.cancelled():  # by the end of the scheduler, or of the client and its loop
                asked.answers.put((asyncio.CancelledError(), ""))
            else:
                asyncio.run_coroutine_threadsafe(self._fetch(asked, future), loop)

        future.add_done_callback(done)

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

    def _send_elsewhere(self, asked: Asked, is_late: bool) -> None:
        """Give a task that is late, or whose workers are gone, to another one, if there is one."""
        workers, busy = set(self.workers()), set()
        if not workers:
            raise NobodyError(self._nobody)
        if is_late:
            keys = {future.key for future in asked.futures}
            busy = {a for a, own in self.client.processing().items() if keys & set(own)}
            busy |= {a for some in self.client.who_has(asked.futures).values() for a in some}
        is_gone = asked.only is not None and not asked.only & workers
        if workers - busy - asked.busy:
            if busy or is_gone:
                self.silent |= busy
                asked.busy |= busy
                self._send(asked)

"""Several processes that trace one picture, band by band, into memory that they share.

`Workers.steps` does what `render.steps` does, and gives the same picture, to the last bit. In goes
a scene; to the workers go tickets for it and for the frame, then bands, one after the other; back
come small messages: how far they are, what it took, which pixels are ambiguous. They start afresh,
never as copies of this process (which may be Blender's), and import nothing but the tracer.
"""

from __future__ import annotations

import multiprocessing
import signal
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, NoReturn

from .. import interrupts
from ..scene import Region, Scene
from .frame import Frame
from .render import WHOLE, Steps, bands, render, resolved, steps
from .settings import Settings
from .shared import Blocks, share_frame, share_scene
from .worker import Done, Failed, Job, Ready, serve, started_apart
from .workload import even_bands, workload

_PATIENCE = 0.05  # seconds after which a step ends though nobody has said anything
_FAREWELL = 2.0  # seconds that a worker has to end by itself


class WorkerError(RuntimeError):
    """A worker is gone; the message says which and how."""


class WorkerTraceback(Exception):  # noqa: N818  # it is not raised: it is the cause of what is
    """Where in a worker an error was raised, as text."""

    def __str__(self) -> str:
        return f"\n{self.args[0]}"


def render_with(
    scene: Scene,
    settings: Settings | None = None,
    processes: int = 1,
    progress: Callable[[float], None] | None = None,
) -> Frame:
    """Trace a scene with several processes.

    Parameters
    ----------
    scene : Scene
    settings : Settings, optional
        The memory is what each of the processes may take.
    processes : int
        With 1, this process traces, as `render.render` does.
    progress : callable, optional
        Called with the share of the work that is done, 0 to 1; 1 only at the end.

    Returns
    -------
    Frame
        That of `render.render`, bit for bit; of the statistics, how many pairs were tested depends
        on how the picture was divided.

    Raises
    ------
    ValueError
        If there are to be no processes.
    WorkerError
        If a process has come to an end, for example as there was no memory left.
    Exception
        What a worker raises is raised here, with its traceback.
    """
    if processes == 1:
        return render(scene, settings, progress)
    with Workers(processes) as workers:
        r = scene.camera.region  # of which one pixel will do, as the arrays are replaced
        pixel = replace(scene.camera, region=Region(r.x0, r.y0, r.x0 + 1, r.y0 + 1))
        frame = Frame.empty(replace(scene, camera=pixel))
        for share in workers.steps(scene, settings or Settings(), frame):
            if progress:
                progress(share)
    return frame


@contextmanager
def tracing(processes: int) -> Iterator[Steps]:
    """Give what traces with so many processes, like `render.steps`, for any number of pictures."""
    if processes == 1:
        yield steps
        return
    with Workers(processes) as workers:
        yield workers.steps


@dataclass(eq=False)
class _Worker:
    name: str
    process: BaseProcess
    connection: Connection
    ready: bool = False
    band: int = -1  # the number of what it traces


class Workers:
    """Processes that wait for work, at least one of them, until the end of a `with` block."""

    def __init__(self, processes: int) -> None:
        if processes < 1:
            raise ValueError(f"processes is {processes}; it must be at least 1")
        self._blocks = Blocks()
        self._workers: list[_Worker] = []
        context = multiprocessing.get_context("spawn")
        try:
            with started_apart():
                for number in range(1, processes + 1):
                    ours, theirs = context.Pipe()
                    process = context.Process(target=serve, args=(theirs,), daemon=True)
                    process.start()
                    theirs.close()
                    name = f"worker {number} of {processes} (process {process.pid})"
                    self._workers.append(_Worker(name, process, ours))
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, error: object, *_: object) -> None:
        self.close(now=error is not None)

    def close(self, now: bool = True) -> None:
        """End the processes, `now` as something was raised, or once they are done, and the memory.

        Ctrl-C waits for that. Next to what was raised it is dropped.
        """
        if not self._workers:
            return
        with suppress(KeyboardInterrupt) if now else nullcontext(), interrupts.held():
            for worker in self._workers:
                worker.connection.close()
                if now:
                    worker.process.terminate()
            for worker in self._workers:
                worker.process.join(_FAREWELL)
                if worker.process.is_alive():
                    worker.process.kill()
                    worker.process.join()
            self._workers = []
            self._blocks.let_go()  # last: nobody opens them any more

    def wait_until_ready(self) -> Iterator[float]:
        """Wait until all have started; yields 0 every now and then."""
        while not all(worker.ready for worker in self._workers):
            for worker, message in self._messages():
                worker.ready |= isinstance(message, Ready)
            yield 0.0

    def steps(self, scene: Scene, settings: Settings, frame: Frame) -> Iterator[float]:
        """Trace a scene into a frame, whose arrays are replaced by such as are shared.

        Yields the share of the work done, from 0 to 1. Whoever stops asking before the end, ends
        the workers. What counts as time is the clock's, but for waiting until all have started.
        """
        try:
            if not self._workers:
                raise WorkerError("the workers have ended: start others")
            began = time.perf_counter()
            settings = resolved(settings, frame.statistics)
            job = self._job(scene, settings, frame)  # while they start
            waiting = time.perf_counter()
            yield from self.wait_until_ready()
            began += time.perf_counter() - waiting
            yield from self._trace(scene, job, frame)
            frame.statistics.seconds += time.perf_counter() - began
        except BaseException:
            self.close()
            raise
        yield 1.0

    def _trace(self, scene: Scene, job: Job, frame: Frame) -> Iterator[float]:
        frame.statistics.triangles = scene.triangle_count
        busy = set(self._workers)
        for worker in busy:
            self._send(worker, job)
        region, most_rows = scene.camera.region, bands(scene.camera, job.settings)[0].height
        parts = even_bands(region, workload(scene), len(busy), most_rows)  # while they prepare
        waiting, shares, done = deque(range(len(parts))), [0.0] * len(parts), {}
        while busy:  # also those for whom nothing is left
            for worker, message in self._messages():
                if isinstance(message, float):
                    shares[worker.band] = message
                    continue
                if isinstance(message, Done):
                    done[worker.band], shares[worker.band] = message, 1.0
                else:
                    frame.statistics.refused = message.refused
                if waiting:
                    worker.band = waiting.popleft()
                    self._send(worker, parts[worker.band])
                else:
                    self._send(worker, None)
                    busy.remove(worker)
            yield WHOLE * sum(shares) / len(shares)
        self._blocks.let_go()  # who has arrays in them keeps them
        for number in range(len(parts)):  # in their order, whoever was first
            frame.statistics.add(done[number].statistics)
            frame.ties.update(done[number].ties)

    def _job(self, scene: Scene, settings: Settings, frame: Frame) -> Job:
        ticket, shared = share_frame(scene, self._blocks)
        frame.scene = scene
        for name, values in shared.arrays().items():
            setattr(frame, name, values)
        return Job(share_scene(scene, self._blocks), ticket, settings)

    def _send(self, worker: _Worker, message: Job | Region | None) -> None:
        try:
            worker.connection.send(message)
        except OSError:
            self._lost(worker)

    def _messages(self) -> Iterator[tuple[_Worker, Any]]:
        """Yield what workers say, at most one message of each, and wait a little for the first."""
        by_connection = {worker.connection: worker for worker in self._workers}
        for connection in wait(list(by_connection), _PATIENCE):
            worker = by_connection[connection]
            try:
                message = connection.recv()
            except (EOFError, OSError):
                self._lost(worker)
            if isinstance(message, Failed):
                raise message.error from WorkerTraceback(message.traceback)
            yield worker, message

    def _lost(self, worker: _Worker) -> NoReturn:
        worker.process.join(_FAREWELL)
        code = worker.process.exitcode
        how = f"with exit code {code}"
        if code is not None and code < 0:
            how = f"by {signal.Signals(-code).name}"
        raise WorkerError(
            f"{worker.name} was ended {how} before its work was done (systems end processes when "
            "memory runs out: choose fewer processes, or a smaller size)"
        )

"""Measures what a picture takes in memory at its peak, from outside, in processes of its own.

This module, run as a script with a scene's name and jobs, builds the mesh once and traces each job
in a fork, whose peak starts at what is held when it begins. The system's count of pages sees what
every library takes, not only numpy.
"""

from __future__ import annotations

import json
import multiprocessing
import os
import subprocess
import sys
from collections.abc import Generator
from dataclasses import asdict, dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from reference_tracer.methods import Method
from reference_tracer.rendering import render, trace
from reference_tracer.scene import Scene
from reference_tracer.tracer.settings import Settings

from .scenes import build, mesh_of

LATE = -1  # in place of a peak
LONGEST = 15.0  # seconds for an unproven method's picture: 100,000 slivers would take minutes


@dataclass(frozen=True)
class Job:
    """One picture of a scene; `whole` is `render`, with all passes, else `trace`."""

    width: int
    height: int
    camera: str
    method: str
    whole: bool

    @property
    def is_proven(self) -> bool:
        """Whether its method is."""
        return Method(self.method).is_proven


def peaks(name: str, cache: Path, jobs: list[Job]) -> Generator[int | None, None, None]:
    """Yield each job's peak in bytes, beside scene and libraries.

    None where it cannot be known; LATE where an unproven method takes longer than LONGEST.
    """
    if not hasattr(os, "fork"):
        yield from (None for _ in jobs)
        return
    process = subprocess.Popen(
        [sys.executable, "-m", "reference_tracer_benchmarks.memory"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        request = {
            "name": name,
            "cache": str(cache),
            "jobs": [asdict(job) for job in jobs],
            "longest": LONGEST,
        }
        process.stdin.write(json.dumps(request))
        process.stdin.close()
        for _ in jobs:
            line = process.stdout.readline()
            yield json.loads(line) if line else None
    finally:
        process.kill()
        process.stdout.close()
        process.wait()


def _answer(request: dict) -> None:
    mesh, small = mesh_of(request["name"], Path(request["cache"])), mesh_of("cube", Path())
    _return_freed()
    for job in (Job(**job) for job in request["jobs"]):
        pictures = build(small, 16, 9, job.camera), build(mesh, job.width, job.height, job.camera)
        print(json.dumps(_of_a_fork(pictures, job, request["longest"])), flush=True)


def _of_a_fork(pictures: tuple[Scene, Scene], job: Job, longest: float) -> int | None:
    """Return by how much a fork's peak rises for the second picture, bytes.

    None if it fails, LATE if it is an unproven method's and takes longer than `longest` seconds.
    """
    forking = multiprocessing.get_context("fork")
    reads, writes = forking.Pipe(duplex=False)
    child = forking.Process(target=_trace, args=(pictures, job, writes))
    child.start()
    writes.close()
    try:
        found: int = reads.recv() if reads.poll(None if job.is_proven else longest) else LATE
    except EOFError:
        return None
    finally:
        child.kill()
        child.join()
    return found


def _trace(pictures: tuple[Scene, Scene], job: Job, writes: Connection) -> None:
    work, settings = render if job.whole else trace, Settings(Method(job.method))
    _ = work(pictures[0], settings).t  # pages of libraries come in once they are used
    before = _peak()
    result = work(pictures[1], settings)
    _ = result.t  # with the barycentrics, which are found with it, when they are asked for
    writes.send(_peak() - before)


def _return_freed() -> None:
    """Give back what the making of the mesh has left: a picture that fits there would seem free."""
    import ctypes

    if trim := getattr(ctypes.CDLL(None), "malloc_trim", None):  # glibc's
        trim(0)


def _peak() -> int:
    """Return the most that this process has held, bytes."""
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


if __name__ == "__main__":
    _answer(json.load(sys.stdin))

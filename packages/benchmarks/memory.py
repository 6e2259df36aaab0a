"""Measures what a picture takes in memory at its peak, from outside, in processes of its own.

This module, run as a script with a scene's name and jobs, builds the mesh once and traces each job
in a fork, whose peak starts at what is held when it begins. The system's count of pages sees what
every library takes, not only numpy.
"""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Generator
from dataclasses import asdict, dataclass
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
    reads, writes = os.pipe()
    if child := os.fork():
        os.close(writes)
        patience = None if Method(job.method).is_proven else longest
        if not select.select([reads], [], [], patience)[0]:
            os.kill(child, signal.SIGKILL)
            os.close(reads)
            os.waitpid(child, 0)
            return LATE
        with os.fdopen(reads) as file:
            said = file.read()
        os.waitpid(child, 0)
        return int(said) if said else None
    try:
        work, settings = render if job.whole else trace, Settings(job.method)
        _ = work(pictures[0], settings).t  # pages of libraries come in once they are used
        before = _peak()
        result = work(pictures[1], settings)
        t = result.t  # with the barycentrics, which are found with it, when they are asked for
        os.write(writes, str(_peak() - before).encode())
        del result, t
    finally:
        os._exit(0)  # nothing of the parent's is to be cleaned up here


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

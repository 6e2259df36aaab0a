"""Measures what a picture takes in memory at its peak, from outside, in processes of its own.

A process makes the mesh once and traces each job in a fork, whose peak starts at what is held when
it begins. The system's count of pages sees what every library takes, not only numpy.
"""

from __future__ import annotations

import multiprocessing
import os
import sys
from collections.abc import Generator
from dataclasses import dataclass
from functools import lru_cache
from multiprocessing.connection import Connection
from pathlib import Path

from reference_tracer.methods import Method
from reference_tracer.rendering import render, trace
from reference_tracer.scene import Mesh, Scene
from reference_tracer.tracer.settings import Settings

from .children import Child
from .peers import MissingPeerError
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


def peaks(name: str, cache: Path | None, jobs: list[Job]) -> Generator[int | None, None, None]:
    """Yield each job's peak in bytes, beside scene and libraries.

    None where it cannot be known; LATE where an unproven method takes longer than LONGEST.
    """
    if not hasattr(os, "fork"):
        yield from (None for _ in jobs)
        return
    child = Child()
    try:
        for job in jobs:
            try:
                yield child.call(peak_of, name, cache, job, LONGEST)
            except MissingPeerError:
                yield None
    finally:
        child.end()


@lru_cache(maxsize=1)
def _meshes(name: str, cache: Path | None) -> tuple[Mesh, Mesh]:
    both = mesh_of("cube", cache), mesh_of(name, cache)
    _return_freed()
    return both


def peak_of(name: str, cache: Path | None, job: Job, longest: float) -> int | None:
    """Return a job's peak, as `peaks` yields it; the mesh is made once in a process."""
    small, mesh = _meshes(name, cache)
    pictures = build(small, 16, 9, job.camera), build(mesh, job.width, job.height, job.camera)
    return _of_a_fork(pictures, job, longest)


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
    work = render if job.whole else trace
    settings = Settings(Method(job.method))
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

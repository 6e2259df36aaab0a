"""What a picture takes in memory at its peak, measured from outside, in processes of its own.

In come a scene's name and jobs; out go bytes. `python -m ...study.bench.memory` builds the mesh
once and traces each job in a fork, whose peak starts at what is held when it begins. The system's
count of pages sees what every library takes, not only numpy.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from ...scene import Scene
from ...tracer.render import render, trace
from ...tracer.settings import Settings
from .children import environment, package
from .scenes import build, mesh_of

# Arrays of this size and more go back to the system when they are freed (glibc): what the making of
# the mesh has left behind would hide what the picture takes.
_RETURNED = str(64 << 10)


@dataclass(frozen=True)
class Job:
    """One picture of a scene; `whole` is `render`, with all passes, else `trace`."""

    width: int
    height: int
    camera: str
    method: str
    precision: str
    whole: bool


def peaks(name: str, cache: Path, jobs: list[Job]) -> Iterator[int | None]:
    """Yield each job's peak in bytes, beside scene and libraries; None where it cannot be known."""
    if not hasattr(os, "fork"):
        yield from (None for _ in jobs)
        return
    process = subprocess.Popen(
        [sys.executable, "-m", f"{package()}.study.bench.memory"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env=environment(MALLOC_MMAP_THRESHOLD_=_RETURNED, MALLOC_TRIM_THRESHOLD_=_RETURNED),
        start_new_session=True,
    )
    try:
        request = {"name": name, "cache": str(cache), "jobs": [asdict(job) for job in jobs]}
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
    mesh = mesh_of(request["name"], Path(request["cache"]))
    warm_up = build(mesh_of("cube", Path()), 16, 9, "perspective")
    for job in (Job(**job) for job in request["jobs"]):
        settings = Settings(job.method, job.precision)
        work = render if job.whole else trace
        work(warm_up, settings)  # libraries load what they need
        print(json.dumps(_of_a_fork(build(mesh, job.width, job.height, job.camera), work, settings)))
        sys.stdout.flush()


def _of_a_fork(scene: Scene, work: object, settings: Settings) -> int | None:
    """Return by how much a fork's peak rises while it works, bytes; None if it fails."""
    reads, writes = os.pipe()
    if child := os.fork():
        os.close(writes)
        with os.fdopen(reads) as file:
            said = file.read()
        os.waitpid(child, 0)
        return int(said) if said else None
    code = 1
    try:
        before = _peak()
        kept = work(scene, settings)
        os.write(writes, str(_peak() - before).encode())
        code = 0 if kept is not None else 1
    finally:
        os._exit(code)  # nothing of the parent's is to be cleaned up here


def _peak() -> int:
    """Return the most that this process has held, bytes."""
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


if __name__ == "__main__":
    _answer(json.load(sys.stdin))

"""Real schedulers and workers of Dask, in processes of their own on this machine."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
import trimesh
from reference_tracer.scene import Scene
from reference_tracer_cluster.connection import connected

SHARED = pytest.StashKey["Dask"]()
WAIT = 60.0  # seconds for a process to begin, on a machine with more to do
# What an idle process of Dask does all the time, which no test is about: less of it.
QUIET = {
    "DASK_DISTRIBUTED__ADMIN__SYSTEM_MONITOR__INTERVAL": "5s",
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
}


class Dask:
    """A scheduler, and its workers by their names; all end with it."""

    def __init__(self, folder: Path, *tls: str) -> None:
        self.folder, self.processes, self._tls = folder, {}, tls
        told = folder / "scheduler.json"
        self._start("scheduler", "--port", "0", "--scheduler-file", str(told))
        self.address = self._wait(lambda: json.loads(told.read_text())["address"])

    def _start(self, name: str, *options: str, **env: str) -> subprocess.Popen:
        kind = "scheduler" if name == "scheduler" else "worker"
        common = "--host", ("tls://" if self._tls else "") + "127.0.0.1", "--no-dashboard"
        with open(self.folder / f"{name}.log", "wb") as log:
            self.processes[name] = subprocess.Popen(
                [
                    sys.executable,
                    "-m",
                    f"distributed.cli.dask_{kind}",
                    *common,
                    *self._tls,
                    *options,
                ],
                env=os.environ | QUIET | env,
                stderr=log,
                stdout=log,
            )
        return self.processes[name]

    def _wait(self, found):
        """What a file of a process says, once it does."""
        end = time.monotonic() + WAIT
        while True:
            try:
                return found()
            except (OSError, ValueError, IndexError):
                assert time.monotonic() < end, [p.read_text() for p in self.folder.glob("*.log")]
                time.sleep(0.05)

    def work(self, name: str, *options: str, **env: str) -> str:
        """Start a worker of one thread; returns its address once it is there."""
        alone = "--nthreads", "1", "--no-nanny", "--name", name, "--death-timeout", "60"
        self._start(name, self.address, *alone, *options, **env)
        log = self.folder / f"{name}.log"
        told = "Start worker at:"
        self._wait(lambda: log.read_text().split("Registered to:")[1])
        return log.read_text().split(told)[1].split()[0]

    def end(self, *names: str) -> None:
        """End processes as if by a crash: those named, or all."""
        for name in names or list(self.processes):
            process = self.processes.pop(name)
            process.kill()
            process.wait()


@contextmanager
def dask(folder: Path, *tls: str):
    running = Dask(folder, *tls)
    try:
        yield running
    finally:
        running.end()


@pytest.fixture
def shared(request, tmp_path_factory):
    """A scheduler with two workers, which every test leaves as they are."""
    stash = request.config.stash
    if SHARED not in stash:
        stash[SHARED] = running = Dask(tmp_path_factory.mktemp("dask"))
        running.work("first"), running.work("second")
    return stash[SHARED]


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(item, nextitem):
    """End what is shared with the folder's last test: idle, it takes a fifteenth of a core."""
    if nextitem is None or nextitem.path.parent != item.path.parent:
        if SHARED in item.config.stash:
            item.config.stash[SHARED].end()
            del item.config.stash[SHARED]


@pytest.fixture
def cluster(shared):
    with connected(shared.address) as found:
        yield found


@pytest.fixture(scope="session")
def scene(make) -> Scene:
    """A ball before a plane; squares in one place, and an ulp apart; a box whose edges are met."""
    back = np.eye(4)
    back[:3, 3] = -0.6, 0, -3
    ball = make.mesh(trimesh.creation.icosphere(3, radius=0.8), back)
    back[0, 3] = 1.0
    box = make.mesh(trimesh.creation.box((0.5, 0.5, 0.5)), back)
    square = make.quad(-0.5, 1, -1, -0.5, -3)
    behind = make.quad(-0.5, 0.2, -0.7, -0.5, np.nextafter(-3, 0))
    planes = [((0, 0, -5), (0, 0.3, 1))]
    return make.scene(make.camera(48, 36), ball, box, square, square, behind, planes=planes)

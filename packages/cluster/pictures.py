"""Pictures traced by workers: regions are given away, and joined as one process finds them.

Of a certified picture workers say who owns a ray: t, barycentrics and colours are found here.
"""

from __future__ import annotations

import json
from collections import deque
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from distributed import Future
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import TRACERS
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.nearest import TraceBand
from reference_tracer.tracer.progress import Progress, Work
from reference_tracer.tracer.render import Tracer, rays_in_order, rounds
from reference_tracer.tracer.settings import Settings

from . import tasks
from .cluster import Cluster
from .owners import count_in, joined

EACH = 6  # regions of a picture that each thread of a worker has, about: so none waits for long
MOST = 1 << 20  # pixels of one
AHEAD = 3  # regions that each thread is given at a time


def tracer(cluster: Cluster) -> Tracer:
    """Return what traces on a cluster, in place of a method's own."""

    def prepare(
        scene: Scene, settings: Settings, reach: float, statistics: Statistics
    ) -> Work[TraceBand]:
        # What it counts of the whole picture is said as of any other.
        yield from TRACERS[settings.method](scene, settings, reach, statistics)
        sent = sent_scene(cluster, scene)
        statistics.notes.append(f"traced by {len(cluster.workers())} Dask workers")
        return Picture(cluster, scene, settings, reach, statistics, sent).trace

    return prepare


def sent_scene(cluster: Cluster, scene: Scene) -> Future:
    """Return a scene on the workers, its camera aside; it is sent where it is new."""
    parts = scene.meshes, scene.instances, scene.planes, scene.background.tobytes()
    if not _is_same(parts, cluster.sent[0] if cluster.sent else ()):
        with TemporaryDirectory() as folder:
            path = Path(folder) / "scene.npz"
            save_scene(path, scene)
            cluster.sent = parts, cluster.keep(path.read_bytes())
    assert cluster.sent
    return cluster.sent[1]


def _is_same(parts: tuple, others: tuple) -> bool:
    return all(a is b or a == b for a, b in zip(parts, others, strict=True)) if others else False


def camera_json(scene: Scene) -> str:
    """Return a scene's camera as JSON."""
    return json.dumps(scene.camera.to_dict(), default=np.generic.item)


@dataclass(eq=False)
class Picture:
    """A picture on its way."""

    cluster: Cluster
    scene: Scene
    settings: Settings
    reach: float
    statistics: Statistics
    sent: Future  # the scene, on the workers

    def __post_init__(self) -> None:
        r = self.scene.camera.region
        self._camera = camera_json(self.scene)
        self._threads = sum(self.cluster.workers().values())
        times = sum(len(each.rays()) for each in rounds(self.settings))
        rows = r.height * times  # each takes a look at every triangle: few are best
        self._rows = max(1, min(-(-rows // (EACH * self._threads)), MOST // r.width))
        every = rays_in_order(self.scene.camera, self.settings)
        self._todo = ((part, *at) for band, at in every for part in self._parts(band))
        self._ahead: deque[Future] = deque()

    def _parts(self, band: Region) -> list[Region]:
        ends = range(band.y0, band.y1, self._rows)
        return [replace(band, y0=y, y1=min(y + self._rows, band.y1)) for y in ends]

    def _ask(self, region: Region, dx: float, dy: float) -> Future:
        chosen, at = json.dumps(vars(self.settings)), tuple(map(int, vars(region).values()))
        given = self.sent, self._camera, chosen, self.reach, at, dx, dy
        return self.cluster.ask(tasks.trace, *given)

    def trace(self, band: Region, dx: float, dy: float) -> Work[Hits]:
        """Return what a band's rays see, once all is there."""
        parts, found = self._parts(band), []
        for number in range(len(parts)):
            for unit in islice(self._todo, AHEAD * self._threads - len(self._ahead)):
                self._ahead.append(self._ask(*unit))
            seen, took = yield from self.cluster.answer(self._ahead.popleft())
            count_in(self.statistics, took)
            found.append(seen)
            yield Progress((number + 1) / len(parts))
        if self.settings.method.is_proven:
            return joined(found, self.scene, band, dx, dy)
        return Hits.joined(found)

"""Pictures traced by workers: regions are given away, and joined as one process finds them.

Of a certified picture workers say who owns a ray: t, barycentrics and colours are found here.
"""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from functools import partial
from itertools import islice

from distributed import Future
from reference_tracer.certified.measures import Measured
from reference_tracer.rendering import TRACERS
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.nearest import TraceBand
from reference_tracer.tracer.progress import Progress, Work
from reference_tracer.tracer.render import Tracer, rays_in_order, rounds
from reference_tracer.tracer.settings import Settings

from . import tasks
from .cluster import Cluster

EACH = 6  # regions of a picture that each thread of a worker has, about: so none waits for long
MOST = 1 << 20  # pixels of one
AHEAD = 3  # regions that each thread is given at a time


def tracer(cluster: Cluster) -> Tracer:
    """Return what traces on a cluster, in place of a method's own."""
    return partial(_prepared, cluster)


def sent_scene(cluster: Cluster, scene: Scene) -> Future:
    """Return a scene on the workers; it is sent where it is new."""
    if not cluster.sent or cluster.sent[0] is not scene:
        cluster.sent = scene, cluster.keep(scene)
    return cluster.sent[1]


def _prepared(
    cluster: Cluster, scene: Scene, settings: Settings, reach: float, statistics: Statistics
) -> Work[TraceBand]:
    """Return what traces the bands of a picture, of which some regions are given away ahead."""
    # What it counts of the whole picture is said as of any other.
    yield from TRACERS[settings.method](scene, settings, reach, statistics)
    statistics.notes.append(f"traced by {len(cluster.workers())} Dask workers")
    given = sent_scene(cluster, scene), settings, reach
    region = scene.camera.region
    threads = sum(cluster.workers().values())
    rows = region.height * sum(len(each.rays()) for each in rounds(settings))
    # Each part takes a look at every triangle: few are best.
    step = max(1, min(-(-rows // (EACH * threads)), MOST // region.width))

    def parts(band: Region) -> list[Region]:
        ends = range(band.y0, band.y1, step)
        return [replace(band, y0=y, y1=min(y + step, band.y1)) for y in ends]

    every = rays_in_order(scene.camera, settings)
    todo = ((part, at) for band, at in every for part in parts(band))
    ahead: deque[Future] = deque()

    def trace(band: Region, dx: float, dy: float) -> Work[Hits]:
        """Return what a band's rays see, once all is there."""
        found = []
        count = len(parts(band))
        for number in range(count):
            for part, at in islice(todo, AHEAD * threads - len(ahead)):
                ahead.append(cluster.ask(tasks.trace, *given, part, *at))
            seen, took = yield from cluster.answer(ahead.popleft())
            if isinstance(seen.measures, Measured):
                seen.measures = replace(seen.measures, scene=scene)
            statistics.pairs_tested += took.pairs_tested
            statistics.reasons += took.reasons
            found.append(seen)
            yield Progress((number + 1) / count)
        return Hits.joined(found)

    return trace

"""Pictures traced by workers: regions are given away, and joined as one process finds them.

The workers say who owns a ray, and nothing else is taken from them: colours are made here.
"""

from __future__ import annotations

import json
from collections import deque
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from random import SystemRandom
from tempfile import TemporaryDirectory
from typing import Any, NoReturn

import numpy as np
from reference_tracer.certified.measures import Known, Measured
from reference_tracer.errors import words
from reference_tracer.files.scenes import save_scene
from reference_tracer.rendering import TRACERS
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.nearest import TraceBand
from reference_tracer.tracer.progress import Work, scaled
from reference_tracer.tracer.render import Tracer, rays_in_order, rounds
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.ties import Ties

from . import tasks
from .claims import Claim
from .cluster import Asked, Cluster, ClusterError, NobodyError
from .plain import plain_hits

EACH = 6  # regions of a picture that each thread of a worker has, about: so none waits for long
MOST = 1 << 20  # pixels of one
AHEAD = 3  # regions that each thread is given at a time
PLACES = 100  # where a picture is traced again, at least


def tracer(cluster: Cluster, share: float | None) -> Tracer:
    """Return what traces on a cluster, a share of the rays twice, in place of a method's own."""

    def prepare(
        scene: Scene, settings: Settings, reach: float, statistics: Statistics
    ) -> Work[TraceBand]:
        own = yield from TRACERS[settings.method](scene, settings, reach, statistics)
        name = scene_name(cluster, scene)
        checked = f": {share:.3g} of the rays are traced twice" if share else ""
        statistics.notes.append(f"traced by {len(cluster.workers())} Dask workers{checked}")
        return Picture(cluster, share, scene, settings, reach, statistics, own, name).trace

    return prepare


def scene_name(cluster: Cluster, scene: Scene) -> str:
    """Return a scene's name on the workers, its camera aside; it is sent where it is new."""
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
    share: float | None  # of the rays that are traced twice; None: nothing is checked
    scene: Scene
    settings: Settings
    reach: float
    statistics: Statistics
    own: TraceBand  # traces here
    name: str  # of the scene, on the workers

    def __post_init__(self) -> None:
        r = self.scene.camera.region
        self._camera = camera_json(self.scene)
        self._threads = sum(self.cluster.workers().values())
        times = sum(len(each.rays()) for each in rounds(self.settings))
        rows = r.height * times  # each takes a look at every triangle: few are best
        self._rows = max(1, min(-(-rows // (EACH * self._threads)), MOST // r.width))
        every = rays_in_order(self.scene.camera, self.settings)
        self._todo = ((part, *at) for band, at in every for part in self._parts(band))
        self._ahead: deque[Asked] = deque()

    def _parts(self, band: Region) -> list[Region]:
        ends = range(band.y0, band.y1, self._rows)
        return [replace(band, y0=y, y1=min(y + self._rows, band.y1)) for y in ends]

    def _ask(self, region: Region, dx: float, dy: float, **options: Any) -> Asked:
        chosen, at = json.dumps(vars(self.settings)), tuple(map(int, vars(region).values()))
        given = self.name, self._camera, chosen, self.reach, at, dx, dy
        return self.cluster.ask(tasks.trace, tasks.about(), *given, **options)

    def trace(self, band: Region, dx: float, dy: float) -> Work[Hits]:
        """Return what a band's rays see, once all is there and is found to be right."""
        parts, claims, again, plain = self._parts(band), [], [], []
        for number, part in enumerate(parts):
            for unit in islice(self._todo, AHEAD * self._threads - len(self._ahead)):
                self._ahead.append(self._ask(*unit))
            work = self._claim(self._ahead.popleft(), part)
            claim, worker = yield from scaled(work, number / len(parts), 1 / len(parts))
            claim.count_in(self.statistics)
            claims.append(claim)
            if not self.settings.method.is_proven:
                given = self.scene, part, dx, dy, claim.names, self.settings
                plain.append((yield from plain_hits(*given)))
                if not np.array_equal(claim.names, (plain[-1].instance, plain[-1].triangle)):
                    self._blame([worker], part)
            for place in self._places(part) if self.share else ():
                asked = self._ask(place, dx, dy, without=frozenset([worker]))
                again.append((place, part, claim, worker, asked))
            yield (number + 1) / len(parts)
        for number, each in enumerate(again, start=1):
            yield from scaled(self._traced_again(*each, dx, dy), number / len(again), 0.0)
        return Hits.joined(plain) if plain else self._joined(claims, band, dx, dy)

    def _claim(self, asked: Asked, region: Region) -> Work[tuple[Claim, str]]:
        data, worker = yield from self.cluster.answer(asked)
        certified = self.settings.method.is_proven
        try:
            return Claim.read(data, self.scene, region.width * region.height, certified), worker
        except Exception as error:  # whatever it is made to be
            said = f"worker {worker} has answered what is no picture: {words(error)}"
            raise ClusterError(said) from None

    def _places(self, part: Region) -> list[Region]:
        """Return where a part is traced again: places of one size, at random."""
        r, samples = self.scene.camera.region, self.settings.samples
        rays = r.width * r.height * (1 + (samples**2 if samples > 1 else 0))
        assert self.share
        size = max(1, int(self.share * rays / PLACES))
        width, height = min(part.width, size), max(1, min(part.height, size // r.width))
        every = [
            Region(x, y, min(x + width, part.x1), min(y + height, part.y1))
            for y in range(part.y0, part.y1, height)
            for x in range(part.x0, part.x1, width)
        ]
        share, rng = min(1.0, max(self.share, PLACES / rays)), SystemRandom()
        return rng.sample(every, int(share * len(every) + rng.random()))  # on average so many

    def _traced_again(
        self,
        place: Region,
        part: Region,
        claim: Claim,
        worker: str,
        asked: Asked,
        *at: float,
    ) -> Work[None]:
        """Raise a ClusterError that names the worker whose claim is not what is traced here."""
        rows, columns = (np.arange(*ends) for ends in ((place.y0, place.y1), (place.x0, place.x1)))
        pixel = ((rows - part.y0)[:, None] * part.width + columns - part.x0).ravel()
        said = {worker: claim.about(pixel)}
        with suppress(NobodyError):
            other, another = yield from self._claim(asked, place)
            said[another] = other.about(np.arange(len(pixel)))
            if said[another] == said[worker]:
                return
        truth = Claim.of((yield from self.own(place, *at)), Statistics()).about(
            np.arange(len(pixel))
        )
        if wrong := [who for who, what in said.items() if what != truth]:
            self._blame(wrong, place)

    def _blame(self, workers: list[str], region: Region) -> NoReturn:
        where = f"pixels ({region.x0}, {region.y0}) to ({region.x1 - 1}, {region.y1 - 1})"
        names = " and ".join(f"worker {worker}" for worker in workers)
        raise ClusterError(f"{names} gave a wrong answer, about {where}: look at that machine")

    def _joined(self, claims: list[Claim], band: Region, dx: float, dy: float) -> Hits:
        """Return what certified claims say of a band, row by row: what the sweep finds of it."""
        starts = np.cumsum([0, *(len(claim.certainty) for claim in claims)]).tolist()
        instance, triangle = np.concatenate([claim.names for claim in claims], axis=1)
        each = list(zip(claims, starts, strict=False))
        known = Known.joined([replace(c.known, ray=c.known.ray + s) for c, s in each])
        return Hits(
            instance,
            triangle,
            np.concatenate([claim.certainty for claim in claims]),
            Measured(self.scene, band, known, dx, dy),
            Ties.joined([claim.ties.numbered(start) for claim, start in each]),
        )

"""The field that ours runs in: which peers are there, and a runner for each that a case asks for.

A peer that is missing or fails is named once, with what to do about it, and left out from then on.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Camera, Mesh, Scene
from reference_tracer.tracer.frame import Frame

from .blender_peer import ENGINES, BlenderPeer
from .peers import Embreex, MissingPeerError, Rtree, Timed, fitting
from .plan import BLENDER, Case
from .rays import Rays, rays_of
from .results import Bench
from .rounds import Runner
from .scenes import SUBJECTS, SUZANNE_FILE, mesh_of

WHOLE = 2.0  # seconds at least that embreex may take for a picture before it gets a sample


class Field:
    """All peers of a run; :meth:`close` ends the one that is a process."""

    def __init__(self, slow: float, bench: Bench, cache: Path) -> None:
        """Start nothing yet; `slow` is the seconds for a peer that traces a sample of rays."""
        self._slow = slow
        self._bench = bench
        self._cache = cache
        self._gone: set[str] = set()  # the peers that are missing or have failed
        self._mesh: Mesh | None = None
        self._embreex: Embreex | None = None
        self._is_new = False  # its tree is still to be timed
        self._rays: Rays | None = None  # that embreex traces
        self._hits: NDArray | None = None  # triangles that it saw, (n,)
        self._blender: BlenderPeer | None = None
        try:
            self._blender = BlenderPeer(cache)
        except MissingPeerError as error:
            self._lose(BLENDER, str(error))

    def close(self) -> None:
        """End what runs."""
        if self._blender:
            self._blender.close()

    def mesh(self, name: str) -> Mesh:
        """Return a scene's mesh, made by Blender where it has to be; the peers see it from now on.

        Raises
        ------
        MissingMeshError
            If there is none.
        """
        path = self._cache / SUZANNE_FILE
        if SUBJECTS[name].mesh is None and self._blender and not path.is_file():
            try:
                self._blender.make_suzanne(path)
            except MissingPeerError as error:
                self._bench.note(str(error))
        self._mesh = mesh_of(name, self._cache)
        self._embreex = None
        self._is_new = True
        if SUBJECTS[name].copies == 1:
            self._try({"embreex"}, self._prepare_embreex)
        else:
            self._bench.note(f"{name}: embreex has no instances: copied, they are gigabytes")
        return self._mesh

    def runners(self, scene: Scene, case: Case) -> dict[str, Runner]:
        """Return who is timed beside us in a case, by name."""
        out: dict[str, Runner] = {}
        slow = self._slow
        if self._embreex:
            out |= self._of_embreex(scene.camera)
        if "rtree" in case.peers:
            self._try({"rtree"}, lambda: out.update(rtree=self._rtree(scene)))
        wanted = case.peers & BLENDER - self._gone
        if wanted and self._try(BLENDER, lambda: self._blender.open(scene)):
            if "bvhtree" in wanted:
                out["bvhtree"] = _of_sample(
                    lambda: self._blender.bvhtree(self._slow), 2 * self._slow
                )
            for engine in ENGINES:
                if engine in wanted:
                    out[engine] = Runner(partial(self._blender.render, engine), 2 * slow)
        return out

    def compare(self, peers: Mapping[str, Runner], certified: Frame) -> None:
        """Leave out who has failed; say in how many pixels embreex names another triangle."""
        self._gone |= {name for name, runner in peers.items() if runner.failed}
        if self._hits is not None and "embreex_trace" in peers:
            ours = certified.triangle_index[self._rays.rows].ravel()
            peers["embreex_trace"].facts["differs"] = float(np.mean(self._hits != ours))

    def _prepare_embreex(self) -> None:
        self._embreex = Embreex(self._mesh)

    def _of_embreex(self, camera: Camera) -> dict[str, Runner]:
        self._hits = None
        allowed = max(WHOLE, 2 * self._slow)
        self._rays = rays = fitting(lambda few: self._embreex.trace(few)[0], camera, allowed)

        def traced() -> float:
            seconds, found = self._embreex.trace(rays)
            self._hits = found["primID"]
            return seconds * rays.of / rays.count

        def ids() -> float:
            return self._embreex.ids(rays) * rays.of / rays.count

        facts: dict[str, str | float] = {"rays": rays.count}
        out = {"embreex_trace": Runner(traced, facts=facts), "embreex_ids": Runner(ids)}
        if self._is_new:
            out["embreex_build"] = Runner(self._embreex.build, allowed)
        self._is_new = False
        return out

    def _rtree(self, scene: Scene) -> Runner:
        tracer, rays = Rtree(self._mesh), rays_of(scene.camera)
        return _of_sample(lambda: tracer.trace(rays, self._slow), self._slow)

    def _try(self, peers: Collection[str], work: Callable[[], object]) -> bool:
        """Do something with peers; says whether they are there."""
        if self._gone.issuperset(peers):
            return False
        try:
            work()
        except MissingPeerError as error:
            self._lose(peers, str(error))
            return False
        return True

    def _lose(self, peers: Collection[str], why: str) -> None:
        self._gone |= set(peers)
        self._bench.note(f"{', '.join(sorted(peers))}: {why}")


def _of_sample(trace: Callable[[], Timed], allowed: float) -> Runner:
    """Return a runner for a sample of rays, as many as fit the time of a slow peer."""

    def run() -> float:
        timed = trace()
        runner.facts["rays"] = timed.rays
        return timed.seconds

    runner = Runner(run, allowed)
    return runner

"""The field that ours runs in: which peers are there, and a runner for each that a case asks for.

A peer that is missing or fails is named once, with what to do about it, and left out from then on.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
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
from .rounds import Facts, Runner, Runners
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
        self._embreex: Embreex | None = None  # with this mesh, once it was asked for
        self._rays: Rays | None = None  # that embreex traces
        self._hits: NDArray | None = None  # triangles that it saw, (n,)
        self._blender = BlenderPeer()

    def close(self) -> None:
        """End what runs."""
        self._blender.close()

    def mesh(self, name: str) -> Mesh:
        """Return a scene's mesh, made by Blender where it has to be; the peers see it from now on.

        Raises
        ------
        MissingMeshError
            If there is none.
        """
        if self._mesh is None or self._mesh.name != name:
            path = self._cache / SUZANNE_FILE
            if SUBJECTS[name].mesh is None and not path.is_file():
                self._of(BLENDER, lambda: self._blender.make_suzanne(path))
            self._mesh = mesh_of(name, self._cache)
            self._embreex = None
        return self._mesh

    def runners(self, scene: Scene, case: Case) -> Runners:
        """Return who is timed beside us in a case, by name."""
        out: Runners = {}
        self._hits = None
        if SUBJECTS[case.scene].copies > 1:
            self._bench.note(f"{case.scene}: embreex has no instances: copied, they are gigabytes")
        else:
            out |= self._of({"embreex"}, lambda: self._of_embreex(scene.camera))
        if "rtree" in case.peers:
            out |= self._of({"rtree"}, lambda: self._of_rtree(scene))
        if wanted := case.peers & BLENDER - self._gone:
            out |= self._of(BLENDER, lambda: self._of_blender(scene, wanted))
        return out

    def compare(self, peers: Runners, certified: Frame) -> None:
        """Leave out who has failed; say in how many pixels embreex names another triangle."""
        self._gone |= {name for name, runner in peers.items() if runner.failed}
        if self._hits is not None:
            ours = certified.triangle_index[self._rays.rows].ravel()
            peers["embreex_trace"].facts["differs"] = np.mean(self._hits != ours)

    def _of_embreex(self, camera: Camera) -> Runners:
        is_new = self._embreex is None
        embreex = self._embreex = self._embreex or Embreex(self._mesh)
        allowed = max(WHOLE, 2 * self._slow)
        self._rays = rays = fitting(lambda few: embreex.trace(few)[0], camera, allowed)

        def traced() -> float:
            seconds, found = embreex.trace(rays)
            self._hits = found["primID"]
            return seconds * rays.of / rays.count

        def ids() -> float:
            return embreex.trace(rays, whole=False)[0] * rays.of / rays.count

        facts: Facts = {"rays": rays.count}
        out = {"embreex_trace": Runner(traced, facts=facts), "embreex_ids": Runner(ids)}
        if is_new:
            out["embreex_build"] = Runner(embreex.build, allowed)
        return out

    def _of_rtree(self, scene: Scene) -> Runners:
        tracer, rays = Rtree(self._mesh), rays_of(scene.camera)
        return {"rtree": _of_sample(lambda: tracer.trace(rays, self._slow), self._slow)}

    def _of_blender(self, scene: Scene, wanted: Collection[str]) -> Runners:
        self._blender.open(scene)
        slow = 2 * self._slow
        every = {"bvhtree": _of_sample(lambda: self._blender.bvhtree(self._slow), slow)}
        every |= {name: Runner(partial(self._blender.render, name), slow) for name in ENGINES}
        return {name: runner for name, runner in every.items() if name in wanted}

    def _of(self, peers: Collection[str], work: Callable[[], Runners | None]) -> Runners:
        """Return the runners of peers, if they are there; else say, once, why they are not."""
        if self._gone.issuperset(peers):
            return {}
        try:
            return work() or {}
        except MissingPeerError as error:
            self._gone |= set(peers)
            self._bench.note(f"{', '.join(sorted(peers))}: {error}")
            return {}


def _of_sample(trace: Callable[[], Timed], allowed: float) -> Runner:
    """Return a runner for a sample of rays, as many as fit the time of a slow peer."""

    def run() -> float:
        timed = trace()
        runner.facts["rays"] = timed.rays
        return timed.seconds

    runner = Runner(run, allowed)
    return runner

"""The field that ours runs in: which peers are there, and a runner for each that a case asks for.

A peer that is missing or fails is named once, with what to do about it, and left out from then on.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from reference_tracer.scene import Mesh, Scene
from reference_tracer.tracer.frame import Frame

from .blender_peer import ENGINES, BlenderPeer
from .peers import Embreex, MissingPeerError, Rtree, fitting
from .plan import BLENDER, Case, Plan
from .rays import Rays, rays_of
from .rounds import Runner
from .rows import Bench, Row
from .scenes import SUBJECTS, SUZANNE_FILE, mesh_of

WHOLE = 2.0  # seconds at least that embreex may take for a picture before it gets a sample


class Field:
    """All peers of a run; :meth:`close` ends the one that is a process."""

    def __init__(self, plan: Plan, bench: Bench, cache: Path) -> None:
        """Start nothing yet."""
        self._plan, self._bench, self._cache = plan, bench, cache
        self._gone: set[str] = set()  # the peers that are missing or have failed
        self._mesh: Mesh | None = None
        self._embreex: Embreex | None = None
        self._built: float | None = None  # seconds of its build, the median of its rounds
        self._found: dict[str, float | int] = {}  # what belongs into the rows of the case
        self._rays: Rays | None = None
        self._hits: np.ndarray | None = None  # triangles that embreex saw, (n,)
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
        self._mesh, self._built, self._embreex = mesh_of(name, self._cache), None, None
        if SUBJECTS[name].copies == 1:
            self._try("embreex", self._prepare_embreex)
        else:
            self._bench.note(f"{name}: embreex has no instances: copied, they are gigabytes")
        return self._mesh

    def runners(self, scene: Scene, case: Case) -> dict[str, Runner]:
        """Return who is timed beside us in a case, by the name of its seconds in a row."""
        self._found, self._hits, slow, out = {}, None, self._plan.slow, {}
        if self._embreex:
            allowed = max(WHOLE, 2 * slow)
            timed = partial(self._trace_embreex, keep=False)
            self._rays = fitting(timed, scene.camera, allowed)
            self._found["embreex_rays"] = self._rays.count
            out["embreex_trace"] = Runner(self._whole_embreex)
            out["embreex_ids"] = Runner(self._whole_ids)
            if self._built is None:
                out["embreex_build"] = Runner(self._embreex.build, allowed)
        if "rtree" in case.peers - self._gone:
            self._try("rtree", lambda: out.update(rtree=self._rtree(scene)))
        wanted = case.peers & BLENDER - self._gone
        if wanted and self._try("blender", lambda: self._blender.open(scene)):
            if "bvhtree" in wanted:
                out["bvhtree"] = Runner(self._bvhtree, 2 * slow)
            for engine in ENGINES:
                if engine in wanted:
                    out[engine] = Runner(partial(self._blender.render, engine), 2 * slow)
        return out

    def tell(self, peers: dict[str, Runner], case: Case) -> None:
        """Note who has failed, and keep what the scene's other cases need."""
        for name, runner in peers.items():
            if runner.failed:
                self._lose({name}, runner.failed)
        if "embreex_build" in peers:
            self._built = peers["embreex_build"].median

    def completed(self, row: Row, certified: Frame | None) -> Row:
        """Fill in what only the peers know."""
        row.embreex_build_s = self._built
        for name, value in self._found.items():
            setattr(row, name, value)
        if self._hits is not None and certified is not None:
            ours = certified.triangle_index[self._rays.rows].ravel()
            row.embreex_differs = float(np.mean(self._hits != ours))
        return row

    def _prepare_embreex(self) -> None:
        self._embreex = Embreex(self._mesh)

    def _trace_embreex(self, rays: Rays, keep: bool) -> float:
        seconds, found = self._embreex.trace(rays)
        if keep:
            self._hits = found["primID"]
        return seconds

    def _whole_embreex(self) -> float:
        rays = self._rays
        return self._trace_embreex(rays, keep=self._hits is None) * rays.of / rays.count

    def _whole_ids(self) -> float:
        return self._embreex.ids(self._rays) * self._rays.of / self._rays.count

    def _rtree(self, scene: Scene) -> Runner:
        """Return a runner for a sample of rays, as many as fit the time of a slow peer."""
        tracer, rays = Rtree(self._mesh), rays_of(scene.camera)

        def run() -> float:
            timed = tracer.trace(rays, self._plan.slow)
            self._found["rtree_rays"] = timed.rays
            return timed.seconds

        return Runner(run, allowed=self._plan.slow)

    def _bvhtree(self) -> float:
        timed, build = self._blender.bvhtree(self._plan.slow)
        self._found |= {"bvhtree_rays": timed.rays, "bvhtree_build_s": build}
        return timed.seconds

    def _try(self, peer: str, work: Callable[[], object]) -> bool:
        """Do something with a peer; says whether it is there."""
        if peer in self._gone:
            return False
        try:
            work()
        except MissingPeerError as error:
            self._lose(BLENDER if peer == "blender" else {peer}, str(error))
            return False
        return True

    def _lose(self, peers: set[str] | frozenset[str], why: str) -> None:
        self._gone |= peers
        self._bench.note(f"{', '.join(sorted(peers))}: {why}")

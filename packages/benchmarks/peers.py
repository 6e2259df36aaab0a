"""Times ray tracers from Python libraries: embreex (Intel's Embree), and trimesh's own with rtree.

Each traces a camera's rays through a mesh, and says what was hit. A peer that would take too long
for a whole picture traces a sample of its rows: `Timed` says how many rays it was.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from reference_tracer.scene import Camera, Mesh

from .rays import Rays, rays_of

FIRST = 64  # of so many rows one is traced first, to see how long a picture would take
DENSE_FIRST = 8_000  # and not fewer rays than this: no clock sees what is too short
BATCH = 64  # rays that rtree gets at once: it may take a second for each


class MissingPeerError(RuntimeError):
    """A peer is not installed, or cannot run here; the message says what to do about it."""


@dataclass(frozen=True)
class Timed:
    """How long a whole picture takes, and how many of its rays were really traced."""

    seconds: float
    rays: int


def missing(library: str) -> MissingPeerError:
    """Return the error for a library that cannot be imported."""
    extra = "blender" if library == "bpy" else "bench"
    return MissingPeerError(
        f'without {library}, which is not installed: pip install "reference_tracer[{extra}]"'
    )


class Embreex:
    """Embree, one ray a call, in float32. Returns what ours does: ids, t, barycentrics.

    It always returns the normal, too; the loop over the rays is embreex's own, in C.
    """

    def __init__(self, mesh: Mesh) -> None:
        """Take a mesh; :meth:`build` makes the scene.

        Raises
        ------
        MissingPeerError
            If embreex is not installed.
        """
        try:
            from embreex import mesh_construction, rtcore_scene
        except ImportError:
            raise missing("embreex") from None
        self._new: Callable[[], Any] = rtcore_scene.EmbreeScene
        self._add: Callable[..., Any] = mesh_construction.TriangleMesh
        self._mesh = mesh
        self._scene: Any = None

    def build(self) -> float:
        """Build the scene, its tree included; returns seconds."""
        vertices, triangles = self._mesh.vertices, self._mesh.triangles
        nothing = np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32)
        began = time.process_time()
        self._scene = self._new()
        self._add(self._scene, vertices, triangles)
        self._scene.run(*nothing)  # the first query commits the scene, which builds its tree
        return time.process_time() - began

    def trace(self, rays: Rays, whole: bool = True) -> tuple[float, Any]:
        """Trace rays; returns seconds, and `primID` (-1 for nothing), `tfar`, `u`, `v`, (n,).

        If it is not asked for the whole of that, triangles alone.
        """
        if self._scene is None:
            self.build()
        began = time.process_time()
        found = self._scene.run(rays.origins, rays.directions, dists=rays.length, output=whole)
        return time.process_time() - began, found


class Rtree:
    """trimesh's own ray query: boxes from an R-tree, triangles tested in numpy."""

    def __init__(self, mesh: Mesh) -> None:
        """Build its tree, which is not timed.

        Raises
        ------
        MissingPeerError
            If rtree is not installed.
        """
        import trimesh
        from trimesh.ray.ray_triangle import RayMeshIntersector

        whole = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
        try:
            _ = whole.triangles_tree  # made when first asked for
        except ImportError:
            raise missing("rtree") from None
        self._tracer = RayMeshIntersector(whole)

    def trace(self, rays: Rays, budget: float) -> Timed:
        """Trace rays here and there in the picture until `budget` seconds are over, or all."""
        order = np.random.default_rng(0).permutation(rays.count)
        seconds, done = 0.0, 0
        while done < rays.count and seconds < budget:
            some = order[done : done + BATCH]
            origins, directions = rays.origins[some], rays.directions[some]
            began = time.process_time()
            self._tracer.intersects_id(origins, directions, multiple_hits=False)
            seconds += time.process_time() - began
            done += len(some)
        return Timed(seconds * rays.of / done, done)


def fitting(trace: Callable[[Rays], float], camera: Camera, budget: float) -> Rays:
    """Return the rays of a picture, or of so many of its rows as take about `budget` seconds.

    Parameters
    ----------
    trace : callable
        Traces rays; returns the seconds that it took.
    camera : Camera
    budget : float
        Seconds.
    """
    few = rays_of(camera, max(1, min(FIRST, camera.width * camera.height // DENSE_FIRST)))
    whole = trace(few) * few.of / few.count
    return rays_of(camera, max(1, min(camera.height, int(np.ceil(whole / budget)))))

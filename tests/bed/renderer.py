"""A small renderer of flat colours that shares nothing with the tracer: embreex, and K, R, t.

The conventions are those of computer vision, not Blender's: camera space has x to the right, y
*down* and z forward, x_camera = R x_world + t; film positions (u, v) are in pixels from the upper
left corner of the picture, so that pixel (column, row) has its centre at (column + 0.5, row + 0.5)
and row 0 is the *top* row. A pinhole sees x_camera at K x_camera, divided by its last component; a
parallel camera at K (x, y, 1).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene


@dataclass(frozen=True, eq=False)
class Camera:
    """Where a point appears in the picture: K [R | t]."""

    k: np.ndarray  # (3, 3): pixels from camera space; last row (0, 0, 1)
    r: np.ndarray  # (3, 3): camera space from world; axes may be scaled, sheared or mirrored
    t: np.ndarray  # (3,)
    width: int
    height: int
    parallel: bool = False
    near: float = 0.0  # depths z in camera space, metres
    far: float = np.inf

    @property
    def center(self) -> np.ndarray:
        """Where the camera is, (3,) in world space."""
        return -np.linalg.solve(self.r, self.t)

    def rays(self, u: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return origins relative to the centre, and directions one unit deep, (n, 3) each."""
        film = np.stack((u, v, np.ones(len(u)))) if len(u) else np.ones((3, 0))
        x = np.linalg.solve(self.k, film)
        if not self.parallel:
            directions = np.linalg.solve(self.r, x).T
            return self.near * directions, directions
        forward = np.broadcast_to(np.linalg.solve(self.r, [0.0, 0.0, 1.0]), (len(u), 3))
        beside = np.linalg.solve(self.r, np.stack((x[0], x[1], np.zeros(len(u))))).T
        return beside + self.near * forward, forward

    def depths(self, points: np.ndarray) -> np.ndarray:
        """Return how deep world points (n, 3) lie, (n,)."""
        return (points @ self.r.T + self.t)[:, 2]


@dataclass(frozen=True, eq=False)
class Solid:
    """Triangles in world space."""

    name: str
    vertices: np.ndarray  # (v, 3) float64, metres
    triangles: np.ndarray  # (n, 3) indices
    color: tuple[float, float, float, float]  # linear RGBA
    paint: np.ndarray | None = None  # of each triangle, (n, 4), where it has several

    @property
    def colors(self) -> np.ndarray:
        """The colour of each triangle, (n, 4)."""
        return np.tile(self.color, (len(self.triangles), 1)) if self.paint is None else self.paint


def render(
    camera: Camera, solids: Sequence[Solid], background: Sequence[float], samples: int = 1
) -> np.ndarray:
    """Return the picture, (height, width, 4) float32, row 0 at the top: the mean of n x n samples.

    Each pixel shows the colour of the nearest surface between `near` and `far`.
    """
    seen = Tracer(camera, solids)
    every = [*(s.colors for s in solids), np.array([background])]
    colors = np.concatenate(every).astype(np.float32)
    places = (np.arange(samples) + 0.5) / samples
    total = np.zeros((camera.height, camera.width, 4))
    for dy in places:
        for dx in places:
            total += colors[seen.triangles(dx, dy)]
    return (total / samples**2).astype(np.float32)


class Tracer:
    """Solids before a camera, in a tree of Embree's. The camera's centre is its origin."""

    def __init__(self, camera: Camera, solids: Sequence[Solid]) -> None:
        self._camera = camera
        # What is subtracted in float64 first loses nothing far from the world's origin.
        corners = [(s.vertices - camera.center)[s.triangles].reshape(-1, 3) for s in solids]
        self._corners = np.concatenate([*corners, np.zeros((0, 3))])
        of_each = [np.full(len(s.triangles), n) for n, s in enumerate(solids)]
        self._owner = np.append(np.concatenate([*of_each, np.zeros(0, int)]), -1).astype(int)
        self._scene = None
        if len(self._owner) > 1:
            vertices = self._corners.astype(np.float32)
            self._scene = EmbreeScene()
            TriangleMesh(
                self._scene, vertices, np.arange(len(vertices), dtype=np.int32).reshape(-1, 3)
            )

    def owners(self, dx: float = 0.5, dy: float = 0.5) -> np.ndarray:
        """Return which solid each pixel sees at (dx, dy) from its upper left corner; -1: none."""
        return self._owner[self.triangles(dx, dy)]

    def depths(self) -> np.ndarray:
        """Return how deep along the view axis each pixel's centre sees a surface; inf: none."""
        c, triangle = self._camera, self.triangles()
        seen = triangle >= 0
        v, u = np.nonzero(seen)
        origins, directions = c.rays(u + 0.5, v + 0.5)
        first, second, third = self._corners.reshape(-1, 3, 3)[triangle[seen]].transpose(1, 0, 2)
        normal = np.cross(second - first, third - first)
        t = ((first - origins) * normal).sum(axis=1) / (directions * normal).sum(axis=1)
        out = np.full(seen.shape, np.inf)
        out[seen] = c.near + t
        return out

    def triangles(self, dx: float = 0.5, dy: float = 0.5) -> np.ndarray:
        """Return which triangle of them all each pixel sees there; -1: none."""
        c = self._camera
        v, u = (n.ravel() for n in np.mgrid[: c.height, : c.width])
        triangle = np.full(len(u), -1)
        if self._scene is not None:
            origins, directions = (a.astype(np.float32) for a in c.rays(u + dx, v + dy))
            reach = np.full(len(u), min(c.far - c.near, 1e30), np.float32)
            triangle = self._scene.run(origins, directions.copy(), reach)
        return triangle.reshape(c.height, c.width)

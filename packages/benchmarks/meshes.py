"""The meshes of the benchmark, each a small function of numbers: seeded, and the same everywhere.

Out come vertices, (v, 3) float32 in metres, and triangles, (n, 3) int32. Float32 is what Blender
and Embree store, so that all who are measured see the very same triangles.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

Triangles = tuple[NDArray[np.float32], NDArray[np.int32]]
SEED = 20
SUZANNE = 566_784  # triangles: what `blender_child.py` makes of Blender's monkey


class MissingMeshError(RuntimeError):
    """A mesh that Blender has to make is not there; the message says what to do."""


def cube() -> Triangles:
    """Return the cube from -1 to 1, 12 triangles."""
    box = trimesh.creation.box((2, 2, 2))
    return _arrays(box.vertices, box.faces)


def icosphere(level: int) -> Triangles:
    """Return a unit sphere of 20 * 4 ** `level` triangles that share their vertices."""
    sphere = trimesh.creation.icosphere(level)
    return _arrays(sphere.vertices, sphere.faces)


def nested_spheres(count: int, level: int) -> Triangles:
    """Return icospheres within one another, radii 0.2 to 1, the smallest first."""
    vertices, triangles = icosphere(level)
    radii = np.linspace(0.2, 1.0, count, dtype=np.float32)
    starts = len(vertices) * np.arange(count)
    return _arrays(radii[:, None, None] * vertices, starts[:, None, None] + triangles)


def heightfield(cells: int) -> Triangles:
    """Return hills over the square from -1 to 1, `cells` x `cells` squares of 2 triangles."""
    at = np.linspace(-1, 1, cells + 1)
    x, y = np.meshgrid(at, at)
    z = sum(
        0.06 / k * np.sin(k * (5.1 * x + 1.3 * k)) * np.cos(k * (4.3 * y - 0.7 * k))
        for k in (1, 2, 4, 8)
    )
    corner = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    around = corner, corner + 1, corner + cells + 2, corner + cells + 1
    return _arrays(np.stack((x, y, z), axis=-1), _halves(*around))


def soup(count: int, size: float) -> Triangles:
    """Return triangles that share nothing: corners spread by `size` around points of the cube."""
    rng = np.random.default_rng(SEED)
    middles = rng.uniform(-1, 1, (count, 1, 3))
    return _loose(middles + rng.normal(0, size, (count, 3, 3)))


def foliage(count: int, size: float) -> Triangles:
    """Return square leaves of this side, of 2 triangles each: anywhere in the unit ball."""
    rng = np.random.default_rng(SEED)
    middle, across, other = rng.normal(size=(3, count, 3))
    middle = _unit(middle) * rng.uniform(0, 1, (count, 1)) ** (1 / 3)
    across = _unit(across) * (size / 2)
    along = _unit(np.cross(across, other)) * (size / 2)
    corners = [middle + i * across + j * along for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    around = 4 * np.arange(count) + np.arange(4)[:, None]
    return _arrays(np.stack(corners, axis=1), _halves(*around))


def large_triangles(count: int) -> Triangles:
    """Return triangles between any three points of the cube from -1 to 1."""
    return _loose(np.random.default_rng(SEED).uniform(-1, 1, (count, 3, 3)))


def slivers(count: int) -> Triangles:
    """Return needles through the whole cube, a thousandth as wide as it.

    Their boxes are all the scene: what sorts triangles by boxes has nothing to hold on to.
    """
    rng = np.random.default_rng(SEED)
    ends = rng.uniform(-1, 1, (count, 2, 3))
    third = ends[:, :1] + rng.normal(0, 1e-3, (count, 1, 3))
    return _loose(np.concatenate((ends, third), axis=1))


def stored(path: Path) -> Triangles:
    """Return a mesh that `packages/benchmarks/blender_child.py` has saved.

    Raises
    ------
    MissingMeshError
        If there is no such file.
    """
    if not path.is_file():
        raise MissingMeshError(
            f"there is no '{path}': Blender makes it: pip install \"reference_tracer[blender]\""
        )
    with np.load(path, allow_pickle=False) as data:
        return _arrays(data["vertices"], data["triangles"])


def _loose(corners: NDArray[np.float64]) -> Triangles:
    return _arrays(corners, np.arange(3 * len(corners)))


def _halves(a: NDArray, b: NDArray, c: NDArray, d: NDArray) -> NDArray:
    """Return the triangles of squares, by their corners (n,), in pairs."""
    return np.stack(((a, b, c), (a, c, d))).transpose(2, 0, 1)


def _arrays(vertices: NDArray, triangles: NDArray) -> Triangles:
    return (
        vertices.astype(np.float32).reshape(-1, 3),
        triangles.astype(np.int32).reshape(-1, 3),
    )


def _unit(v: NDArray[np.float64]) -> NDArray[np.float64]:
    return v / np.linalg.norm(v, axis=-1, keepdims=True)

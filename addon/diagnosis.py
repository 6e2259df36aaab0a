"""What is wrong with a mesh: whether it is closed, how it is wound, what is degenerate or double.

The answers are trimesh's, by sorting integers: in a third of its time, and that of its import.
"""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .manifest import Manifest
from .scene import Mesh, Scene
from .tracer.vector import cross, dot, gather

_THIN = 1e-8  # metres: a triangle not so high, over its first or its last side, is degenerate


def diagnose(mesh: Mesh) -> dict[str, Any]:
    """Return what is wrong with a mesh, for JSON.

    Vertices at equal positions count as one point. A mesh is closed if every edge has two
    triangles; its winding agrees if they run along it in opposite directions.
    """
    point, points = _points(mesh.vertices)
    faces = point[mesh.triangles.T].astype(np.int64)
    start, end = faces, np.roll(faces, -1, axis=0)
    edge = (np.minimum(start, end) * points + np.maximum(start, end)).ravel()
    # Sorted by its edge; the last bit says in which direction a side runs along it.
    side = np.sort(2 * edge + (start > end).ravel())
    first = np.flatnonzero(np.diff(side >> 1, prepend=-1))
    sides = np.diff(first, append=len(side))
    first = first[sides == 2]
    is_loop = (side[first] >> 1) % (points + 1) == 0  # from a point to itself, either way
    low, middle, high = np.sort(faces, axis=0)
    # By their real parts, then the imaginary ones: exact below 2^53, of 94 million points.
    corners = np.sort((low * points + middle) + 1j * high)
    return {
        "closed": bool(side.size and (sides == 2).all()),
        "consistent_winding": bool(
            side.size and (is_loop | (side[first] != side[first + 1])).all()
        ),
        "degenerate_faces": int(_is_thin(mesh).sum()),
        "duplicate_faces": int((corners[1:] == corners[:-1]).sum()),
    }


def _points(vertices: NDArray[np.floating]) -> tuple[NDArray[np.int64], int]:
    """Return the number of each vertex's position, equal ones having the same, and how many."""
    order = np.lexsort(vertices.T)
    is_next = (vertices[order[1:]] != vertices[order[:-1]]).any(axis=1)
    number = np.zeros(len(order), np.int64)
    number[order[1:]] = np.cumsum(is_next)
    return number, int(is_next.sum()) + 1


def _is_thin(mesh: Mesh) -> NDArray[np.bool_]:
    a, b, c = (gather(mesh.vertices.T.astype(np.float64), k) for k in mesh.triangles.T)
    with np.errstate(all="ignore"):  # of what is huge, or has no side
        area, *sides = (np.sqrt(dot(v, v)) for v in (cross(b - a, c - b), b - a, c - a))
        return ~np.all([(side > _THIN) & (area / side > _THIN) for side in sides], axis=0)


def diagnosed(scene: Scene, manifest: Manifest) -> Generator[float, None, Manifest]:
    """Return the manifest with a diagnosis of each object's meshes.

    Yields 0 after each mesh: this is the first part of longer work.
    """
    diagnoses = []
    for mesh in scene.meshes:
        diagnoses.append(diagnose(mesh))
        yield 0.0
    own: dict[str, dict[int, None]] = {}
    for instance in scene.instances:
        own.setdefault(scene.objects[instance.object], {})[instance.mesh] = None
    entries = tuple(
        replace(e, diagnosis=merged([diagnoses[mesh] for mesh in own.get(e.name, ())]))
        for e in manifest.objects
    )
    return replace(manifest, objects=entries)


def merged(diagnoses: list[dict[str, Any]]) -> dict[str, Any] | None:
    """Join the diagnoses of several meshes: closed if all are, and the sum of each count."""
    if not diagnoses:
        return None
    return {
        key: (all if isinstance(value, bool) else sum)(d[key] for d in diagnoses)
        for key, value in diagnoses[0].items()
    }

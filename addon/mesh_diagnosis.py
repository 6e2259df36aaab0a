"""Diagnoses meshes: whether they are closed, how they are wound, what is double."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any

import numpy as np

from .arrays import Bools, Floats
from .manifest import Manifest
from .scene import Mesh, Scene
from .tracer.vector import cross, dot

_HEIGHT = 1e-8  # metres: a triangle less high than this, as trimesh says, is degenerate


def diagnose(mesh: Mesh) -> dict[str, Any]:
    """Return a diagnosis of a mesh, for JSON; trimesh has the same.

    Vertices at equal positions count as one. A mesh is closed if every edge has two triangles. Its
    winding is consistent if these go along the edge in opposite directions.
    """
    positions, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = index.reshape(-1)[mesh.triangles].reshape(-1, 3)
    start, end = faces[:, [0, 1, 2]].ravel(), faces[:, [1, 2, 0]].ravel()
    names = np.minimum(start, end) * len(positions) + np.maximum(start, end)
    edge, of, count = np.unique(names, return_inverse=True, return_counts=True)
    along = np.bincount(of.ravel(), start < end, minlength=len(edge))
    is_point = np.bincount(of.ravel(), start == end, minlength=len(edge)) > 0
    is_empty = not len(positions)
    return {
        "closed": not is_empty and bool((count == 2).all()),
        "consistent_winding": not is_empty and bool(((along == 1) | is_point)[count == 2].all()),
        "degenerate_faces": int(_degenerate(positions.astype(np.float64)[faces]).sum()),
        "duplicate_faces": len(faces) - len(np.unique(np.sort(faces), axis=0)),
    }


def _degenerate(corners: Floats) -> Bools:
    """Return which triangles (n, 3, 3) are hardly higher than a line above one of two edges."""
    p1, p2, p3 = corners.transpose(1, 2, 0)
    with np.errstate(all="ignore"):  # they may be huge, or have no area
        across = cross(p2 - p1, p3 - p2)
        area = np.sqrt(dot(across, across)) / 2
        lengths = [np.sqrt(dot(edge, edge)) for edge in (p2 - p1, p3 - p1)]
        high = [(length > _HEIGHT) & (area * 2 / length > _HEIGHT) for length in lengths]
    return ~(high[0] & high[1])


def diagnosed(scene: Scene, manifest: Manifest) -> Generator[float, None, Manifest]:
    """Return the manifest with a diagnosis of each object's meshes.

    Yields 0 after each mesh: this is the first part of longer work.
    """
    diagnoses = []
    for mesh in scene.meshes:
        diagnoses.append(diagnose(mesh))
        yield 0.0
    own: dict[str, set[int]] = {}
    for instance in scene.instances:
        own.setdefault(scene.objects[instance.object], set()).add(instance.mesh)
    entries = []
    for entry in manifest.objects:
        found = [diagnoses[mesh] for mesh in own.get(entry.name, ())]
        entries.append(replace(entry, diagnosis=_joined(found) if found else None))
    return replace(manifest, objects=tuple(entries))


def _joined(diagnoses: list[dict[str, Any]]) -> dict[str, Any]:
    """Return the diagnosis of several meshes: closed if all are, and the sum of each count."""
    return {
        key: (all if isinstance(value, bool) else sum)(d[key] for d in diagnoses)
        for key, value in diagnoses[0].items()
    }

"""Diagnoses meshes with trimesh: whether they are closed, how they are wound, what is double."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..manifest import Manifest
from ..scene import Mesh, Scene
from ..tracer.progress import Work


def diagnose(mesh: Mesh) -> dict[str, int]:
    """Return trimesh's diagnosis of a mesh, for JSON.

    Vertices at equal positions count as one. A mesh is closed if every edge has two triangles.
    """
    import trimesh

    positions, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = index.reshape(-1)[mesh.triangles]
    whole = trimesh.Trimesh(positions.astype(np.float64), faces, process=False)
    with np.errstate(all="ignore"):  # faces may be huge, or have no area
        return {
            "closed": bool(whole.is_watertight),
            "consistent_winding": bool(whole.is_winding_consistent),
            "degenerate_faces": int((~whole.nondegenerate_faces()).sum()),
            "duplicate_faces": len(faces) - len(np.unique(np.sort(faces), axis=0)),
        }


def diagnosed(scene: Scene, manifest: Manifest) -> Work[Manifest]:
    """Return the manifest with a diagnosis of each object's meshes."""
    diagnoses = []
    for mesh in scene.meshes:
        diagnoses.append(diagnose(mesh))
        yield None
    own: dict[str, set[int]] = {}
    for instance in scene.instances:
        own.setdefault(scene.objects[instance.object], set()).add(instance.mesh)
    entries = []
    for entry in manifest.objects:
        found = [diagnoses[mesh] for mesh in own.get(entry.name, ())]
        entries.append(replace(entry, diagnosis=_joined(found) if found else None))
    return replace(manifest, objects=tuple(entries))


def _joined(diagnoses: list[dict[str, int]]) -> dict[str, int]:
    """Return the diagnosis of several meshes: closed if all are, and the sum of each count."""
    return {
        key: (all if isinstance(value, bool) else sum)(d[key] for d in diagnoses)
        for key, value in diagnoses[0].items()
    }

"""Has trimesh say what is wrong with a mesh: is it closed, how is it wound, what is double."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any

import numpy as np

from .manifest import Manifest
from .scene import Mesh, Scene


def diagnose(mesh: Mesh) -> dict[str, Any]:
    """Return trimesh's diagnosis of a mesh, for JSON.

    Vertices at equal positions count as one. A mesh is closed if every edge has two triangles.
    """
    import trimesh

    positions, index = np.unique(mesh.vertices, axis=0, return_inverse=True)
    faces = index.reshape(-1)[mesh.triangles]
    whole = trimesh.Trimesh(positions.astype(np.float64), faces, process=False)
    distinct, _ = trimesh.grouping.unique_rows(np.sort(faces))  # type: ignore[no-untyped-call]
    with np.errstate(all="ignore"):  # of what is huge, or has no side
        return {
            "closed": bool(whole.is_watertight),
            "consistent_winding": bool(whole.is_winding_consistent),
            "degenerate_faces": int((~whole.nondegenerate_faces()).sum()),
            "duplicate_faces": len(faces) - len(distinct),
        }


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
        of = [diagnoses[mesh] for mesh in own.get(entry.name, ())]
        # Closed if all are, and the sum of each count.
        joined = {
            key: (all if isinstance(value, bool) else sum)(d[key] for d in of)
            for key, value in (of[0].items() if of else ())
        }
        entries.append(replace(entry, diagnosis=joined or None))
    return replace(manifest, objects=tuple(entries))

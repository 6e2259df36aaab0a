"""The account of a scene that never saw Blender: what its file holds, and what it lacks."""

from __future__ import annotations

from pathlib import Path

from ..manifest import Effect, Manifest, ObjectEntry, Unmodelled
from ..mesh_files.contents import Contents
from ..scene import Scene


def file_manifest(path: Path, scene: Scene, contents: Contents) -> Manifest:
    """Return the account of a scene that never saw Blender."""
    entries = tuple(_entry(scene, number, name) for number, name in enumerate(scene.objects))
    missing = tuple(Unmodelled(path.name, m, effect=Effect.UNPLACED) for m in contents.missing)
    camera, notes = scene.camera.name, contents.notes
    return Manifest(path.name, path.stem, "", 0, "FILE", camera, entries, missing, notes)


def _entry(scene: Scene, number: int, name: str) -> ObjectEntry:
    used = [i.mesh for i in scene.instances if i.object == number]
    planes = sum(p.object == number for p in scene.planes)
    own = [scene.meshes[k] for k in set(used)]
    return ObjectEntry(
        name,
        "INFINITE_PLANE" if planes else "MESH",
        exported=bool(used or planes),
        reason="" if used or planes else "nothing of it is in the file",
        triangles=sum(len(m.triangles) for m in own),
        vertices=sum(len(m.vertices) for m in own),
        instances=len(used) + planes,
        traced_triangles=sum(len(scene.meshes[k].triangles) for k in used),
    )

"""Opens a scene that never saw Blender, with the account of what its file holds and lacks."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import NamedTuple

from .framing import ANGLE, SIZE, Choice
from .manifest import Effect, Manifest, ObjectEntry, Unmodelled
from .mesh_files.contents import Contents
from .mesh_files.load import load_meshes, scene_of_meshes
from .scene import Scene, SceneError
from .scene_files import Account, load_account, load_scene


class Opened(NamedTuple):
    """What a file gives."""

    scene: Scene
    manifest: Manifest


def open_scene(path: Path, choice: Choice | None = None) -> Opened:
    """Open a .npz or a mesh, which is framed where no camera is chosen.

    Raises
    ------
    SceneError, OSError
        If there is no such scene, or it cannot be read.
    """
    if path.suffix.lower() == ".npz":
        scene = load_scene(path)
        return Opened(scene, file_manifest(path, scene, load_account(path)))
    choice = choice or Choice()
    contents = load_meshes(path, choice.up)
    missing = tuple(Unmodelled(path.name, m, effect=Effect.UNPLACED) for m in contents.missing)
    scene = _framed(path, contents, choice)
    return Opened(scene, file_manifest(path, scene, Account(missing, contents.notes)))


def _framed(path: Path, contents: Contents, choice: Choice) -> Scene:
    size = choice.size(SIZE)
    camera = choice.seen_by.camera if choice.seen_by else None
    if choice.eye:
        camera = choice.placed(*size)
    try:
        return scene_of_meshes(contents, camera, *size, choice.angle or ANGLE)
    except SceneError as error:
        raise SceneError(f"'{path}': {error}") from error


def file_manifest(path: Path, scene: Scene, said: Account) -> Manifest:
    """Return the account of a scene that is opened without Blender."""
    used: list[list[int]] = [[] for _ in scene.objects]
    for instance in scene.instances:
        used[instance.object].append(instance.mesh)
    planes = Counter(plane.object for plane in scene.planes)
    entries = tuple(
        _entry(scene, name, used[number], planes[number])
        for number, name in enumerate(scene.objects)
    )
    return Manifest(
        path.name,
        path.stem,
        view_layer="",
        frame=0,
        evaluation="FILE",
        camera=scene.camera.name,
        objects=entries,
        unmodelled=said.lacks,
        notes=said.notes,
    )


def _entry(scene: Scene, name: str, used: list[int], planes: int) -> ObjectEntry:
    """Return an object's entry: `used` has the mesh of each of its instances."""
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

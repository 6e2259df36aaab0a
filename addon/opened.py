"""Opens a scene that never saw Blender, with the account of what its file holds and lacks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from .files.exr import MissingLibraryError
from .files.scenes import Account, load_account, load_scene
from .framing import Choice
from .manifest import Manifest, ObjectEntry
from .scene import Scene, SceneError
from .tracer.settings import Settings


class Opened(NamedTuple):
    """An opened file: its scene, and the account of what it holds and lacks."""

    scene: Scene
    manifest: Manifest
    settings: Settings = Settings()  # that it stores


@cache
def mesh_formats() -> dict[str, Callable[[Path, Choice], Opened]]:
    """Return what opens a mesh's file, by its suffix; nothing in Blender's windows does."""
    out: dict[str, Callable[[Path, Choice], Opened]] = {}
    for package in beside("meshes"):
        out |= dict.fromkeys(package.FORMATS, package.open_meshes)
    return out


def beside(group: str) -> Iterator[Any]:
    """Yield what packages beside the add-on bring along for a use; in Blender there is none."""
    from importlib.metadata import entry_points

    for found in entry_points(group=f"reference_tracer.{group}"):
        yield found.load()


def only(group: str, what: str) -> Any:
    """Return the one package beside the add-on for a use; raises MissingLibraryError without it."""
    for package in beside(group):
        return package
    raise MissingLibraryError(f"{what} are no part of the extension: install reference_tracer")


def open_scene(path: Path, choice: Choice | None = None) -> Opened:
    """Open a .npz or a mesh, which is framed where no camera is chosen.

    Raises
    ------
    SceneError, MissingLibraryError, OSError
        If there is no such scene, or it cannot be read.
    """
    suffix = path.suffix.lower()
    if suffix == ".npz":
        scene = load_scene(path)
        return Opened(scene, file_manifest(path, scene, load_account(path)))
    if suffix not in mesh_formats():
        raise SceneError(f"'{path}' is none of {', '.join(('.npz', *mesh_formats()))}")
    return mesh_formats()[suffix](path, choice or Choice())


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

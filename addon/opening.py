"""A file that the user names, and a camera for meshes -> the scene in it.

A .blend is opened with the `bpy` module, in the one function here that imports it; scenes and
meshes from other files need no Blender.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from . import interrupts
from .scene import Camera, Scene, SceneError
from .scene_files import MESH_SUFFIXES, check_is_file, load_meshes, load_scene, scene_of_meshes
from .tracer.settings import Settings

SOURCES = f"scene.blend, scene.npz, or a mesh ({', '.join(MESH_SUFFIXES)})"


def load(
    path: Path,
    camera: Camera | None = None,
    size: tuple[int, int] = (960, 540),
    up: str | None = None,
) -> tuple[Scene, Settings]:
    """Return the scene of a .blend, a .npz or a mesh, with the settings that it stores.

    `camera` is for meshes, which have none: by default one that frames them, and whose picture is
    of this size, width and height in pixels. So is `up`: see `load_meshes`.

    Raises
    ------
    SceneError, OSError
        If there is no such scene, or it cannot be read.
    """
    check_is_file(path)
    suffix = path.suffix.lower()
    if suffix == ".npz":
        return load_scene(path), Settings()
    if suffix in MESH_SUFFIXES:
        return scene_of_meshes(load_meshes(path, up), camera, *size), Settings()
    if suffix != ".blend":
        raise SceneError(f"'{path}' is none of .blend, .npz, {', '.join(MESH_SUFFIXES)}")
    with open_blend(path) as blender:
        from .blender.compare import export_open_file

        scene, manifest, settings = export_open_file(blender.context)
    print(*manifest.lines(), sep="\n")
    return scene, settings


@contextmanager
def open_blend(path: Path) -> Iterator[Any]:
    """Open a .blend in this process, with the add-on registered; gives bpy.

    Raises
    ------
    SceneError
        If there is no such file, it cannot be opened, or Blender is not there as a module.
    """
    check_is_file(path)
    with interrupts.held():
        try:
            import bpy
        except ImportError as error:
            raise SceneError(
                "a .blend needs Blender as a module: pip install 'reference_tracer[blender]' "
                f"({error})"
            ) from error
        from .blender import registration

        registration.register()
    try:
        with interrupts.held():
            try:
                bpy.ops.wm.open_mainfile(
                    filepath=str(path.resolve()), load_ui=False, use_scripts=False
                )
            except RuntimeError as error:
                reason = str(error).split(": ")[-1].strip()  # Blender itself has printed it all
                raise SceneError(f"'{path}' cannot be opened: {reason}") from error
        yield bpy
    finally:
        registration.unregister()

"""Opens the file that a user names, and gives the scene in it.

A .blend is opened with the `bpy` module, in the one function here that imports it; scenes and
meshes from other files need no Blender.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..camera_files.files import of_frames
from ..comparison.animation import frames_named
from ..files.file_kinds import check_is_file
from ..framing import Choice
from ..opened import Opened, mesh_formats, open_scene
from ..scene import Scene, SceneError
from ..tracer.settings import Settings
from ..tracer.signals import held
from ..wording import show
from . import running
from .arguments import is_blend
from .camera_options import check_kind

PYTHONS = "3.11", "3.13"  # those that a bpy is made for
_AS_SAVED = Choice()
SOURCES = "scene.blend or scene.npz"
if mesh_formats():
    SOURCES = f"scene.blend, scene.npz, or a mesh ({', '.join(mesh_formats())})"


def load(path: Path, choice: Choice = _AS_SAVED) -> tuple[Scene, Settings]:
    """Return the scene of a .blend, a .npz or a mesh, with the settings that it stores.

    Prints its notes. Raises what :func:`open_file` raises.
    """
    opened = open_file(path, choice)
    lines = opened.manifest.lines()
    if not is_blend(path):  # all of another file is exported: no list is needed
        lines = opened.manifest.remarks()
    show(*lines)
    return opened.scene, opened.settings


def open_file(path: Path, choice: Choice = _AS_SAVED, whole: bool = False) -> Opened:
    """Open a .blend, a .npz or a mesh. Meshes are framed where no camera is chosen.

    Of a .blend, what is outside the camera's view is left out, unless `whole`.

    Raises
    ------
    SceneError, OSError
        If there is no such scene, or it cannot be read.
    """
    if is_blend(path):
        with open_blend(path, choice) as blender:
            from ..blender.jobs.open_file import export_open_file

            with evaluating(blender.context.view_layer, path.name):
                return Opened(*export_open_file(blender.context, whole=whole))
    check_kind(path)
    with running.meanwhile(f"reading {path.name}"):
        return open_scene(path, choice)


def open_frames(
    path: Path, choice: Choice, named: str | None, whole: bool = False
) -> Iterator[tuple[int, Opened]]:
    """Yield the frames that are named of a .blend, opened once, as :func:`open_file`.

    If none are, that is one, the saved one, with the number 0.
    """
    if named is None:
        yield 0, open_file(path, choice, whole)
        return
    with open_blend(path, choice) as blender:
        from ..blender.jobs.animation import frames_of
        from ..blender.jobs.choice import seen_by
        from ..blender.jobs.open_file import export_open_file
        from ..blender.jobs.stepping import bake_bodies, stepped

        user = blender.context.scene
        frames = frames_named(named) or frames_of(user)
        views = of_frames(choice.views, frames) if choice.views else {}
        bake_bodies(user, frames[-1])
        for frame in stepped(user, frames):
            with seen_by(user, views.get(frame)):
                opened = Opened(*export_open_file(blender.context, whole=whole))
            yield frame, opened


@contextmanager
def evaluating(layer: Any, what: str) -> Iterator[None]:
    """Name what Blender evaluates meanwhile: at once, where that took long the last time."""
    from ..blender.slowest import slowest

    name = slowest(layer)
    words = "having Blender evaluate " + (f"'{name}'" if name else what)
    if name:
        show(words, file=sys.stderr)
    with running.meanwhile(words):
        yield


def import_trimesh() -> None:
    """Import trimesh without the libraries that it does not need here: they take half a second."""
    hidden = [name for name in ("scipy", "networkx") if name not in sys.modules]
    for name in hidden:
        sys.modules[name] = None  # type: ignore[assignment]  # "it cannot be imported"
    try:
        import trimesh  # noqa: F401
    finally:
        for name in hidden:
            del sys.modules[name]


@contextmanager
def open_blend(path: Path, choice: Choice = _AS_SAVED) -> Iterator[Any]:
    """Open a .blend in this process, with the add-on registered, at what is chosen; gives bpy.

    One that is open in Blender already is taken as it is.

    Raises
    ------
    SceneError
        If there is no such file, it cannot be opened, it does not have what is chosen, or Blender
        is not there as a module.
    """
    if not choice.opened:
        check_is_file(path)
    with held():
        try:
            import bpy
        except ImportError as error:
            raise SceneError(_without_blender(error)) from error
        from ..blender import registration
        from ..blender.jobs.choice import chosen

        if not choice.opened:
            registration.register()
    try:
        if not choice.opened:
            with running.meanwhile(f"reading {path.name}"):
                _open(bpy, path)
        elif not bpy.data.filepath:
            say = "no file is open (is its name right?): name a .blend before --command"
            raise SceneError(say)
        with chosen(choice):
            yield bpy
    finally:
        if not choice.opened:
            registration.unregister()


def _without_blender(error: ImportError) -> str:
    own = "{}.{}".format(*sys.version_info)
    pip = 'pip install "reference_tracer[blender]"'
    if own not in PYTHONS:
        made = f"which is made for Python {' and '.join(PYTHONS)} and not for {own}"
        return f"a .blend needs Blender as a module, {made}: python{PYTHONS[-1]} -m {pip}"
    return f"a .blend needs Blender as a module: {pip} ({error})"


def _open(bpy: Any, path: Path) -> None:
    with held():
        from ..blender.reading.opened import open_file

        try:
            open_file(path)
        except RuntimeError as error:
            reason = str(error).split(": ")[-1].strip()  # Blender itself has printed it all
            do = "if it is cut off or damaged, copy or save it again"
            raise SceneError(f"'{path}' cannot be opened by Blender ({reason}): {do}") from error
    saved, own = (".".join(map(str, v[:2])) for v in (bpy.data.version, bpy.app.version_file))
    if bpy.data.version[:2] > bpy.app.version_file[:2]:
        do = f"this is {own}: open it with {saved} or newer"
        raise SceneError(f"'{path}' was saved by Blender {saved}; {do}")

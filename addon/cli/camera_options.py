"""The options that choose what of a file is looked at, and through which camera: a `Choice`."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from pathlib import Path

from ..framing import ANGLE, Choice
from ..scene import SceneError
from ..scene_files import MESH_SUFFIXES
from .parser import add_options

_OF_BLEND = "scene_name", "view_layer", "frame", "camera"  # of a .blend alone: see add_camera
_OF_MESH = "width", "height", "frame_all", "eye", "target", "angle", "ortho_scale", "up"
CAMERA_OPTIONS = *_OF_MESH, *_OF_BLEND


def add_camera(
    parser: argparse.ArgumentParser, width: int = 960, height: int = 540, of_scenes: bool = False
) -> None:
    """Add which camera sees what; `default_size` is that of a mesh's picture.

    With `of_scenes`, the width is that of the largest picture, and no scene's own.
    """
    size = "size_of_mesh" if of_scenes else "size"
    words = {"width": width, "height": height, "angle": ANGLE}
    add_options(parser, size, "camera", words=words)
    add_options(parser, "blend")
    parser.set_defaults(default_size=(width, height), heard=("width",) if of_scenes else ())


def choice_from(options: argparse.Namespace, path: Path | None = None) -> Choice:
    """Return what the options choose of a file; without one, of the .blend that is open.

    Raises
    ------
    SceneError
        If an option is not for such a file.
    """
    suffix = path.suffix.lower() if path else ".blend"
    names = [name for name in CAMERA_OPTIONS if name not in options.heard]
    if suffix in MESH_SUFFIXES:
        names += options.heard
        refuse(options, _OF_BLEND, f"is for a .blend: '{path}' has no such thing")
    else:
        refuse(options, ("up",), "is for meshes: in a scene it is Z")
    if suffix not in (*MESH_SUFFIXES, ".blend"):
        why = f"is for a .blend or a mesh: '{path}' has its own camera, and what that one sees"
        refuse(options, names, why)
    chosen = {name: getattr(options, name, None) for name in names}
    opened = getattr(options, "opened", False)
    return Choice(**chosen, default_size=options.default_size, opened=opened)


def refuse_camera(options: argparse.Namespace, suffix: str | None) -> None:
    """Refuse what the other options, or the file's ending, leave without a meaning."""
    if getattr(options, "heard", ()) and suffix not in MESH_SUFFIXES:
        why = "is for meshes: of a scene --width sets the size of its picture, the height follows"
        refuse(options, ("height",), why)
    if getattr(options, "camera", None) is not None:
        refuse(options, ("frame_all", "eye"), "is for a camera beside that of --camera")
    if getattr(options, "frame_all", False):
        why = "is not for --frame-all, which finds where the camera stands and what it sees"
        refuse(options, ("eye", "ortho_scale"), why)
    elif getattr(options, "eye", None) is None and suffix not in MESH_SUFFIXES:
        refuse(options, ("angle",), "is for a camera that --eye or --frame-all places")
    elif getattr(options, "ortho_scale", None) is not None:
        refuse(options, ("angle",), "is not for the orthographic camera of --ortho-scale")
    if getattr(options, "eye", None) is None:
        refuse(options, ("target", "ortho_scale"), "is for a camera that --eye places")


def refuse(options: argparse.Namespace, names: Iterable[str], why: str) -> None:
    """Raise a SceneError for an option that is given, but would not be heard."""
    for name in names:
        value = getattr(options, name, None)
        if value is not None and value is not False:  # 0 is given
            raise SceneError(f"{typed(name)} {why}")


def typed(name: str) -> str:
    """Return an option as it is typed."""
    return f"--{name.removesuffix('_name').replace('_', '-')}"

"""Meshes in files: which formats are read, and by which module of this package.

The add-on finds this package by its entry point, since Blender's window needs none of it.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from reference_tracer.framing import Choice
    from reference_tracer.opened import Opened

# By suffix, the module that has `read`: from a path to `Contents`. Each is imported once it is
# asked for.
FORMATS = {
    ".obj": "obj",
    ".ply": "ply",
    ".off": "off",
    ".stl": "stl",
    ".glb": "gltf",
    ".gltf": "gltf",
    ".usd": "usd",
    ".usda": "usd",
    ".usdc": "usd",
    ".usdz": "usd",
}


def open_meshes(path: Path, choice: Choice) -> Opened:
    """Return the scene of a mesh's file, which is framed where no camera is chosen.

    Raises
    ------
    SceneError, MissingLibraryError, OSError
        If there is no such file, it cannot be read, or it holds no triangle.
    """
    from . import load

    return load.open_meshes(path, choice)

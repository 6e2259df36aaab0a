"""Reads the meshes of a USD file, by Blender."""

from __future__ import annotations

from pathlib import Path

from . import by_blender
from .contents import Contents


def read(path: Path) -> Contents:
    """Read the meshes of a .usd, .usda, .usdc or .usdz, each in its place at the file's first time.

    What is invisible, a guide or a proxy is left out; nothing of another file is read.

    Raises
    ------
    MissingLibraryError
        If Blender is not there as a module.
    SceneError
        If it cannot be read, or refers to other files.
    """
    return by_blender.imported(path.absolute(), f"{path.suffix} files take")

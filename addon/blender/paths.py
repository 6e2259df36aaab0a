"""Paths as Blender writes them: // is the folder of the file that is open."""

from __future__ import annotations

from pathlib import Path

import bpy


def open_path() -> Path:
    """Return the path of the open file, a backup's as a .blend; `none.blend` where none is open."""
    return Path(bpy.data.filepath or "none").with_suffix(".blend")  # a backup's ends in .blend1


def absolute(path: str) -> Path:
    """Return a path as Blender writes it, or as the shell does."""
    return Path(bpy.path.abspath(path))

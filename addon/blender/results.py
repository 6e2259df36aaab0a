"""The latest comparison, for the panels. Not stored in the .blend: it speaks of one moment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy

from ..compare.comparison import Comparison
from ..report.pictures import difference
from . import images


@dataclass(frozen=True, eq=False)
class Result:
    """What the panels show."""

    file: str
    scene: str
    comparison: Comparison
    lines: tuple[str, ...]  # computed once: panels are drawn many times a second


_latest: Result | None = None


def keep(context: Any, comparison: Comparison) -> Result:
    """Remember a comparison, and put its three pictures into images of Blender's."""
    global _latest
    images.show(images.TRACED, comparison.frame.color)
    images.show(images.BLENDER, comparison.picture)
    shown = images.show(images.DIFFERENCE, difference(comparison))
    for area in context.window.screen.areas if context.window else ():
        if area.type == "IMAGE_EDITOR" and area.spaces.active.mode == "VIEW":
            area.spaces.active.image = shown
            break
    _latest = Result(
        bpy.data.filepath, comparison.manifest.scene, comparison, tuple(comparison.lines())
    )
    return _latest


def latest(scene: Any) -> Result | None:
    """Return the latest comparison, if it is of this scene in the file that is open."""
    if _latest and (_latest.file, _latest.scene) == (bpy.data.filepath, scene.name):
        return _latest
    return None


def forget() -> None:
    """Drop the latest comparison, as when another file is opened."""
    global _latest
    _latest = None

"""The source of a scene's variants: the export, its Blender scene, and which objects are tried."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass
from typing import Any

import bpy

from ....causes.case import Variant
from ....pictures.palette import Palette
from ....scene import Scene
from ....wording import listed
from ...evaluating import export_for_render

MOST = 6  # objects that are tried alone


def all_and_each(
    fault: str, names: Collection[str], made: Callable[[Collection[str]], Scene], words: str = "{}"
) -> Iterator[Variant]:
    """Yield the scene with a fault of all these objects, then of single ones.

    In the words, which objects take the place of braces.
    """
    alone = [[name] for name in [*names][:MOST]]
    for some in ([*names], *alone) if len(names) > 1 else alone:
        said = listed([f"'{name}'" for name in some], 3)
        name = some[0] if len(some) == 1 else ""
        yield Variant(fault, made(some), words.format(said), name)


@dataclass(frozen=True, eq=False)
class Origin:
    """A scene of Blender's, and what is exported of it."""

    scene: bpy.types.Scene  # the user's
    layer: str
    tmp: bpy.types.Scene  # a temporary copy of it
    exported: Scene  # with all that the view leaves out
    palette: Palette  # its colours

    def again(self) -> Scene:
        """Export the temporary scene as it is now."""
        return export_for_render(self.tmp)[0]

    @property
    def objects(self) -> dict[str, Any]:
        """The objects that are exported, by their names there."""
        there = {obj.name_full: obj for obj in self.scene.objects}
        return {name: there[name] for name in self.exported.objects if name in there}

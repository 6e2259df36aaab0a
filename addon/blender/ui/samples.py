"""Opens the sample scenes that are shipped: from *File > New*, and from the panel.

Blender looks for templates of its own in the user's and the system's folders alone
(`bpy.utils.app_template_paths`), where no extension is. So the scenes are opened as templates are:
as a new file without a name, which asks about unsaved changes first, and is never saved over them.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import bpy
from bpy.types import Context, UILayout

FOLDER = Path(__file__).parents[3] / "sample_scenes"
TITLE = "Open Sample Scene"


@cache
def scenes() -> tuple[Path, ...]:
    """Return the files that are there, by name; a panel is drawn many times a second."""
    return tuple(sorted(FOLDER.glob("*.blend")))


def draw_scenes(layout: UILayout) -> None:
    """Draw an entry for each scene."""
    layout.operator_context = "INVOKE_DEFAULT"
    for path in scenes():
        name = path.stem.replace("_", " ").title()
        layout.operator("wm.read_homefile", text=name).filepath = str(path)


class REFERENCE_TRACER_MT_samples(bpy.types.Menu):
    bl_label = TITLE

    def draw(self, context: Context) -> None:
        draw_scenes(self.layout)

"""*Get Extensions › Install from Disk* in the open window: the add-on goes, and comes again."""

import sys
from pathlib import Path

import bpy
from story import (
    MODULE,
    OUT,
    compared,
    noted,
    press_compare,
    result,
    screenshot,
    show_panel,
    until,
    window,
)

SCENE = "exercise_triangle"
ID = MODULE.rpartition(".")[2]


def from_disk():
    window().scene.render.resolution_percentage = 10
    press_compare()
    yield from until(compared, 60)
    repositories = [r.module for r in bpy.context.preferences.extensions.repos]
    number = repositories.index("user_default")
    bpy.ops.extensions.package_uninstall(repo_index=number, pkg_id=ID)
    yield
    noted["gone"] = {
        "panel": hasattr(bpy.types, "RENDER_PT_reference_tracer"),
        "scene": hasattr(bpy.types.Scene, ID),
        "images": len(bpy.data.images),
        "modules": [name for name in sys.modules if name.startswith(MODULE)],
    }
    [package] = Path("/project/dist").glob("reference_tracer-*.zip")
    for name in ("installed", "again"):
        done = bpy.ops.extensions.package_install_files(
            filepath=str(package), repo="user_default", enable_on_install=True
        )
        noted[name] = list(done)
        yield
    window().scene.render.engine = "REFERENCE_TRACER"
    window().scene.render.resolution_percentage = 25
    show_panel()
    folder = OUT / "preferred"
    bpy.context.preferences.addons[MODULE].preferences.folder = str(folder)
    yield from in_preferences()
    press_compare()
    yield from until(compared, 60)
    noted["verdict"] = result().content.verdict
    noted["written"] = sorted(str(p.relative_to(folder)) for p in folder.rglob("comparison.json"))
    bpy.context.preferences.addons[MODULE].preferences.folder = ""
    screenshot("from_disk")


def in_preferences():
    """Look at what the Preferences show of the add-on."""
    bpy.context.preferences.active_section = "ADDONS"
    bpy.context.window_manager.addon_search = "Reference Tracer"
    area = next(a for a in window().screen.areas if a.type == "VIEW_3D")
    area.type = "PREFERENCES"
    with bpy.context.temp_override(window=window(), area=area):
        bpy.ops.preferences.addon_expand(module=MODULE)
    yield 0.3
    screenshot("in_preferences")
    area.type = "VIEW_3D"
    yield


STORIES = (from_disk,)

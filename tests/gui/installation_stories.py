"""*Get Extensions › Install from Disk* in the open window: the add-on goes, and comes again."""

import sys
from pathlib import Path

import bpy
from story import (
    MODULE,
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
    repositories = [r.module for r in bpy.context.preferences.extensions.repos]
    number = repositories.index("user_default")
    bpy.ops.extensions.package_uninstall(repo_index=number, pkg_id=ID)
    yield
    noted["gone"] = {
        "panel": hasattr(bpy.types, "RENDER_PT_reference_tracer"),
        "scene": hasattr(bpy.types.Scene, ID),
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
    yield
    press_compare()
    yield from until(compared, 60)
    noted["verdict"] = result().content.verdict
    screenshot("from_disk")


STORIES = (from_disk,)

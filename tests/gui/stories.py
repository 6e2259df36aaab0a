"""What a user does with comparisons and a study, played in Blender's window: see `play.py`."""

from pathlib import Path
from urllib.parse import urlparse
from urllib.request import url2pathname

import bpy
import numpy as np
from story import (
    compared,
    data_blocks,
    ended,
    invoke,
    noted,
    open_tab,
    press,
    press_compare,
    render_result,
    result,
    running,
    screenshot,
    settings,
    show_panel,
    until,
    window,
)


def compare():
    """The button: three images, the numbers in the panel, nothing else changed."""
    show_panel()
    preferences = bpy.context.preferences
    preferences.system.viewport_aa = "FXAA"  # which must survive, too
    preferences.is_dirty = False
    yield
    bpy.ops.render.render()  # the user's own last render must survive
    before = settings(), data_blocks(), render_result()
    noted["pressed"] = list(press_compare())
    yield from until(compared)
    yield from until(ended)
    after = settings(), data_blocks(), render_result()
    comparison = result().content
    noted["comparison"] = comparison.to_dict()
    noted["changed"] = {k: (before[0][k], v) for k, v in after[0].items() if before[0][k] != v}
    noted["new"] = {
        k: sorted(set(v) - set(before[1][k])) for k, v in after[1].items() if v != before[1][k]
    }
    noted["render_result_kept"] = before[2] == after[2] and before[2] is not None
    noted["images"] = {
        i.name: [list(i.size), float(np.ptp(np.array(i.pixels[:])))]
        for i in bpy.data.images
        if i.name.startswith("Reference Tracer")
    }
    window().scene.render.engine = "REFERENCE_TRACER"  # its tab is short: our panel is in sight
    show_panel()
    yield
    yield from open_tab()
    screenshot("compare")
    for area in window().screen.areas:
        if area.type == "VIEW_3D":
            area.type = "IMAGE_EDITOR"
            area.spaces.active.image = bpy.data.images["Reference Tracer Difference"]
            break
    yield
    screenshot("compare_difference")


def engines():
    """The other button: the viewport, Workbench and Cycles in one table; nothing is changed."""
    window().scene.render.engine = "REFERENCE_TRACER"
    window().scene.render.resolution_percentage = 12
    show_panel()
    yield
    before = settings(), data_blocks()
    noted["pressed"] = list(invoke("compare_all"))

    def compared_all():
        return result("ENGINES") is not None

    yield from until(compared_all)
    yield from until(ended)
    after = settings(), data_blocks()
    noted["changed"] = {k: (before[0][k], v) for k, v in after[0].items() if before[0][k] != v}
    noted["new"] = {k: v for k, v in after[1].items() if v != before[1][k]}
    noted["version"] = list(bpy.app.version)
    noted["rows"] = [row.to_dict() for row in result("ENGINES").content]
    yield from open_tab()
    screenshot("engines")


def animation():
    """Compare Animation: Esc keeps the frames that are done; another file ends it, too."""
    scene = window().scene
    scene.render.engine = "REFERENCE_TRACER"
    scene.render.resolution_percentage = 10
    scene.frame_end, scene.frame_current = 60, 7
    show_panel()
    yield
    before = settings(), data_blocks()
    noted["pressed"] = list(invoke("compare_animation"))

    def some_are_done():
        found = result("FRAMES")
        return found and len(found.content[1]) > 2

    yield from until(some_are_done)
    screenshot("animation_running")
    press("Escape")
    yield from until(ended)
    page, rows = result("FRAMES").content
    noted["frames"] = [row.frame for row in rows]
    noted["on_disk"] = sorted(p.parent.name for p in page.parent.glob("*/made_by.json"))
    noted["page"] = page.read_text(encoding="utf-8")
    noted["frame"] = scene.frame_current
    after = settings(), data_blocks()
    noted["changed"] = {k: (before[0][k], v) for k, v in after[0].items() if before[0][k] != v}
    noted["new"] = {k: v for k, v in after[1].items() if v != before[1][k]}
    yield from open_tab()
    screenshot("animation")
    noted["pressed_again"] = list(invoke("compare_animation"))
    yield 0.5
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/exercise_triangle.blend")
    yield
    noted["left"] = running()


def compare_as_is():
    """The user's own shading: what smooths a window's edges is a preference, not the scene's."""
    window().scene.reference_tracer.shading = "AS_IS"
    window().scene.display.viewport_aa = "OFF"
    bpy.context.preferences.system.viewport_aa = "FXAA"
    window().scene.render.resolution_percentage = 50
    yield
    press_compare()
    yield from until(compared)
    noted["comparison"] = result().content.to_dict()
    noted["preference"] = bpy.context.preferences.system.viewport_aa


def no_camera():
    """A button adds the camera that is missing; undo takes it away."""
    bpy.data.objects.remove(window().scene.camera)
    bpy.ops.ed.undo_push(message="Delete")
    yield
    noted["pressed"] = list(invoke("frame_all"))
    yield
    noted["added"] = window().scene.camera.name
    with bpy.context.temp_override(window=window()):
        noted["undo"] = list(bpy.ops.ed.undo())
    yield
    noted["cameras"] = [o.name for o in bpy.data.objects if o.type == "CAMERA"]


def trade():
    """A study: it runs while the interface is alive, alone, and its plot is behind its button."""
    yield
    bpy.ops.render.render()  # the user's own last render must survive
    before = settings(), data_blocks(), render_result()
    noted["pressed"] = list(invoke("trade", width=24, samples=2))
    yield
    noted["running"] = running()
    noted["others"] = [getattr(bpy.ops.reference_tracer, n).poll() for n in ("compare", "trade")]

    def measured():
        return result("TRADE")

    yield from until(measured, 900)
    yield
    noted["same"] = before == (settings(), data_blocks(), render_result())
    noted["said"] = [result("TRADE").lines[0], result("TRADE").content.advice]
    page = Path(url2pathname(urlparse(result("TRADE").page).path))
    noted["plots"] = '"title":' in page.read_text(encoding="utf-8").partition('"plots":')[2]


def material_preview():
    """A mode that Blender refuses where an engine has no use for it."""
    window().scene.render.engine = "REFERENCE_TRACER"
    yield
    for area in window().screen.areas:
        if area.type == "VIEW_3D":
            shading = area.spaces.active.shading
            shading.type = "MATERIAL"
            noted["shading"] = shading.type
            shading.type = "SOLID"  # before it is drawn: EEVEE's shaders take a minute in software


def scenes():
    """Every sample scene, and the scene that Blender starts with, against the real viewport."""
    for path in (*sorted(Path("/project/sample_scenes").glob("*.blend")), Path("default_cube")):
        if path.suffix:
            bpy.ops.wm.open_mainfile(filepath=str(path))
        else:
            bpy.ops.wm.read_homefile(use_factory_startup=True)
        # Few of the pixels: the whole of suzanne is in a story above.
        window().scene.render.resolution_percentage = 25
        yield
        press_compare()
        yield from until(compared)
        noted[path.stem] = result().content.to_dict()


SCENE = "suzanne"
STORIES = (
    compare,
    engines,
    animation,
    compare_as_is,
    no_camera,
    trade,
    material_preview,
    scenes,
)

"""Blender draws something else than the scene says: the panel says what, and leads there."""

from contextlib import contextmanager

import bpy
from story import (
    compared,
    data_blocks,
    ended,
    invoke,
    module,
    noted,
    open_tab,
    press,
    press_compare,
    reports,
    result,
    running,
    screenshot,
    show_panel,
    until,
    window,
)
from work_stories import listened

SCENE = "suzanne"


@contextmanager
def drawn_otherwise(owner, name, value):
    """Have Blender draw another value than was exported, as a handler might set it."""
    drawings = module("blender.drawing.drawings")
    real = drawings.picture

    def picture(*args, **options):
        before = getattr(owner, name)
        setattr(owner, name, value)
        try:
            return (yield from real(*args, **options))
        finally:
            setattr(owner, name, before)

    drawings.picture = picture
    try:
        yield
    finally:
        drawings.picture = real


def diagnosis():
    """The panel, Esc in the midst, and the copy of the camera."""
    scene = window().scene
    scene.render.resolution_percentage = 15
    scene.reference_tracer.identity = False
    yield
    lens = scene.camera.data.lens
    levels = scene.objects["Suzanne"].modifiers.new("Subdivision", "SUBSURF")
    levels.levels = 0
    levels.render_levels = 4  # so that Blender takes its time for each variant
    view = next(a for a in window().screen.areas if a.type == "VIEW_3D").spaces.active
    scenes, has_sidebar = data_blocks()["scenes"], view.show_region_ui
    heard, stop = listened()

    def asked():
        return any("2/48: asking" in said for said in heard if said)

    with drawn_otherwise(scene.camera.data, "lens", lens * 1.05):
        press_compare()
        yield from until(asked, 120)
        noted["running_after_comparison"] = bool(running()) and compared()
        press("n")  # of which nothing is heard before Esc
        press("Escape")
        yield from until(ended, 60)
    stop()
    yield
    scene.objects["Suzanne"].modifiers.remove(levels)
    noted["stopped"] = [view.show_region_ui == has_sidebar, data_blocks()["scenes"] == scenes]
    found = result().content
    noted["esc"] = {
        "verdict": found.verdict,
        "unexplained": found.counts.unexplained,
        "diagnosed": found.diagnosis is not None,
        "lens": scene.camera.data.lens == lens,
    }
    with drawn_otherwise(scene.camera.data, "lens", lens * 1.05):
        press_compare()
        yield from until(ended, 300)
    noted["told"] = [told.sentence for told in result().content.diagnosis.told]
    show_panel()
    yield
    yield from open_tab()
    screenshot("diagnosis")
    noted["pressed"] = sorted(invoke("copy_camera", number=0))
    copy = window().view_layer.objects.active
    noted["copy"] = {
        "name": copy.name,
        "lens": copy.data.lens / copy.data.sensor_width * 36 / lens,
        "active_camera": scene.camera.name,
    }
    bpy.ops.ed.undo()
    yield
    noted["after_undo"] = copy_names()
    noted["reports"] = reports()


def copy_names():
    return [o.name for o in window().scene.objects if "as in the picture" in o.name]


STORIES = (diagnosis,)

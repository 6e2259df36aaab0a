"""The lessons' clicks, as docs/lessons/plans tell them, by a hand.

With `LESSON_CLIPS` in the environment, a picture of each is taken: `tools/documents/clips.py` has
them played so, and joins the pictures into the lessons' clips.
"""

import os
from pathlib import Path

import bpy
from hands import COMPARE, along, click, click_on, found, last, on_screen
from inspector_stories import place_in_view, region_of
from story import (
    compared,
    ended,
    invoke,
    noted,
    open_tab,
    opened,
    press,
    result,
    scaled,
    screenshot,
    until,
    window,
    with_browser,
)

RECORDED = "LESSON_CLIPS" in os.environ
# Pixels from the top of *Trace and Compare* down to what can be unfolded, before any comparison.
SAMPLES, SETTINGS = 115, 71


def area(kind):
    return next(a for a in window().screen.areas if a.type == kind)


def shot(step, *where):
    """Take a picture for a step's clip; with a place of a region, where the next click is."""
    if RECORDED:
        shots = noted.setdefault("shots", [])
        name = f"{noted['lesson']}_{len(shots)}"
        screenshot(name)
        shots.append([name, step, on_screen(*where) if where else None])


def clicked(step, *where):
    shot(step, *where)
    yield from click(*where)
    yield 0.3


def begun(lesson, scene):
    """Step 1, from Blender as it starts: unfold *Open Sample Scene*, press the scene's name."""
    noted["lesson"] = lesson
    last.clear()  # the offsets below are from where a button is found from the top
    bpy.context.preferences.view.render_display_type = "AREA"
    bpy.context.preferences.is_dirty = False
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    window().scene.render.engine = "REFERENCE_TRACER"  # its tab is short
    area("PROPERTIES").spaces.active.context = "RENDER"
    yield 0.5
    region, x, y = yield from found(area("PROPERTIES"), COMPARE)
    yield from clicked(1, region, x, y - scaled(SAMPLES))
    yield from clicked(1, *(yield from found(area("PROPERTIES"), f"{scene}.blend")))
    name = scene.replace("_", ": ").title()

    def there():
        return window().scene.name == name

    yield from until(there, 20)
    yield 0.5
    shot(1)


def aside_and_back(step):
    """Leave the camera's view, and come back."""
    view = area("VIEW_3D").spaces.active.region_3d
    for perspective in ("PERSP", "CAMERA"):

        def so(perspective=perspective):
            return view.view_perspective == perspective

        press("Numpad 0")
        yield from until(so, 20)
        yield 0.5
        shot(step)


def traced(step):
    """Press *Trace and Compare*."""
    before = result()

    def another():
        return compared() and result() is not before

    yield from clicked(step, *(yield from found(area("PROPERTIES"), COMPARE)))
    yield from until(another)
    yield from until(ended)
    yield 0.5
    shot(step)


def chosen(step, name):
    """Choose a picture in the Image Editor's header."""
    yield from clicked(step, *(yield from along(area("IMAGE_EDITOR"), f"'{name}'")))
    shot(step)


def inspected(step, *pixels):
    """Press *Inspect Pixels* in the Image Editor's sidebar, click on pixels, end it."""
    editor = area("IMAGE_EDITOR")
    yield from open_tab(editor)
    yield from clicked(step, *(yield from found(editor, "reference_tracer.inspect(", kind="UI")))
    region, size = region_of(editor), editor.spaces.active.image.size
    for x, y in pixels:
        place = (x + 0.5) / size[0], (y + 0.5) / size[1]
        yield from clicked(step, region, *region.view2d.view_to_region(*place, clip=False))
        shot(step)
        derived = result("PIXEL").content
        noted.setdefault("pixels", []).append([derived.pixel.x, derived.pixel.y])
    press("Escape")
    yield


def lesson_1():
    """constant_shading.md; and what a user does with a result: go to what differs, page."""
    with_browser()
    yield from begun("constant_shading", "exercise_orthographic")
    yield from aside_and_back(2)
    yield from traced(3)
    noted["verdict"] = result().content.verdict
    for name in ("TRACED", "CAUSES"):
        yield from chosen(4, name)
        noted[name] = area("IMAGE_EDITOR").spaces.active.image.name
    yield from inspected(5, (67, 190), (67, 300))
    noted["text"] = bpy.data.texts[0].name
    if RECORDED:
        shot(6)
        area("IMAGE_EDITOR").type = "TEXT_EDITOR"
        bpy.data.texts[0].cursor_set(0)
        area("TEXT_EDITOR").spaces.active.text = bpy.data.texts[0]
        area("TEXT_EDITOR").spaces.active.top = 0
        yield 0.5
        shot(6)
        return
    yield from click_on(area("PROPERTIES"), "reference_tracer.select_object(", across=0.93)
    noted["selected"] = [o.name for o in window().view_layer.objects if o.select_get()]
    yield from click_on(area("PROPERTIES"), "reference_tracer.open_page(")
    yield from until(opened)
    noted["page"] = Path(opened().removeprefix("file://")).exists()
    screenshot("lesson_1")


def lesson_2():
    """perspective_camera.md"""
    yield from begun("perspective_camera", "exercise_perspective")
    camera = window().scene.camera
    window().view_layer.objects.active = camera
    yield 0.3
    shot(2)
    area("PROPERTIES").spaces.active.context = "DATA"
    yield 0.5
    shot(2)
    for kind in ("ORTHO", "PERSP"):
        camera.data.type = kind
        yield 0.5
        shot(3)
    area("PROPERTIES").spaces.active.context = "RENDER"
    yield 0.3
    yield from traced(4)
    yield from chosen(4, "TRACED")
    yield from inspected(4, (320, 240), (600, 440))


def lesson_3():
    """plane.md"""
    yield from begun("plane", "exercise_plane")
    yield from traced(2)
    for name in ("TRACED", "OTHER"):
        yield from chosen(2, name)
    yield from inspected(3, (20, 229), (20, 228))
    yield from inspected(4, (20, 280))


def lesson_4():
    """triangle.md"""
    yield from begun("triangle", "exercise_triangle")
    scene = window().scene
    region, x, y = yield from found(area("PROPERTIES"), COMPARE)
    yield from clicked(3, region, x, y - scaled(SETTINGS))
    scene.reference_tracer.method = "textbook_literal"
    scene.reference_tracer.diagnose = False  # of so many holes: it takes its time
    yield 1
    yield from traced(3)
    yield from chosen(3, "TRACED")
    yield from inspected(4, result().content.metrics.largest_difference.pixel)
    scene.reference_tracer.method = "textbook"
    yield 1
    yield from traced(4)
    yield from chosen(4, "TRACED")
    shown = area("IMAGE_EDITOR")
    shown.type = "VIEW_3D"
    bpy.context.window_manager.reference_tracer.draw_ray = True
    invoke("inspect")
    yield 0.5
    yield from clicked(5, region_of(shown), *place_in_view(shown, 320, 150))
    press("Escape")
    yield from aside_and_back(5)


SCENE = "exercise_perspective"
STORIES = (lesson_1, lesson_2, lesson_3, lesson_4)

"""A result belongs to the session, as a render does: what comes after the first picture."""

import json

import bpy
import numpy as np
from seen_stories import at_rest, editor
from story import (
    MODULE,
    OUT,
    module,
    noted,
    press,
    press_compare,
    result,
    screenshot,
    until,
    window,
)


def image_names():
    """Of all images, but what Blender itself draws into."""
    return sorted(i.name for i in bpy.data.images if i.source != "VIEWER")


def second_day():
    """Compare, save, open, compare, save as, undo, another engine, close, open again."""
    view = bpy.context.preferences.view
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    view.render_display_type = "WINDOW"
    window().scene.render.resolution_percentage = 30
    noted["steps"] = {}
    first, second = OUT / "first.blend", OUT / "second.blend"
    saved_as(first)
    yield from seen("new", first)
    yield from compare("compared", first)
    press("ctrl+s")
    yield from seen("saved", first)
    yield from opened_by_key(first)
    yield from seen("opened", first)
    for number in range(3):
        yield from compare(f"compared_{number}", first)
    saved_as(second)
    yield from seen("saved_as", second)
    for x in (1.0, 2.0, 3.0):
        moved(x)
    yield from compare("moved", second)
    for _ in range(3):
        press("ctrl+z")
        yield
    yield from seen("undone", second)
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.redo()
    yield
    yield from seen("redone", second)
    for engine in ("WORKBENCH", "CYCLES"):
        window().scene.reference_tracer.judge = engine
        yield from compare(engine.lower(), second)
    press("ctrl+s")
    yield from seen("saved_again", second)
    yield from opened_by_key(second)
    yield from seen("opened_again", second)
    view.render_display_type = "NONE"


def saved_as(path):
    bpy.ops.wm.save_as_mainfile(filepath=str(path))


def moved(x):
    """Move the cube, as a step of the user's."""
    bpy.data.objects["Cube"].location.x = x
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message="Move")


def compare(name, path):
    """Press the button, and note what is seen then."""
    before = result() and result().content
    press_compare()
    yield from until(lambda: at_rest() and result().content is not before, 60)
    yield from seen(name, path)


def opened_by_key(path):
    """Open a new file by keys, which asks first where something is to be saved; then one."""
    press("ctrl+n")
    yield
    screenshot(f"session_new_{path.stem}")
    press("g")
    yield
    noted["steps"][f"new after {path.stem}"] = bpy.data.filepath
    bpy.ops.wm.open_mainfile(filepath=str(path))
    yield


def seen(name, path):
    """Note what there is of a result, and what a file has of it."""
    yield 0.3
    _, area = editor()
    image = area and area.spaces.active.image
    noted["steps"][name] = {
        "size": path.stat().st_size,
        "images": image_names(),
        "dirty": [i.name for i in bpy.data.images if i.is_dirty],
        "shown": image and image.name,
        "fresh": bool(image and shows_latest()),
        "verdict": result() and result().content.verdict,
        "at": bpy.data.objects["Cube"].location.x,
    }
    screenshot(f"session_{name}")


def shows_latest():
    """Whether our traced picture is that of the latest comparison."""
    color = result().content.frame.color.astype(np.float32)
    image = bpy.data.images["Reference Tracer Traced"]
    found = np.empty_like(color)
    image.pixels.foreach_get(found.ravel())
    return np.array_equal(color, found)


def elsewhere():
    """A second window with a second scene; a lens that is not modelled; a saved image; it goes."""
    first = window().scene
    first.render.resolution_percentage = 20
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.window_new_main()
        bpy.ops.scene.new(type="LINK_COPY")
    yield
    of_first, of_second = sorted(bpy.context.window_manager.windows, key=lambda w: w.scene != first)
    area = next(a for a in of_second.screen.areas if a.type == "VIEW_3D")
    area.type = "IMAGE_EDITOR"
    yield
    noted["scenes"] = []
    for where in (of_first, of_second, of_first):
        yield from compared_in(where)
        noted["scenes"].append([shown_in(area), [verdict(w) for w in (of_first, of_second)]])
    screenshot("session_two_windows")
    kept = OUT / "kept.png"
    kept.unlink(missing_ok=True)
    with bpy.context.temp_override(window=of_second, area=area):
        bpy.ops.image.save_as(filepath=str(kept))
    yield
    before = kept.read_bytes()
    yield from compared_in(of_first)
    noted["saved"] = [kept.read_bytes() == before, image_names(), shown_in(area)]
    first.camera.data.type = "PANO"
    with bpy.context.temp_override(window=of_first):
        bpy.ops.reference_tracer.compare("INVOKE_DEFAULT", True)
    yield from until(ended, 20)
    noted["refused"] = [image_names(), shown_in(area), verdict(of_first)]
    yield
    screenshot("session_refused")
    first.camera.data.type = "PERSP"
    yield from compared_in(of_first)
    bpy.ops.reference_tracer.explain(x=3, y=4)
    noted["before"] = [image_names(), [t.name for t in bpy.data.texts]]
    bpy.ops.preferences.addon_disable(module=MODULE)
    yield
    noted["disabled"] = [image_names(), [t.name for t in bpy.data.texts], shown_in(area)]
    screenshot("session_disabled")
    bpy.ops.preferences.addon_enable(module=MODULE)


def compared_in(where):
    """Press the button in a window, and wait for its result."""
    with bpy.context.temp_override(window=where):
        bpy.ops.reference_tracer.compare("INVOKE_DEFAULT", True)
    yield from until(ended, 60)
    yield 0.3


def verdict(where):
    """The verdict that the panel of a window shows."""
    found = module("blender.ui.results")
    comparison = found.content(found.Kind.COMPARISON, where.scene)
    return comparison and comparison.verdict


def shown_in(area):
    image = area.spaces.active.image
    return image and image.name


def ended():
    return not module("blender.ui.long_work").LongWork.running


def quitted():
    """Ctrl+Q after a comparison ends Blender, which asks nothing that it would not after F12."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    window().scene.render.resolution_percentage = 20
    press_compare()
    yield from until(at_rest, 60)
    yield
    (OUT / "quitted.json").write_text(json.dumps({"verdict": result().content.verdict}))
    press("ctrl+q")
    yield from until(lambda: False, 60)


STORIES = (second_day, elsewhere, quitted)
SCENE = "exercise_perspective"

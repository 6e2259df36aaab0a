"""What a user, or a script, does while a comparison runs: nothing is lost, and nothing is left."""

import json
import subprocess
from pathlib import Path

import addon_utils
import bpy
from hands import close, windows
from story import (
    MODULE,
    OUT,
    compared,
    ended,
    module,
    noted,
    over_the_view,
    press_compare,
    result,
    running,
    settings,
    until,
    window,
)

FILE = "/project/out/gui/interrupted.blend"
UNSTEADY = "screens", "all_ids"  # that of a closed window is kept for a while; all, also images


def interruptions():
    """One after another, each on the sample scene opened anew."""
    for story in INTERRUPTIONS:
        yield from begun()
        before = state()
        found = noted[story.__name__] = {}
        try:
            yield from story(found)
        except Exception as error:  # of one: the others are played all the same
            found["error"] = f"{type(error).__name__}: {error}"
            continue
        yield
        found["running"] = still_running()
        if found.get("same_file", True):
            found["left"] = changed(before)
        if "stopped" in found:  # what ran through has shown that it works
            yield from again(found)


def begun():
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/suzanne.blend")
    yield
    window().scene.render.resolution_percentage = 20
    bpy.context.view_layer.update()
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message="begun")


def state():
    """All data by name, the settings, the handlers, and what the window shows."""
    data = {
        p.identifier: sorted(b.name_full for b in getattr(bpy.data, p.identifier))
        for p in bpy.data.bl_rna.properties
        if p.type == "COLLECTION" and p.identifier not in UNSTEADY
    }
    handlers = {
        name: sorted(getattr(h, "__qualname__", str(h)) for h in found)
        for name in dir(bpy.app.handlers)
        if isinstance(found := getattr(bpy.app.handlers, name), list)
    }
    return data | handlers | settings()


def changed(before):
    """What is other than it was, but for the pictures that a comparison leaves."""
    after = state()
    found = {k: (v, after[k]) for k, v in before.items() if v != after[k]}
    if "images" in found:
        first, then = found["images"]
        if not {n for n in {*first} ^ {*then} if not n.startswith("Reference Tracer ")}:
            del found["images"]
    return found


def again(found):
    """A comparison after all that works as ever."""
    window().scene.render.resolution_percentage = 10
    module("blender.ui.results").forget()
    press_compare()
    yield from until(compared, 60)
    found["again"] = result().content.verdict


def started():
    press_compare()
    yield 0.1
    assert running(), "it ended before anything could interrupt it"


def still_running():
    """What runs by Blender's list and by the add-on's own."""
    own = module("blender.ui.long_work").LongWork.running
    return [*running(), *([own] if own else [])]


def wake():
    """Move the pointer: Blender drops the handlers of what it ended with the next event."""
    x, y = over_the_view()
    for place in ((x, y), (x, "0"), (x, y)):
        subprocess.run(["xdotool", "mousemove", *place], check=True)


def undone(found):
    """Undo and redo."""
    window().scene.render.resolution_percentage = 50  # else it may end before the redo
    window().scene.objects["Suzanne"].location.x += 0.001
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message="moved")
    yield from started()
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo()
        yield
        assert running(), "it ended before the redo"
        bpy.ops.ed.redo()
    yield from until(ended, 60)
    yield
    window().scene.objects["Suzanne"].location.x -= 0.001
    window().scene.render.resolution_percentage = 20


def saved(found):
    """The file is saved; in it is nothing of the temporary scene."""
    yield from started()
    Path(FILE).unlink(missing_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=FILE, copy=True)
    yield from until(ended, 60)
    with bpy.data.libraries.load(FILE) as (there, _):
        found["saved"] = there.scenes


def loaded(found):
    """Another file, and the one that Blender starts with."""
    yield from started()
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/exercise_triangle.blend")
    yield
    first = not still_running()
    yield from started_large()
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    found["stopped"] = first and not still_running()
    found["same_file"] = False


def started_large():
    window().scene.render.resolution_percentage = 400
    yield from started()


def switched_off(found):
    """The add-on is switched off and on."""
    yield from started()
    off_and_on()
    wake()
    yield
    found["stopped"] = not still_running()


def off_and_on():
    addon_utils.disable(MODULE)
    addon_utils.enable(MODULE)


def closed_area(found):
    """The 3D view turns into another editor, and comes back."""
    area = next(a for a in window().screen.areas if a.type == "VIEW_3D")
    yield from started()
    area.type = "TEXT_EDITOR"
    yield
    area.type = "VIEW_3D"
    yield from until(ended, 60)


def closed_window(found):
    """The window that it was started in is closed; another is there."""
    with bpy.context.temp_override(window=window()):
        bpy.ops.wm.window_new()
    yield
    _, second = bpy.context.window_manager.windows
    with bpy.context.temp_override(window=second):
        bpy.ops.reference_tracer.compare("INVOKE_DEFAULT", True)
    yield
    _, of_comparison = windows()
    close(of_comparison)

    def one_is_left():
        return len(bpy.context.window_manager.windows) == 1

    yield from until(one_is_left, 20)
    yield
    found["stopped"] = not still_running()


def removed_scene(found):
    """The scene that is compared is removed; what is shown then is another."""
    scene = window().scene
    other = bpy.data.scenes.new("Other")
    yield from started()
    window().scene = other
    yield
    copy = scene.copy()
    copy.name = name = "Kept"
    bpy.data.scenes.remove(scene)
    yield from until(ended, 60)
    window().scene = bpy.data.scenes[name]
    bpy.data.scenes.remove(other)
    window().scene.name = "Scene"
    found["same_file"] = False


def rendered(found):
    """F12 while it runs."""
    window().scene.render.engine = "REFERENCE_TRACER"
    yield from started()
    done = []

    def told(*_):
        done.append(True)

    bpy.app.handlers.render_complete.append(told)
    with bpy.context.temp_override(window=window()):
        bpy.ops.render.render("INVOKE_DEFAULT")
    yield from until(lambda: done, 60)
    yield from until(ended, 60)
    bpy.app.handlers.render_complete.remove(told)
    found["same_file"] = False


def closed():
    """The last window is closed, which ends Blender: what is to be noted is written before."""
    yield from started_large()
    (OUT / "closed.json").write_text(json.dumps({"dirty": bpy.data.is_dirty}))
    close(windows()[-1])
    yield from until(lambda: False, 60)


INTERRUPTIONS = (
    undone,
    saved,
    loaded,
    switched_off,
    closed_area,
    closed_window,
    removed_scene,
    rendered,
)
SCENE = "suzanne"
STORIES = (interruptions, closed)

"""Measures in Blender's window, then quits: `blender --python window_child.py -- FOUND.json`.

Blender draws and handles events between the steps of a generator that a timer goes on with. This
runs in a whole Blender, which has the extension, and not the benchmark's package. What is found is
pairs of seconds by name, of CPU and of waiting: the first round of several is left out.
"""

import gc
import json
import math
import sys
import time
import traceback
from pathlib import Path

import bpy
from mathutils import Quaternion

MODULE = "bl_ext.user_default.reference_tracer.addon.blender"
LONGEST = 400  # seconds for what is waited for
TURN = Quaternion((0, 0, 1), math.radians(7))
found = {}


class Clock:
    """Seconds of CPU and of waiting since it was made."""

    def __init__(self):
        self.began = time.process_time(), time.perf_counter()

    def read(self):
        """Return both."""
        now = time.process_time(), time.perf_counter()
        return [b - a for a, b in zip(self.began, now, strict=True)]


def until(holds):
    """Wait; Blender goes on meanwhile."""
    clock = Clock()
    while not holds():
        if clock.read()[1] > LONGEST:
            raise TimeoutError(f"{holds.__name__}: {LONGEST} s")
        yield 0.002


def window():
    """Return the window."""
    return bpy.context.window_manager.windows[0]


def played():
    """Measure one thing after the other."""
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/suzanne.blend")
    yield 1.0
    if f"{MODULE}.live.view" in sys.modules:  # an extension of before has no live view
        yield from orbited()
    yield from compared()


def orbited():
    """Choose *Rendered*, turn the view, leave it: a few times."""
    first, coarse, whole = (
        found.setdefault(f"viewport, {what}", [])
        for what in ("the first picture", "a coarse one", "the whole after a move")
    )
    window().scene.render.engine = "REFERENCE_TRACER"
    area = next(a for a in window().screen.areas if a.type == "VIEW_3D")
    space = area.spaces.active
    for name in ("header", "tool_header", "toolbar", "ui", "hud", "asset_shelf"):
        setattr(space, f"show_region_{name}", False)
    for _ in range(4):
        space.shading.type, clock = "RENDERED", Clock()
        area.tag_redraw()
        yield from until(lambda: live() and live()[0].shown)
        first.append(clock.read())
        yield from until(rests)
        for _ in range(3):
            before = live()[0].shown
            space.region_3d.view_perspective = "PERSP"
            space.region_3d.view_rotation = TURN @ space.region_3d.view_rotation
            area.tag_redraw()
            clock = Clock()
            yield from until(lambda before=before: live()[0].shown is not before)
            coarse.append(clock.read())
            yield from until(rests)
            whole.append(clock.read())
        space.shading.type = "SOLID"
        area.tag_redraw()
        yield 0.5
    for times in (first, coarse, whole):
        times.pop(0)


def live():
    """Return the views in Rendered mode."""
    kind = sys.modules[f"{MODULE}.live.view"].LiveView
    return [o for o in gc.get_objects() if type(o) is kind]


def rests():
    """Return whether there is one, and nothing is left to do."""
    return live() and all(view.rests for view in live())


def compared():
    """Press *Trace and Compare*, at 1920 x 1080, twice."""
    render = window().scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = 1920, 1080, 100
    work = sys.modules[f"{MODULE}.ui.long_work"].LongWork
    times = []
    for _ in range(2):
        clock = Clock()
        with bpy.context.temp_override(window=window()):
            bpy.ops.reference_tracer.compare("INVOKE_DEFAULT")
        yield from until(lambda: not work.running)
        times.append(clock.read())
        yield 0.5
    found["Trace and Compare in the window"] = times[1:]


going = played()


def go():
    """Go on, and say when to come again; what was found until an error counts."""
    try:
        return next(going)
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    Path(sys.argv[-1]).write_text(json.dumps(found), encoding="utf-8")
    bpy.ops.wm.quit_blender()


bpy.app.timers.register(go, first_interval=2, persistent=True)

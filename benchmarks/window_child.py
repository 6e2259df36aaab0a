"""Measures in Blender's window, then quits: `blender --python window_child.py -- FOUND.json`.

Blender draws and handles events between the steps of a generator that a timer goes on with. This
runs in a whole Blender, which has the extension, and not the benchmark's package.
"""

import json
import sys
import time
import traceback
from pathlib import Path

import bpy

ROUNDS = 2
MODULE = "bl_ext.user_default.reference_tracer"
LONGEST = 400  # seconds for what is waited for
found = {}


def played():
    """Measure one thing after the other."""
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/suzanne.blend")
    yield 1.0
    yield from compared()


def compared():
    """Press *Trace and Compare*, at 1920 x 1080."""
    scene = bpy.context.window_manager.windows[0].scene
    scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
    scene.render.resolution_percentage = 100
    work = sys.modules[f"{MODULE}.addon.blender.long_work"].LongWork
    seconds = found["Trace and Compare in the window"] = []
    for _ in range(ROUNDS):
        began, cpu = time.monotonic(), time.process_time()
        with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
            bpy.ops.reference_tracer.compare("INVOKE_DEFAULT")
        yield 0.1
        while work.running and time.monotonic() < began + LONGEST:
            yield 0.05
        seconds.append(time.process_time() - cpu)
        print("round", seconds[-1], time.monotonic() - began, flush=True)
        yield 0.5
    seconds.pop(0)  # it warms up


going = played()


def go():
    """Go on, and say when to come again."""
    try:
        return next(going)
    except StopIteration:
        Path(sys.argv[-1]).write_text(json.dumps(found))
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


bpy.app.timers.register(go, first_interval=2, persistent=True)

"""How fast the 3D view in Rendered mode is, measured in Blender's own window.

In a whole Blender with a screen (`tools/whole_blender.sh run`), from the source as it is:

    blender --factory-startup --window-geometry 0 0 1100 700 \
        --python /project/tools/viewport_speed.py

Seconds from an action until a picture of it is drawn, by the wall's clock: with Blender's own part
of drawing, which is given besides (`solid`), and which a processor without a graphics card takes
most of it for. `own` are those that the main thread spends here until the whole picture is drawn;
`longest` the longest that the interface has waited for one step or drawing, both without what other
processes take.
"""

import importlib
import json
import statistics
import sys
import time
import traceback
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler

PROJECT = Path(__file__).parents[1]
sys.path.insert(0, str(PROJECT))

registration = importlib.import_module("addon.blender.registration")
LiveView = importlib.import_module("addon.blender.live.view").LiveView

MOVES = 5
FILE = str(PROJECT / "sample_scenes" / "suzanne.blend")
calls = []  # (name, begun, seconds, those of the main thread, whether coarse, whole is drawn)


def watched(name):
    """Have LiveView note each call of one of its methods."""
    method = getattr(LiveView, name)

    def noting(self, *arguments):
        wall, own = time.perf_counter(), time.thread_time()
        result = method(self, *arguments)
        right = self.shown and self.shown.wanted == self._wanted
        whole = bool(right and self.shown.factor == 1)
        took = time.perf_counter() - wall, time.thread_time() - own
        calls.append((name, wall, *took, bool(right) and name == "draw", whole and name == "draw"))
        return result

    setattr(LiveView, name, noting)


def measured():
    """Yield seconds to wait, until all is measured."""
    for scene in ("suzanne", "million"):
        bpy.ops.wm.open_mainfile(filepath=FILE)
        yield 1
        window = bpy.context.window_manager.windows[0]
        if scene == "million":
            for obj in [o for o in bpy.data.objects if o.type == "MESH"]:
                bpy.data.objects.remove(obj)
            window.scene.collection.objects.link(million())
        window.scene.render.engine = "REFERENCE_TRACER"
        area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
        with bpy.context.temp_override(window=window, area=area):
            bpy.ops.screen.screen_full_area(use_hide_panels=True)
        yield 1
        yield from in_scene(scene)
        print(scene, json.dumps(results[scene]), flush=True)


def million():
    """Make a heightfield of a million triangles."""
    n = 709
    x, y = np.meshgrid(np.linspace(-2, 2, n), np.linspace(-2, 2, n))
    at = np.stack((x, y, 0.2 * np.sin(5 * x) * np.cos(4 * y)), axis=-1).reshape(-1, 3)
    first = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).reshape(-1, 1)
    mesh = bpy.data.meshes.new("Million")
    mesh.from_pydata(at, [], first + np.array((0, 1, n + 1, n)))
    return bpy.data.objects.new("Million", mesh)


def in_scene(scene):
    """Measure a scene that is open."""
    area = bpy.context.window_manager.windows[0].screen.areas[0]
    region = next(r for r in area.regions if r.type == "WINDOW")
    space, found = area.spaces.active, {"region": [region.width, region.height]}
    results[scene] = found
    drawn = []
    handler = bpy.types.SpaceView3D.draw_handler_add(
        lambda: drawn.append(time.perf_counter()), (), "WINDOW", "POST_PIXEL"
    )
    solid = []
    for number in range(MOVES):
        begun = turned(space, number)
        yield 0.05
        solid.append(max(drawn) - begun)
    bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    found["solid"] = statistics.median(solid)
    begun = time.perf_counter()
    space.shading.type = "RENDERED"
    found["first"] = yield from waited(begun)
    moves = []
    for number in range(MOVES):
        moves.append((yield from waited(turned(space, number))))
    found["move"] = {k: statistics.median(m[k] for m in moves) for k in moves[0]}
    for number in range(MOVES):  # without a rest
        begun = turned(space, number)
        yield 0.03
    found["orbit"] = yield from waited(begun)
    found["longest"] = max(own for name, _, _, own, *_ in calls if name != "update")
    found["update"] = max(own for name, _, _, own, *_ in calls if name == "update")


def turned(space, number):
    """Turn the view; returns when."""
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_rotation = Euler((1.1, 0.1, number / 20)).to_quaternion()
    return time.perf_counter()


def waited(begun):
    """Wait until the whole picture is drawn; returns what that took since an action."""
    first = len(calls)
    while not any(whole for *_, whole in calls[first:]):
        if time.perf_counter() > begun + 60:
            raise TimeoutError(f"no picture after a minute; {calls[-3:]}")
        yield 0.005
    since = [c for c in calls if c[1] >= begun]
    ends = {
        name: min(c[1] + c[2] for c in since if c[at]) - begun
        for name, at in (("coarse", 4), ("whole", 5))
    }
    return ends | {"own": sum(c[3] for c in since)}


results, going = {}, measured()


def go():
    """Go on, and say when to come again."""
    try:
        return next(going)
    except StopIteration:
        pass
    except Exception:
        traceback.print_exc()
    bpy.ops.wm.quit_blender()


for name in ("draw", "tick", "update"):
    watched(name)
registration.register()
bpy.app.timers.register(go, first_interval=2, persistent=True)

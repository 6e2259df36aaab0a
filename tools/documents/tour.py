"""The tutorial, played inside Blender's real window: `blender --python tour.py -- FOLDER`.

Does what docs/tutorial.md tells a reader to do, and takes a screenshot of each step.
"""

import json
import math
import subprocess
import sys
import traceback
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, "/project/tests/gui")  # what the tests in the window share

from story import (
    by_rounds,
    compared,
    data_blocks,
    invoke,
    open_tab,
    press_compare,
    result,
    until,
    window,
)
from viewport import all_noted, settled

FOLDER = Path(sys.argv[sys.argv.index("--") + 1])
ON_THE_CUBE = 1085, 600  # a pixel in the middle of a large triangle
TURNS = 24  # pictures around Suzanne


def screenshot(name, of=None):
    """The whole window, or one editor in it."""
    cut = []
    if of:
        top = window().height - of.y - of.height
        cut = ["-crop", f"{of.width}x{of.height}+{of.x}+{top}", "+repage"]
    file = str(FOLDER / f"{name}.png")
    subprocess.run(["import", "-window", "root", *cut, file], check=True)


def area(kind):
    return next(a for a in window().screen.areas if a.type == kind)


def main_region(shown):
    return next(r for r in shown.regions if r.type == "WINDOW")


def tour():
    """Each step's name is its picture's."""
    yield from compare()
    shown = area("VIEW_3D")
    yield from page()
    yield from look(shown)
    yield from inspect(shown)
    yield from live(shown)
    yield from ray(shown)


def compare():
    scene = window().scene
    yield 1
    screenshot("empty")
    subprocess.run(["xdotool", "mousemove", "700", "870", "click", "1"], check=True)  # the splash
    yield 1
    turned = [math.radians(degrees) for degrees in (-23, 0, 52)]
    bpy.ops.mesh.primitive_monkey_add(location=(0.5, -2, 0.3), rotation=turned)
    bpy.ops.mesh.primitive_plane_add(size=9, location=(0, 0, -1))
    bpy.ops.object.select_all(action="DESELECT")
    area("VIEW_3D").spaces.active.region_3d.view_perspective = "CAMERA"
    scene.render.engine = "REFERENCE_TRACER"
    scene.display.shading.color_type = "RANDOM"
    area("PROPERTIES").spaces.active.context = "RENDER"
    yield 1
    screenshot("panel")
    before = data_blocks()["objects"]
    bpy.context.preferences.view.render_display_type = "NONE"  # step 3 shows it
    press_compare()
    yield from until(compared)
    yield 1
    assert data_blocks()["objects"] == before
    view = area("VIEW_3D")
    yield from open_tab(view)
    screenshot("compared", view)
    view.spaces.active.show_region_ui = False
    content = result().content
    x, y = content.metrics.largest_difference.pixel
    causes = content.causes
    figures = {"figure": float(causes.figure[y, x]), "allowed": float(causes.allowed[y, x])}
    (FOLDER / "comparison.json").write_text(json.dumps(content.to_dict() | {"largest": figures}))
    names = {"traced": "Traced", "blender": "Blender", "difference": "Causes"}
    images = {key: bpy.data.images[f"Reference Tracer {name}"] for key, name in names.items()}
    np.savez(
        FOLDER / "images.npz",
        **{k: np.array(v.pixels[:]).reshape(v.size[1], v.size[0], 4) for k, v in images.items()},
    )


def page():
    """The button, but for the browser, which is not in this window."""
    invoke("open_page", directory=str(FOLDER), open_browser=False)
    yield from until((FOLDER / "page.html").exists)
    yield 1


def look(shown):
    shown.type = "IMAGE_EDITOR"
    shown.spaces.active.image = bpy.data.images["Reference Tracer Traced"]
    yield 1
    with bpy.context.temp_override(window=window(), area=shown, region=main_region(shown)):
        bpy.ops.image.view_all(fit_view=True)
    yield 1
    screenshot("traced")


def inspect(shown):
    """Come near the pixel that differs most, and click on it."""
    x, y = result().content.metrics.largest_difference.pixel
    space, inside = shown.spaces.active, main_region(shown)
    space.image = bpy.data.images["Reference Tracer Causes"]
    yield from open_tab(shown)
    width, height = space.image.size

    def place(dx, dy):
        there = (x + 0.5 + dx) / width, (y + 0.5 + dy) / height
        return inside.view2d.view_to_region(*there, clip=False)

    (xmin, ymin), (xmax, ymax) = place(-24, -14), place(24, 14)
    with bpy.context.temp_override(window=window(), area=shown, region=inside):
        bpy.ops.image.view_zoom_border(xmin=xmin, xmax=xmax, ymin=ymin, ymax=ymax)
    yield 1
    invoke("inspect")
    u, v = place(0, 0)
    where = str(inside.x + u), str(window().height - 1 - inside.y - v)
    for action in (["mousemove", *where], ["mousedown", "1"], ["mouseup", "1"]):
        subprocess.run(["xdotool", *action], check=True)
        yield 0.3
    yield 1
    assert bpy.data.texts[0].lines[0].body.startswith(f"# The ray through pixel ({x}, {y})")
    screenshot("inspector", shown)
    subprocess.run(["xdotool", "key", "Escape"], check=True)
    yield 0.5


def live(shown):
    """In Rendered mode, by the textbook's test as printed."""
    all_noted()
    scene, view = window().scene, window().scene.view_settings
    stored, before = scene.reference_tracer, view.view_transform
    shown.type, view.view_transform = "VIEW_3D", "Standard"
    shown.spaces.active.show_region_ui = False
    shown.spaces.active.shading.type = "RENDERED"
    stored.show, stored.method, stored.precision = "WRONG", "textbook_literal", "float32"
    yield from settled()
    screenshot("live")
    shown.spaces.active.shading.type = "SOLID"
    yield from orbit(shown)
    for name in ("show", "method", "precision"):
        stored.property_unset(name)
    view.view_transform = before


def orbit(shown):
    """The same of Suzanne alone, seen from all sides: in a part of the area, for a while."""
    from mathutils import Euler, Vector

    (FOLDER / "orbit").mkdir()
    with bpy.context.temp_override(window=window(), area=shown, region=main_region(shown)):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.4)
    yield 0.5
    part = min((a for a in window().screen.areas if a.type == "VIEW_3D"), key=lambda a: a.width)
    space, view = part.spaces.active, part.spaces.active.region_3d
    suzanne = bpy.data.objects["Suzanne"]
    window().view_layer.objects.active = suzanne
    suzanne.select_set(True)
    with bpy.context.temp_override(window=window(), area=part, region=main_region(part)):
        bpy.ops.view3d.localview(frame_selected=False)
    suzanne.select_set(False)
    for name in ("header", "tool_header", "toolbar", "ui"):
        setattr(space, f"show_region_{name}", False)
    for name in ("floor", "axis_x", "axis_y", "cursor", "extras", "object_origins"):
        setattr(space.overlay, f"show_{name}", False)
    space.show_gizmo, space.shading.type = False, "RENDERED"
    view.view_perspective, view.view_distance = "PERSP", 4
    view.view_location = suzanne.location - Vector((0, 0, 0.5))  # the lower part is cut off
    for turn in range(TURNS):
        view.view_rotation = Euler((1.3, 0, 0.9 + 2 * math.pi * turn / TURNS)).to_quaternion()
        yield from settled()
        screenshot(f"orbit/{turn:02}", main_region(part))
    with bpy.context.temp_override(window=window(), area=part, region=main_region(part)):
        bpy.ops.screen.area_close()
    yield 1


def ray(shown):
    """As objects, looked at from aside."""
    from mathutils import Quaternion

    shown.type = "VIEW_3D"
    yield from open_tab(shown)
    x, y = ON_THE_CUBE
    with bpy.context.temp_override(window=window(), area=shown, region=main_region(shown)):
        bpy.ops.reference_tracer.explain("EXEC_DEFAULT", True, x=x, y=y, draw_ray=True)
    hit = next(o for o in bpy.data.objects if o.name.startswith("Hit"))
    view = shown.spaces.active.region_3d
    view.view_perspective = "PERSP"
    view.view_location, view.view_distance = hit.location, 5.5
    turned = Quaternion((0, 0, 1), 0.7) @ window().scene.camera.matrix_world.to_quaternion()
    view.view_rotation = turned
    yield 1
    screenshot("ray", shown)


def play(steps):
    def go():
        try:
            return next(steps)
        except StopIteration:
            pass
        except BaseException:
            (FOLDER / "error.txt").write_text(traceback.format_exc())
        bpy.ops.wm.quit_blender()
        return None

    bpy.app.timers.register(go, first_interval=2, persistent=True)


play(by_rounds(tour()))

"""The tutorial, played inside Blender's real window: `blender --python tour.py -- FOLDER`.

Does what docs/tutorial.md tells a reader to do, and takes a screenshot of each step.
"""

import json
import subprocess
import sys
import traceback
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, "/project/tests/gui")  # what the tests in the window share

from story import compared, data_blocks, press_compare, result, until, window

FOLDER = Path(sys.argv[sys.argv.index("--") + 1])


def screenshot(name):
    subprocess.run(["import", "-window", "root", str(FOLDER / f"{name}.png")], check=True)


def area(kind):
    return next(a for a in window().screen.areas if a.type == kind)


def tour():
    """Each step's name is its picture's."""
    scene = window().scene
    yield 1
    screenshot("empty")
    subprocess.run(["xdotool", "mousemove", "700", "870", "click", "1"], check=True)  # the splash
    yield 1
    bpy.ops.mesh.primitive_monkey_add(size=2, location=(0.5, -2, 0.3), rotation=(-0.4, 0, 0.9))
    bpy.ops.mesh.primitive_plane_add(size=9, location=(0, 0, -1))
    bpy.ops.object.select_all(action="DESELECT")
    area("VIEW_3D").spaces.active.region_3d.view_perspective = "CAMERA"
    scene.render.engine = "REFERENCE_TRACER"
    scene.display.shading.color_type = "RANDOM"
    area("PROPERTIES").spaces.active.context = "RENDER"
    yield 1
    screenshot("panel")
    before = data_blocks()["objects"]
    press_compare()
    yield from until(compared)
    yield 1
    assert data_blocks()["objects"] == before
    screenshot("compared")
    content = result().content
    (FOLDER / "comparison.json").write_text(json.dumps(content.to_dict()))
    names = "Traced", "Blender", "Difference"
    images = {name.lower(): bpy.data.images[f"Reference Tracer {name}"] for name in names}
    np.savez(
        FOLDER / "images.npz",
        **{k: np.array(v.pixels[:]).reshape(v.size[1], v.size[0], 4) for k, v in images.items()},
    )
    shown = area("VIEW_3D")
    shown.type = "IMAGE_EDITOR"
    shown.spaces.active.image = images["traced"]
    yield 1
    inside = next(r for r in shown.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=shown, region=inside):
        bpy.ops.image.view_all(fit_view=True)
    yield 1
    screenshot("traced")


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


play(tour())

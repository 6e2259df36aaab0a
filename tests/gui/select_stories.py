"""*Select What the Camera Sees*, found by F3, undone, and cancelled: see `play.py`."""

import subprocess

import bpy
from story import ended, invoke, noted, press, reports, running, screenshot, until, window


def searched(words):
    """Find a command by F3, as a user does, and run it until its end."""
    press("F3")
    yield 0.5
    subprocess.run(["xdotool", "type", words], check=True)
    yield 0.7
    screenshot(f"select_{words.replace(' ', '_')}")
    subprocess.run(["xdotool", "key", "Return"], check=True)
    yield
    yield from until(ended, 60)
    yield


def objects():
    return sorted(obj.name for obj in window().view_layer.objects if obj.select_get())


def selected():
    """Objects, undone; frames, cancelled."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    scene, cube = window().scene, bpy.data.objects["Cube"]
    scene.render.resolution_percentage = 20
    with bpy.context.temp_override(window=window()):
        bpy.ops.mesh.primitive_cube_add(size=0.5)
        bpy.context.object.name = "Within"
        cube.select_set(True)
        window().view_layer.objects.active = cube
        bpy.ops.ed.undo_push()
    noted["before"] = objects()
    yield from searched("camera does not see")
    noted["unseen"] = objects()
    press("ctrl+z")
    yield
    noted["undone"] = objects()
    yield from searched("select what the camera sees")
    noted["seen"] = objects()
    scene = window().scene
    invoke("select_seen", frames=True, hidden=True)
    yield from until(lambda: scene.frame_current > 2, 60)
    noted["running"] = running()
    press("Escape")
    yield from until(ended, 20)
    yield
    noted["cancelled"] = [scene.frame_current, objects(), len(bpy.data.scenes)]
    noted["reports"] = reports()


STORIES = (selected,)
SCENE = "exercise_perspective"

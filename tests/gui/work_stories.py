"""What is said while a comparison runs, and what is left of it: see `play.py`."""

import subprocess

import bpy
from evaluations import counted
from picture_stories import in_header
from seen_stories import at_rest, front
from story import (
    OUT,
    noted,
    press,
    press_compare,
    result,
    running,
    screenshot,
    show_panel,
    until,
    window,
)


def heavy():
    """What takes Blender seconds is said before, and done once; a plane beside it is no other."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    show_panel()
    yield from front()
    window().scene.render.resolution_percentage = 25
    cube = window().scene.objects["Cube"]
    cube.name = "Heavy"
    subdivision = cube.modifiers.new("Subdivision", "SUBSURF")
    subdivision.levels = 6
    cube.modifiers.new("Wireframe", "WIREFRAME")
    yield
    heard, stop = listened()
    with counted() as evaluations:
        press_compare()
        noted["said"] = [heard[-1], in_header()[1]]
        path = str(OUT / "heavy_announced.png")
        subprocess.Popen(["sh", "-c", f"sleep 1; import -window root {path}"])
        yield from until(at_rest)
    stop()
    noted["evaluations"] = evaluations
    noted["verdicts"] = {"AUTO": result().content.verdict}
    yield
    screenshot("heavy")
    with bpy.context.temp_override(window=window()):
        bpy.ops.mesh.primitive_plane_add(location=(0, 0, -2))
    window().scene.objects["Plane"].reference_tracer.infinite_plane = True
    yield from compared_anew()
    noted["verdicts"]["beside a plane"] = result().content.verdict


def compared_anew():
    before = result().content
    press_compare()
    yield from until(lambda: at_rest() and result().content is not before, 60)


def said():
    """What the status bar says, by workspace."""
    return [w.name for w in bpy.data.workspaces if status.get(w.name)]


status = {}  # what was said last in each workspace, else None


def listened():
    """Have noted what is said in the status bar, at once."""
    kind = type(window().workspace)
    real, heard = kind.status_text_set, []

    def noting_text(workspace, text):
        status[workspace.name] = text
        heard.append(text)
        real(workspace, text)

    kind.status_text_set = noting_text
    return heard, lambda: setattr(kind, "status_text_set", real)


def status_bar():
    """What is said while it runs, and what is left of it: at the end, by Esc, by an error."""
    scene = window().scene
    scene.render.resolution_percentage = 100
    heard, stop = listened()
    press_compare()
    noted["at_once"] = heard[-1]
    yield
    screenshot("status_drawing")
    yield from until(at_rest, 100)
    noted["heard"] = [text for text in heard if text]
    noted["left"] = said()
    press_compare()
    yield 0.5
    other = next(w for w in bpy.data.workspaces if w != window().workspace)
    window().workspace = other
    yield from until(lambda: other.name in said(), 10)
    noted["moved"] = said()
    press("Escape")
    yield
    noted["after_escape"] = [running(), said()]
    scene.camera.data.type = "PANO"
    press_compare()
    yield
    noted["after_error"] = [running(), said()]
    scene.camera.data.type = "PERSP"
    scene.render.resolution_percentage = 20
    other = next(w for w in bpy.data.workspaces if w != window().workspace)
    other.status_text_set("what another add-on says")
    press_compare()
    yield from until(at_rest, 60)
    noted["of_another"] = [said(), other.name]
    other.status_text_set(None)
    stop()


SCENE = "suzanne"
STORIES = (status_bar, heavy)

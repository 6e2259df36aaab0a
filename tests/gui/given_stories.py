"""An image that no judge of ours drew, judged by clicks."""

from contextlib import contextmanager

import bpy
from hands import COMPARE, click_on, properties
from story import (
    OUT,
    ended,
    noted,
    press,
    result,
    screenshot,
    show_panel,
    until,
    window,
)

SELECT, APPLY = "reference_tracer.select_object(", "reference_tracer.copy_camera("
SHOW, MAKE_ACTIVE = "reference_tracer.show_put_right(", "reference_tracer.activate_copy("


def at_the_panel(judge, percentage=25):
    scene = window().scene
    scene.render.engine = "REFERENCE_TRACER"  # its tab is short: our panel is in sight
    scene.render.resolution_percentage = percentage
    scene.reference_tracer.judge = judge
    show_panel()
    yield


@contextmanager
def made_wrong(owner, name, value):
    """Have the scene otherwise while a picture of it is made."""
    before = getattr(owner, name)
    setattr(owner, name, value)
    yield
    setattr(owner, name, before)


def picture(name):
    """Render the scene as it is now, with the engine that is chosen; return its image."""
    render = window().scene.render
    before = render.filepath
    with values_kept(render.image_settings, "file_format", "color_depth"):
        render.image_settings.file_format = "OPEN_EXR"
        render.image_settings.color_depth = "32"
        render.filepath = str(OUT / f"{name}.exr")
        bpy.ops.render.render(write_still=True)
        render.filepath = before
    return bpy.data.images.load(str(OUT / f"{name}.exr"))


@contextmanager
def values_kept(owner, *names):
    before = [getattr(owner, name) for name in names]
    yield
    for name, value in zip(names, before, strict=True):
        setattr(owner, name, value)


def judged(name):
    """Click on the button, wait for the end, and note what is said."""
    before = result()

    def another():
        return result() is not before

    yield from click_on(properties(), COMPARE)
    yield from until(another)
    yield from until(ended)
    yield 0.5  # Blender's panels slide to their new places, and hear no click meanwhile
    screenshot(name)
    found = result().content
    noted[name] = {
        "verdict": found.verdict,
        "unexplained": found.counts.unexplained,
        "told": [t.fault.name for t in found.diagnosis.told] if found.diagnosis else [],
    }
    noted[f"{name}_by"] = found.case.picture.sampling.renderer.name


def selected():
    return [o.name for o in window().view_layer.objects if o.select_get()]


def shown_images():
    """The names of the images that are open."""
    spaces = [a.spaces.active for a in window().screen.areas if a.type == "IMAGE_EDITOR"]
    return [space.image.name for space in spaces if space.image]


def given_image():
    """A moved object is selected and moved; a focal length is put right in a copy of the camera."""
    bpy.ops.wm.open_mainfile(filepath="/project/sample_scenes/exercise_perspective.blend")
    yield
    scene = window().scene
    for other in [o for o in scene.objects if o.name.startswith(("Column", "Ico", "Torus"))]:
        bpy.data.objects.remove(other)  # each would be looked for elsewhere, too
    yield from at_the_panel("IMAGE", 12)  # where it was moved is soon found
    moved = scene.objects["Cone"]
    with made_wrong(moved.location, "x", moved.location.x + 0.2):
        scene.reference_tracer.image = picture("moved")
    yield from judged("given_moved")
    yield from click_on(properties(), SELECT)
    noted["selected"] = selected()
    screenshot("given_selected")
    for key in ("g", "x", "0", "period", "2", "Return"):  # as the panel says
        press(key)
        yield
    yield from judged("given_moved_too")
    with made_wrong(scene.camera.data, "lens", scene.camera.data.lens * 1.05):
        scene.reference_tracer.image = picture("lens")
    yield from judged("given_lens")
    with values_kept(bpy.context.preferences.view, "render_display_type"):
        bpy.context.preferences.view.render_display_type = "AREA"  # in place of the 3D view
        yield from click_on(properties(), SHOW)
        yield from until(shown_images, 20)
    bpy.context.preferences.is_dirty = False
    noted["shown"] = shown_images()
    screenshot("given_shown_put_right")
    yield from click_on(properties(), APPLY)
    noted["copied"] = [selected(), scene.camera.name]
    yield from click_on(properties(), MAKE_ACTIVE)
    yield
    noted["camera"] = scene.camera.name
    screenshot("given_made_active")
    yield from judged("given_put_right")


SCENE = "suzanne"
STORIES = (given_image,)

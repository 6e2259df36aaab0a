"""The pictures of a comparison in the Image Editor, and what is said of them: see `play.py`."""

import subprocess

import bpy
import numpy as np
from drawn import scale
from hands import close, windows
from seen_stories import PROPERTIES, SIDEBAR, at_rest, drawn_anew, editor, front, pressed
from story import (
    OUT,
    module,
    noted,
    press_compare,
    result,
    screenshot,
    show_panel,
    until,
    window,
)


def colors_at(name, area, places):
    """The colours of a screenshot at places of an editor's image, 0 to 1, by rows."""
    region = next(r for r in area.regions if r.type == "WINDOW")
    screenshot(name)
    image = bpy.data.images.load(str(OUT / f"{name}.png"))
    width, height = image.size
    pixels = np.array(image.pixels[:]).reshape(height, width, 4)[..., :3]
    bpy.data.images.remove(image)
    at = module("blender.ui.split").place_of(region, 0)
    x = (region.x + at.left + places[:, 0] * (at.right - at.left)).astype(int)
    y = (region.y + at.bottom + places[:, 1] * (at.top - at.bottom)).astype(int)
    return pixels[y, x]


def compared_images():
    """The switch, the line between both pictures, dragged by hand, and the regions."""
    scene = window().scene
    scene.render.resolution_percentage = 50
    scene.display.shading.color_type = "RANDOM"
    yield from pressed("AREA")
    where, area = editor()
    region = next(r for r in area.regions if r.type == "WINDOW")
    yield from front("IMAGE_EDITOR")
    with bpy.context.temp_override(window=where, area=area, region=region):
        bpy.ops.image.view_zoom_ratio(ratio=1)
    other = bpy.data.images["Reference Tracer Blender"]
    pixels = np.array(other.pixels[:]).reshape(-1, 4)
    pixels[:, :3] = pixels[:, 1::-1].repeat(2, axis=1)[:, :3]  # so that it is seen whose they are
    other.pixels.foreach_set(pixels.astype(np.float32).ravel())
    other.update()
    places = np.random.default_rng(7).uniform((0.02, 0.02), (0.98, 0.85), (400, 2))  # names: above
    seen = {}
    for image in ("DIFFERENCE", "CAUSES", "TRACED", "OTHER", "BOTH"):
        with bpy.context.temp_override(window=where, area=area):
            bpy.ops.reference_tracer.show_image(image=image)
        yield
        seen[image] = colors_at(f"image_{image.lower()}", area, places)
    manager = bpy.context.window_manager.reference_tracer
    width, height = other.size
    x, y = (places * (width, height)).astype(int).T
    opaque = pixels.reshape(height, width, 4)[y, x, 3]
    far = (abs(places[:, 0] - manager.split) > 0.02) & (opaque == 1)
    left = far & (places[:, 0] < manager.split)
    right = far & ~left
    noted["both"] = {
        # The share of places that are other there, by more than rounding.
        "left": float((abs(seen["BOTH"] - seen["TRACED"])[left] > 0.03).any(axis=1).mean()),
        "right": float((abs(seen["BOTH"] - seen["OTHER"])[right] > 0.03).any(axis=1).mean()),
        "apart": float((abs(seen["TRACED"] - seen["OTHER"])[right] > 0.03).any(axis=1).mean()),
    }
    at = module("blender.ui.split").place_of(region, manager.split)
    y = where.height - 1 - region.y - int((at.bottom + at.top) / 2)
    x = int(region.x + at.line)
    for action in (
        ["mousemove", str(x), str(y)],
        ["mousedown", "1"],
        ["mousemove", str(x + 40), str(y)],
        ["mousemove", str(x + 96), str(y)],
        ["mouseup", "1"],
    ):
        subprocess.run(["xdotool", *action], check=True)
        yield
    noted["dragged"] = [manager.split, 0.5 + 96 / (at.right - at.left)]
    screenshot("image_dragged")
    regions = result().regions
    noted["regions"] = [[r.pixels, list(r.objects)] for r in regions]
    differ = result().content.counts.differ
    noted["differ"] = differ
    view = region.view2d
    with bpy.context.temp_override(window=window()):
        noted["framed"] = list(bpy.ops.reference_tracer.frame_region(number=0))
    yield
    screenshot("image_framed")
    low = view.region_to_view(0, 0)
    high = view.region_to_view(region.width, region.height)
    first = regions[0]
    noted["inside"] = [
        low[0] * width <= first.left,
        low[1] * height <= first.bottom,
        first.left + first.width <= high[0] * width,
        first.top + 1 <= high[1] * height,
    ]
    noted["across"] = [(high[0] - low[0]) * width, first.width]
    area.type = "VIEW_3D"
    views = area.spaces.active.region_3d
    views.view_perspective = "PERSP"
    before = views.view_location.copy()
    with bpy.context.temp_override(window=window()):
        bpy.ops.reference_tracer.select_object(name=first.objects[0])
    yield
    selected = [o.name for o in window().view_layer.objects if o.select_get()]
    noted["moved"] = [(views.view_location - before).length, selected]
    screenshot("view_framed")


class Heard(list):
    """A layout that keeps the texts that are drawn in it."""

    def label(self, text, **_):
        self.append(text)

    def progress(self, factor):
        self.append(factor)


def in_header():
    """What the header of the result says."""
    heard = Heard()
    with bpy.context.temp_override(window=window()):
        module("blender.ui.outcome").draw_in_header(heard, bpy.context)
    return heard


def is_marked(name, area, region):
    """Whether a screenshot has the cause's colour along the left side of a region's mark."""
    split = module("blender.ui.split")
    cause = module("causes.explain").BY_NUMBER[region.cause]
    color = module("files.images").curve(np.array(cause.color))
    inside = next(r for r in area.regions if r.type == "WINDOW")
    at = split.place_of(inside, 0)
    width, height = area.spaces.active.image.size
    left = (region.left / width) - scale() * split._AROUND / (at.right - at.left)
    pixel = 1 / (at.right - at.left)
    y = (region.bottom + 0.5) / height
    places = np.array([(left + k * pixel, y) for k in range(-2, 3)])
    return bool((abs(colors_at(name, area, places) - color).max(axis=1) < 0.1).any())


def first_result():
    """The scene that Blender starts with, as who has read nothing meets its result."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    show_panel()
    yield from front()
    window().scene.render.resolution_percentage = 50
    view = bpy.context.preferences.view
    view.render_display_type = "AREA"
    press_compare()
    noted["running"] = in_header()
    found = yield from drawn_anew(SIDEBAR)
    noted["panel"] = [(e["kind"], e["text"]) for e in found[SIDEBAR]["drawn"]]
    yield from until(at_rest)
    yield
    where, area = editor()
    noted["image"] = area.spaces.active.image.name
    noted["header"] = in_header()
    yield from front("IMAGE_EDITOR")
    first = result().regions[0]
    noted["texts"] = module("blender.ui.differing").texts_of(first)
    noted["region"] = [first.pixels, first.left, first.bottom]
    noted["marks"] = {}
    for image in ("TRACED", "DIFFERENCE", "CAUSES", "BOTH"):
        with bpy.context.temp_override(window=where, area=area):
            bpy.ops.reference_tracer.show_image(image=image)
        yield
        noted["marks"][image] = is_marked(f"first_{image.lower()}", area, first)
    inside = next(r for r in area.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=where, area=area, region=inside):
        bpy.ops.reference_tracer.explain(x=first.left, y=first.bottom, source="COMPARISON")
    found = yield from drawn_anew(PROPERTIES)
    noted["inspector"] = [e["text"] for e in found[PROPERTIES + "_inspector"]["drawn"]]
    screenshot("first_inspector")
    view.render_display_type = "NONE"


def tried():
    """Hair, a volume, a grease pencil; a light theme, a quad view, a narrow window."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    bpy.context.preferences.view.render_display_type = "WINDOW"
    light = bpy.utils.preset_paths("interface_theme")[0] + "/Blender_Light.xml"
    bpy.ops.script.execute_preset(filepath=light, menu_idname="USERPREF_MT_interface_theme_presets")
    scene = window().scene
    scene.render.resolution_percentage = 25
    cube = bpy.data.objects["Cube"]
    hair = cube.modifiers.new("Hair", "PARTICLE_SYSTEM").particle_system.settings
    hair.type = "HAIR"
    hair.count = 200
    hair.hair_length = 1.0
    smoke = bpy.data.objects.new("Smoke", bpy.data.volumes.new("Smoke"))
    scene.collection.objects.link(smoke)
    smoke.modifiers.new("Mesh to Volume", "MESH_TO_VOLUME").object = cube
    smoke.location.x = -3.0
    view = next(a for a in window().screen.areas if a.type == "VIEW_3D")
    inside = next(r for r in view.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=window(), area=view, region=inside):
        bpy.ops.object.grease_pencil_add(type="MONKEY", location=(2, -2, 0))
        bpy.ops.screen.region_quadview()
    yield from front()
    press_compare()
    yield from until(at_rest, 120)
    yield 2.0  # panels that grow are in place
    content = result().content
    noted["tried"] = [content.verdict, sorted({u.feature for u in content.manifest.unmodelled})]
    screenshot("session_tried")
    sidebar = next(r for r in view.regions if r.type == "UI")
    above = window().height - sidebar.y
    right = sidebar.x + sidebar.width
    noted["sidebar"] = [sidebar.x, above - sidebar.height, right, above]
    sidebar.tag_redraw()
    yield 0.5
    screenshot("session_tried_redrawn")
    if len(windows()) > 1:  # that of the result
        close(windows()[-1])
    yield 0.3
    bpy.ops.preferences.reset_default_theme()


SCENE = "suzanne"
STORIES = (first_result, compared_images, tried)

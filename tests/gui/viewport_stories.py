"""The 3D view in Rendered mode, in the real window: what it shows, and what may happen to it."""

import gc
from pathlib import Path

import addon_utils
import bpy
import numpy as np
from mathutils import Euler
from story import MODULE, OUT, data_blocks, module, noted, settings, until, window
from viewport import (
    alive,
    all_noted,
    apart,
    area,
    beside,
    in_mode,
    live,
    prepared,
    region,
    region_3d,
    screen,
    settled,
    space,
)

FILE = str(OUT / "rendered.blend")
TURNED = Euler((1.1, 0.1, 0.7)).to_quaternion()


def viewport_pixels():
    """Views of all kinds beside Blender's own solid drawing of them."""
    yield from prepared()
    for view in (frame, zoomed_border, parallel_camera, free, free_border, parallel):
        view()
        seen = yield from in_mode("RENDERED")
        camera = live()[0]._wanted.camera
        found = {"apart": apart(camera), "projection": camera.projection.name}
        solid = yield from in_mode("SOLID")
        noted[view.__name__] = found | beside(seen, solid, camera.region)


def frame():
    """Look through the camera, as the file has it."""
    assert region_3d().view_perspective == "CAMERA"


def zoomed_border():
    """Look through the camera from nearer, beside its middle, with a border and passepartout."""
    render, view, overlay = window().scene.render, region_3d(), space().overlay
    render.use_border = True
    render.border_min_x, render.border_max_x = 0.3, 0.9
    render.border_min_y, render.border_max_y = 0.2, 0.7
    view.view_camera_zoom, view.view_camera_offset = 12, (0.1, -0.05)
    overlay.show_overlays, overlay.show_text, overlay.show_floor = True, False, False
    for name in ("cursor", "axis_x", "axis_y", "extras", "relationship_lines", "outline_selected"):
        setattr(overlay, f"show_{name}", False)
    window().scene.camera.data.passepartout_alpha = 0.5


def parallel_camera():
    """Look through an orthographic camera with a shift, at pixels that are not square."""
    render, data = window().scene.render, window().scene.camera.data
    render.use_border = space().overlay.show_overlays = False
    data.type, data.ortho_scale, data.shift_x = "ORTHO", 9, 0.1
    render.pixel_aspect_y = 1.5


def free():
    """Look from somewhere else."""
    view = region_3d()
    view.view_perspective, view.view_rotation, view.view_distance = "PERSP", TURNED, 18
    space().clip_start = 0.1  # Blender's depth buffer is coarse beyond a nearer one


def free_border():
    """See a part of it."""
    space().use_render_border = True
    space().render_border_min_x, space().render_border_max_y = 0.4, 0.6


def parallel():
    """Look from there, orthographic."""
    space().use_render_border = False
    region_3d().view_perspective = "ORTHO"


def far():
    """See little of it: what is not explained takes long."""
    parallel()
    region_3d().view_distance = 50


def viewport_events():
    """One thing after another that a user does while the view is in Rendered mode."""
    yield from prepared()
    before = yield from in_mode("RENDERED")
    for story in EVENTS:
        noted[story.__name__] = found = {}
        yield from story(found)
        yield from settled()
        found["live"] = len(live())
        found["same"] = int((np.abs(screen("after") - before) > 1).any(axis=-1).sum())
    yield from in_mode("SOLID")
    gc.collect()
    noted["left"] = [alive("view.LiveView"), alive("view.Job"), alive("layers.Textures")]


def moved(found):
    """Orbit, and come back."""
    view = region_3d()
    matrix, factors = view.view_matrix.copy(), set()
    view.view_perspective = "PERSP"
    for turn in range(6):
        view.view_rotation = Euler((1.1, 0.1, turn / 20)).to_quaternion()
        yield 0.05
        factors |= {v.shown.factor for v in live() if v.shown}
    found["coarse"] = max(factors)
    yield from settled()
    found["whole"] = live()[0].shown.factor
    view.view_matrix, view.view_perspective = matrix, "CAMERA"


def undone(found):
    """Move an object, delete another, and undo both."""
    objects = window().scene.objects
    with bpy.context.temp_override(window=window()):
        bpy.ops.ed.undo_push(message="begun")
        objects["Suzanne"].location.x += 1
        bpy.ops.ed.undo_push(message="moved")
        bpy.data.objects.remove(objects["Sphere"])
        bpy.ops.ed.undo_push(message="removed")
    yield from settled()
    seen = screen("removed")
    for _ in range(2):
        with bpy.context.temp_override(window=window()):
            bpy.ops.ed.undo()
        yield 0.2
    yield from settled()
    found["changed"] = int((np.abs(screen("undone") - seen) > 1).any(axis=-1).sum())


def edited(found):
    """Go to Edit Mode, and back."""
    window().view_layer.objects.active = window().scene.objects["Suzanne"]
    for mode in ("EDIT", "OBJECT"):
        with bpy.context.temp_override(window=window(), area=area()):
            bpy.ops.object.mode_set(mode=mode)
        yield from settled()


def other_method(found):
    """Choose the textbook's test as printed: there are holes."""
    scene = window().scene.reference_tracer
    whole = screen("whole")
    scene.method = "textbook_literal"
    yield from settled()
    found["holes"] = int((np.abs(screen("literal") - whole) > 1).any(axis=-1).sum())
    scene.method = "auto"


def in_words(found):
    """Look through a camera that is not modelled, fail to draw, and have no camera at all."""
    camera, scene = window().scene.camera, window().scene
    camera.data.type = "PANO"
    yield from settled()
    found["said"] = live()[0].said
    found["white"] = int((screen("words") > 200).all(axis=-1).sum())  # small, so hardly pure white
    camera.data.type = "PERSP"
    textures = module("blender.live.layers").Textures
    upload, textures.upload = textures.upload, no_memory
    try:
        yield from settled()
        found["not_drawn"] = live()[0].said
    finally:
        textures.upload = upload
    scene.camera = None
    yield from settled()
    found["without"] = live()[0].said
    scene.camera = camera


def no_memory(*_):
    raise MemoryError("none on the card")


def two_views(found):
    """Split the area, and choose Rendered in both parts; close the smaller one."""
    with bpy.context.temp_override(window=window(), area=area(), region=region()):
        bpy.ops.screen.area_split(direction="HORIZONTAL", factor=0.8)
    both = [a for a in window().screen.areas if a.type == "VIEW_3D"]
    for one in both:
        one.spaces.active.shading.type = "RENDERED"
    yield from until(lambda: len(live()) == 2, 10)
    yield from settled()
    found["heights"] = sorted(v._wanted.camera.height for v in live())
    with bpy.context.temp_override(window=window(), area=min(both, key=lambda a: a.height)):
        bpy.ops.screen.area_close()


def four_views(found):
    """Show a quad view, and leave it."""
    for _ in range(2):
        with bpy.context.temp_override(window=window(), area=area(), region=region()):
            bpy.ops.screen.region_quadview()
        yield from settled()
        found.setdefault("views", len(live()))


def rendered(found):
    """Press F12 meanwhile."""
    window().scene.render.resolution_percentage = 10
    found["done"] = list(bpy.ops.render.render())
    window().scene.render.resolution_percentage = 100
    yield 0.1


def loaded(found):
    """Save the file, and open it again: Blender begins in Solid mode."""
    Path(FILE).unlink(missing_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=FILE, copy=True)
    bpy.ops.wm.open_mainfile(filepath=FILE)
    yield 0.3
    found["none"] = len(live())
    space().shading.type = "RENDERED"


def switched_off(found):
    """Switch the add-on off and on."""
    addon_utils.disable(MODULE)
    yield 0.3
    addon_utils.enable(MODULE)
    all_noted()
    yield 0.3


EVENTS = (
    moved,
    undone,
    edited,
    other_method,
    in_words,
    two_views,
    four_views,
    rendered,
    loaded,
    switched_off,
)


def viewport_shows():
    """What each method sees of a view, and how it differs from what Blender draws."""
    yield from prepared()
    stored, views = window().scene.reference_tracer, window().scene.view_settings
    views.view_transform = "Standard"
    space().shading.background_type = "VIEWPORT"  # which Blender draws in its solid shading alone
    yield from in_mode("RENDERED")
    before, drawn = (settings(), data_blocks()), counted_drawings()
    for number, (place, show, method) in enumerate(SHOWN):
        stored.show, stored.method = show, method
        if stored.has_precision:
            stored.precision = "float32"
        place()
        yield from settled()
        seen = screen(f"viewport_show_{number}_{show.lower()}")
        red = (np.abs(seen - (255, 0, 0)) <= 1).all(axis=-1)  # Blender dithers
        noted[f"{place.__name__} {show} {method}"] = {
            "line": live()[0].shown.picture.line,
            "red": int(red.sum()),
            "said": live()[0].said,
            "drawn": len(drawn),
        }
    yield 1.5
    noted["drawn"] = len(drawn)  # one for each that was asked for: none is why another is
    yield from with_hair(stored, drawn)
    stored.property_unset("show")
    after = settings(), data_blocks()
    noted["changed"] = {k: (before[0][k], v) for k, v in after[0].items() if before[0][k] != v}
    noted["new"] = {k: v for k, v in after[1].items() if v != before[1][k]}


def with_hair(stored, drawn):
    """Add what is not modelled, and change it, while the difference is shown."""
    stored.show = "DIFFERENCE"
    stored.property_unset("method")
    yield from settled()
    hairy, found = window().scene.objects["Suzanne"], {}
    for hair in (None, 0.5, 0.1):
        if hair is None:
            modifier = hairy.modifiers.new("Hair", "PARTICLE_SYSTEM")
            settings = modifier.particle_system.settings
            settings.type, settings.count = "HAIR", 50
        else:
            settings.hair_length = hair
        yield from settled()
        yield 0.5
        found[str(hair)] = [live()[0].shown.picture.line, len(drawn)]
    noted["hair"] = found
    window().scene.objects["Suzanne"].modifiers.remove(modifier)


def counted_drawings():
    """Return a list that gets an item with each drawing that a view asks Blender for."""
    ours = module("blender.drawing.drawings")
    drawn, draw = [], ours.picture

    def counting(*arguments):
        drawn.append(1)
        return draw(*arguments)

    ours.picture = counting
    return drawn


SHOWN = (
    (free, "WRONG", "textbook_literal"),
    (free, "WRONG", "auto"),
    (free, "DIFFERENCE", "auto"),
    (parallel, "DIFFERENCE", "auto"),
    (far, "DIFFERENCE", "textbook_literal"),
    (far, "CERTAINTY", "auto"),
)


SCENE = "suzanne"
STORIES = (viewport_shows, viewport_pixels, viewport_events)

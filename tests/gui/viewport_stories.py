"""The 3D view in Rendered mode, in the real window: what it shows, and what may happen to it."""

import gc
import subprocess
import weakref
from pathlib import Path

import addon_utils
import bpy
import numpy as np
from mathutils import Euler
from story import MODULE, OUT, data_blocks, module, noted, settings, until, window

SWITCHES, MOVES, FIRST = 6, 20, 2  # every day; until what is allocated once is
MORE_SWITCHES, MORE_MOVES = 200, 1000  # in the long tests
FILE = str(OUT / "rendered.blend")
TURNED = Euler((1.1, 0.1, 0.7)).to_quaternion()


def viewport_pixels():
    """Views of all kinds beside Blender's own solid drawing of them."""
    yield from prepared()
    preferences = bpy.context.preferences
    before, dirty = preferences.system.viewport_aa, preferences.is_dirty
    preferences.system.viewport_aa = "OFF"
    try:
        yield from all_beside()
    finally:
        preferences.system.viewport_aa, preferences.is_dirty = before, dirty


def all_beside():
    for view in (frame, zoomed_border, parallel_camera, free, free_border, parallel):
        view()
        seen = yield from in_mode("RENDERED")
        camera = live()[0].camera
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
    noted["left"] = [alive("view.LiveView"), alive("view.Job"), alive("drawing.Textures")]


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
    found["white"] = int((screen("words") == 255).all(axis=-1).sum())
    camera.data.type = "PERSP"
    textures = module("blender.live.drawing").Textures
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
    found["heights"] = sorted(v.camera.height for v in live())
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


def viewport_often():
    """Switch modes and move the view many times."""
    yield from often(SWITCHES, MOVES)


def viewport_more_often():
    """The same, more often."""
    yield from often(MORE_SWITCHES, MORE_MOVES)


def often(switches, moves):
    yield from prepared()
    for name, count, act in (("switches", switches, switched), ("moves", moves, turned)):
        for number in range(count + FIRST):
            if number == FIRST:
                before = memory()
            yield from act(number)
        yield from settled()
        noted[name] = memory() - before


def switched(number):
    space().shading.type = "SOLID"
    yield 0.02
    space().shading.type = "RENDERED"
    yield from until(lambda: live() and live()[0].shown, 60)


def turned(number):
    region_3d().view_perspective = "PERSP"
    region_3d().view_rotation = Euler((1.1, 0.1, number / 20)).to_quaternion()
    yield 0.02


def memory():
    """Of this process, in MiB."""
    gc.collect()
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 >> 20


def prepared():
    """Our engine, flat light, nothing over the picture, and a small view: less is to be drawn."""
    all_noted()
    window().scene.render.engine = "REFERENCE_TRACER"
    for shading in (window().scene.display.shading, space().shading):
        shading.light, shading.color_type = "FLAT", "MATERIAL"
        shading.show_object_outline = shading.show_cavity = False
    space().overlay.show_overlays = space().show_gizmo = False
    for name in ("header", "tool_header", "toolbar", "ui", "hud", "asset_shelf"):
        setattr(space(), f"show_region_{name}", False)
    with bpy.context.temp_override(window=window(), area=area(), region=region()):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.25)
    yield 0.05
    both = [a for a in window().screen.areas if a.type == "VIEW_3D"]
    max(both, key=lambda a: a.width).type = "TEXT_EDITOR"
    yield 0.05


def area():
    return next(a for a in window().screen.areas if a.type == "VIEW_3D")


def space():
    return area().spaces.active


def region():
    return next(r for r in area().regions if r.type == "WINDOW")


def region_3d():
    return space().region_3d


def live():
    """The views in Rendered mode that there are."""
    return list(module("blender.live.view").LiveView.all)


def all_noted():
    """Have each such view note itself, from now on: to look for them all the time takes long."""
    kind = module("blender.live.view").LiveView
    if not hasattr(kind, "all"):
        kind.all, begin = weakref.WeakSet(), kind.__init__

        def noting(self):
            kind.all.add(self)
            begin(self)

        kind.__init__ = noting


def alive(kind):
    """How many objects of a class of ours there are."""
    path, name = kind.split(".")
    kind = getattr(module(f"blender.live.{path}"), name)
    return sum(type(o) is kind for o in gc.get_objects())


def rests():
    views = live()
    return views and all(v.rests for v in views)


def in_mode(name):
    """Choose a mode of the view, wait for its picture, and return that, as the screen has it."""
    space().shading.type = name
    area().tag_redraw()
    yield 0.1
    if name == "RENDERED":
        yield from settled()
    return screen(f"viewport_{name.lower()}")


def settled():
    yield 0.05
    yield from until(rests, 60)
    yield 0.05


def screen(name):
    """The view on the screen, (h, w, 3) from 0 to 255, row 0 at the bottom; a file keeps it."""
    path, r = str(OUT / f"{name}.png"), region()
    bottom = window().height - r.y - r.height
    part = ["-crop", f"{r.width}x{r.height}+{r.x}+{bottom}", "+repage"]
    quick = ["-quality", "10"]  # of the default, a dithered picture takes seconds
    subprocess.run(["import", "-window", "root", *part, *quick, path], check=True)
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(r.width * r.height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return np.rint(255 * pixels.reshape(r.height, r.width, 4)[..., :3]).astype(int)


def apart(camera):
    """How far known points are, at most, from where Blender's own matrices have them, in pixels."""
    certificate, view = module("compare.certificate"), region_3d()
    points = certificate.known_points(camera)
    matrix = np.array(view.window_matrix, float) @ np.array(view.view_matrix, float)
    at = matrix @ np.vstack((points, np.ones(points.shape[1])))
    film = (at[:2] / at[3] + 1) / 2 * np.array([[camera.width], [camera.height]])
    return certificate.certify(camera, points, film).largest


def beside(seen, solid, region):
    """How many pixels of a region differ, and how many are not even as one beside them is."""
    inside = np.zeros(seen.shape[:2], bool)
    inside[region.y0 : region.y1, region.x0 : region.x1] = True
    y, x = np.nonzero(inside & (np.abs(seen - solid) > 1).any(axis=-1))
    own = np.pad(seen, ((1, 1), (1, 1), (0, 0)), "edge")
    steps = [own[y + j, x + i] for j, i in np.ndindex(3, 3)]
    nearest = np.abs(np.array(steps) - solid[y, x]).max(axis=-1).min(axis=0)
    shades = seen @ (1 << 16, 1 << 8, 1)
    # Of the background there are two shades, one by passepartout, each dithered.
    _, counts = np.unique((seen[~inside] // 8) @ (1 << 10, 1 << 5, 1), return_counts=True)
    return {
        "colors": len(np.unique(shades[inside])),
        "differ": len(y),
        "strange": int((nearest > 1).sum()),
        "outside": float(np.sort(counts)[-4:].sum() / max(1, counts.sum())),
    }


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
    stored.property_unset("show")
    after = settings(), data_blocks()
    noted["changed"] = {k: (before[0][k], v) for k, v in after[0].items() if before[0][k] != v}
    noted["new"] = {k: v for k, v in after[1].items() if v != before[1][k]}


def counted_drawings():
    """Return a list that gets an item with each drawing that a view asks Blender for."""
    ours = module("blender.live.like_for_like")
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
STORIES = (viewport_shows, viewport_pixels, viewport_events, viewport_often, viewport_more_often)

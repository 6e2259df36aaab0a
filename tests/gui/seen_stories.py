"""What a user sees before and after the button, played in Blender's window: see `play.py`."""

import subprocess

import bpy
import numpy as np
from drawn import cut, noting, scale
from evaluations import counted
from story import (
    OUT,
    compared,
    ended,
    module,
    noted,
    press,
    press_compare,
    resized,
    result,
    running,
    screenshot,
    show_panel,
    until,
    window,
)

PARTS = ("_inspector", "_trade", "_extremes", "_export")
SIDEBAR, PROPERTIES = "VIEW3D_PT_reference_tracer", "RENDER_PT_reference_tracer"


def at_rest():
    return compared() and ended()


def front(kind="VIEW_3D"):
    """Bring our tab of a sidebar to the front, and every area to be drawn."""
    for area in window().screen.areas:
        if area.type == kind:
            area.spaces.active.show_region_ui = True
            yield 0.3
            sidebar = next(r for r in area.regions if r.type == "UI")
            sidebar.active_panel_category = "Reference Tracer"
        area.tag_redraw()
    yield


def drawn_anew(kind):
    """Have a panel drawn with all that is folded; gives what it draws."""
    with noting(kind, [kind + part for part in PARTS]) as found:
        for area in window().screen.areas:
            area.tag_redraw()
        yield
    return found


def panel():
    """The panel of a new file, and after the button, at all sizes."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    show_panel()
    yield from front()
    scene, view = window().scene, bpy.context.preferences.view
    scene.render.resolution_percentage = 25
    found = yield from drawn_anew(SIDEBAR)
    noted["folded"] = found[SIDEBAR]["folded"]
    noted["new"] = [(e["kind"], e["text"]) for e in found[SIDEBAR]["drawn"]]
    yield
    screenshot("panel_new")
    press_compare()
    yield from until(at_rest)
    yield from front()
    screenshot("panel_compared")
    before = view.language, view.ui_scale, bpy.context.preferences.is_dirty
    noted["cut"] = {}
    size = window().width, window().height
    for name, shown, width, kind, language in (
        ("properties", 1, size[0], PROPERTIES, "en_US"),
        ("narrow_properties", 1, 1280, PROPERTIES, "en_US"),
        ("narrow_german", 1, 1280, PROPERTIES, "de_DE"),
        ("german", 1, 1280, SIDEBAR, "de_DE"),
        ("narrow", 1, 1280, SIDEBAR, "en_US"),
        ("narrow_large", 2, 1280, SIDEBAR, "en_US"),
    ):
        if window().width != width:
            yield from resized(width, 720)
        view.ui_scale = shown
        view.language = language
        yield
        found = yield from drawn_anew(kind)
        screenshot(f"panel_{name}")
        noted["cut"][name] = cut(found)
        noted["half"] = cut(found, 0.5)
        noted.setdefault("drawn", {})[name] = [len(found[kind]["drawn"]), round(scale(), 2)]
    drawn = [e for p in found.values() for e in p.get("drawn", ())]
    icons = [e["icon"] for e in drawn if e["kind"] == "button" and e["text"]]
    noted["icons"] = [i for i in icons if i != "NONE"]
    view.language, view.ui_scale, bpy.context.preferences.is_dirty = before
    yield from resized(*size)


def editor():
    """The first Image Editor, with its window."""
    for each in bpy.context.window_manager.windows:
        for area in each.screen.areas:
            if area.type == "IMAGE_EDITOR":
                return each, area
    return None, None


def opened():
    """What is open: the editors of each window, and the image that the first Image Editor shows."""
    areas = [sorted(a.type for a in w.screen.areas) for w in bpy.context.window_manager.windows]
    _, area = editor()
    return areas, area and area.spaces.active.image.name


def pressed(mode):
    """Press the button with a preference for where renders are shown."""
    view = bpy.context.preferences.view
    before = view.render_display_type, bpy.context.preferences.is_dirty
    view.render_display_type = mode
    press_compare()
    yield from until(at_rest, 60)
    yield
    view.render_display_type, bpy.context.preferences.is_dirty = before


def shown():
    """Where the button shows its result, for each choice of where F12 shows its own; Esc; again."""
    window().scene.render.resolution_percentage = 20
    before = opened()[0]
    for mode in ("NONE", "AREA", "SCREEN"):
        yield from pressed(mode)
        once = opened()
        yield from pressed(mode)
        found = noted[mode] = {"once": once, "again": opened() == once}
        screenshot(f"shown_{mode.lower()}")
        where, area = editor()
        if area:
            x, y = area.x + area.width // 4, where.height - area.y - area.height // 4
            keys = ["mousemove", str(x), str(y), "key", "Escape"]
            subprocess.run(["xdotool", *keys], check=True)
            yield
        found["back"] = opened()[0] == before
    noted["images"] = sorted(i.name for i in bpy.data.images)
    with bpy.context.temp_override(window=window()):
        bpy.ops.reference_tracer.compare("EXEC_DEFAULT")  # as a script calls it
    yield
    noted["by_script"] = opened()[0] == before
    yield from pressed("WINDOW")
    noted["WINDOW"] = opened()
    screenshot("shown_window")
    where, area = editor()
    with bpy.context.temp_override(window=where):
        bpy.ops.wm.window_close()
    yield


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
    system = bpy.context.preferences.system
    limit, is_dirty = system.gl_texture_limit, bpy.context.preferences.is_dirty
    system.gl_texture_limit = "CLAMP_256"  # of textures: a coarse picture, at the same place
    yield
    seen["COARSE"] = colors_at("image_coarse", area, places)
    noted["coarse"] = float((abs(seen["COARSE"] - seen["OTHER"])[right] > 0.1).any(axis=1).mean())
    system.gl_texture_limit, bpy.context.preferences.is_dirty = limit, is_dirty
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
    noted["moved"] = []
    ops = bpy.ops.reference_tracer
    shows = {"name": regions[0].objects[0]}
    for operator, options in ((ops.frame_region, {"number": 0}), (ops.select_object, shows)):
        with bpy.context.temp_override(window=window()):
            operator(**options)
        yield
        selected = [o.name for o in window().view_layer.objects if o.select_get()]
        noted["moved"].append([(views.view_location - before).length, selected])
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


# Those that draw in constant colours here: EEVEE from 5.0 on.
ENGINES = ("WORKBENCH", "CYCLES", *(("EEVEE",) if bpy.app.version >= (5, 0) else ()))


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
    noted["evaluations"] = {"AUTO": evaluations}
    noted["verdicts"] = {"AUTO": result().content.verdict}
    yield
    screenshot("heavy")
    subdivision.levels = 1
    subdivision.render_levels = 3
    stored = window().scene.reference_tracer
    for engine in ENGINES:
        stored.judge = engine
        with counted() as evaluations:
            yield from compared_anew()
        noted["evaluations"][engine] = evaluations
        noted["verdicts"][engine] = result().content.verdict
    stored.judge = "AUTO"
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


def after_a_render():
    """The button where the editor of F12 is still open."""
    window().scene.render.engine = "BLENDER_WORKBENCH"
    window().scene.render.resolution_percentage = 20
    view = bpy.context.preferences.view
    before = view.render_display_type, bpy.context.preferences.is_dirty
    for mode in ("AREA", "SCREEN"):
        view.render_display_type = mode
        with bpy.context.temp_override(window=window()):
            bpy.ops.render.render("INVOKE_DEFAULT")
        yield from until(lambda: editor()[1] and not bpy.app.is_job_running("RENDER"), 60)
        yield
        rendered = opened()
        yield from pressed(mode)
        noted[mode] = rendered, opened()
        where, area = editor()
        if area:
            x, y = area.x + area.width // 4, where.height - area.y - area.height // 4
            keys = ["mousemove", str(x), str(y), "key", "Escape"]
            subprocess.run(["xdotool", *keys], check=True)
            yield
    view.render_display_type, bpy.context.preferences.is_dirty = before


def sample():
    """Open a sample scene as the menu does: as a new file, and not over unsaved changes."""
    files = module("blender.ui.samples").scenes()
    noted["files"] = [f.name for f in files]
    area = window().screen.areas[0]
    with bpy.context.temp_override(window=window(), area=area):
        bpy.ops.wm.call_menu(name="TOPBAR_MT_file_new")
    yield
    screenshot("file_new")
    press("Escape")
    yield
    scene = next(f for f in files if f.name == "exercise_triangle.blend")

    def choose():
        with bpy.context.temp_override(window=window()):
            bpy.ops.wm.read_homefile("INVOKE_DEFAULT", filepath=str(scene))

    bpy.ops.mesh.primitive_cube_add()
    bpy.ops.ed.undo_push(message="Add")
    noted["dirty"] = bpy.data.is_dirty
    choose()
    yield
    screenshot("unsaved")
    noted["kept"] = [window().scene.name, bpy.data.filepath != ""]
    press("Escape")
    yield
    bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    yield
    choose()
    yield
    noted["opened"] = [window().scene.name, bpy.data.filepath]
    screenshot("sample")


SCENE = "suzanne"
STORIES = (
    panel,
    first_result,
    shown,
    after_a_render,
    compared_images,
    status_bar,
    heavy,
    sample,
)

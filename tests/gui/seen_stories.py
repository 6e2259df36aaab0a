"""The panel before and after the button, and where its result opens: see `play.py`."""

import subprocess

import bpy
from drawn import cut, noting, scale
from story import (
    compared,
    ended,
    noted,
    press_compare,
    resized,
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


SCENE = "suzanne"
STORIES = (panel, shown, after_a_render)

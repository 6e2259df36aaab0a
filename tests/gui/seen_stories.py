"""What a user sees before and after the button, played in Blender's window: see `play.py`."""

import subprocess

import bpy
from drawn import cut, noting, scale
from story import (
    compared,
    noted,
    press_compare,
    running,
    screenshot,
    show_panel,
    until,
    window,
)

PARTS = ("_inspector", "_trade", "_extremes", "_export")
SIDEBAR, PROPERTIES = "VIEW3D_PT_reference_tracer", "RENDER_PT_reference_tracer"


def at_rest():
    return compared() and not running()


def front(kind="VIEW_3D"):
    """Bring our tab of a sidebar to the front, and every area to be drawn."""
    for area in window().screen.areas:
        if area.type == kind:
            area.spaces.active.show_region_ui = True
            yield 0.3
            sidebar = next(r for r in area.regions if r.type == "UI")
            sidebar.active_panel_category = "Reference Tracer"
        area.tag_redraw()
    yield 0.5


def drawn_anew(kind):
    """Have a panel drawn with all that is folded; gives what it draws."""
    with noting(kind, [kind + part for part in PARTS]) as found:
        for area in window().screen.areas:
            area.tag_redraw()
        yield 0.7
    return found


def resized(width, height):
    """Make the window so large, as a hand would."""
    names = subprocess.run(
        ["xdotool", "search", "--onlyvisible", "--name", "Blender"], capture_output=True, text=True
    )
    for name in names.stdout.split():
        subprocess.run(["xdotool", "windowsize", name, str(width), str(height)], check=True)

    def it_is():
        return window().width == width

    yield from until(it_is, 20)
    yield 0.5


def panel():
    """The panel of a new file, and after the button, at all sizes."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield 0.5
    show_panel()
    yield from front()
    scene, view = window().scene, bpy.context.preferences.view
    scene.render.resolution_percentage = 25
    found = yield from drawn_anew(SIDEBAR)
    noted["folded"] = found[SIDEBAR]["folded"]
    noted["new"] = [(e["kind"], e["text"]) for e in found[SIDEBAR]["drawn"]]
    yield 0.3
    screenshot("panel_new")
    press_compare()
    yield from until(at_rest)
    yield from front()
    screenshot("panel_compared")
    before = view.ui_scale, bpy.context.preferences.is_dirty
    noted["cut"] = {}
    size = window().width, window().height
    for name, shown, width, kind in (
        ("properties", 1, size[0], PROPERTIES),
        ("sidebar", 1, size[0], SIDEBAR),
        ("large", 2, size[0], SIDEBAR),
        ("narrow", 1, 1280, SIDEBAR),
        ("narrow_large", 2, 1280, SIDEBAR),
    ):
        if window().width != width:
            yield from resized(width, 720)
        view.ui_scale = shown
        yield 0.3
        found = yield from drawn_anew(kind)
        screenshot(f"panel_{name}")
        noted["cut"][name] = cut(found)
        noted["half"] = cut(found, 0.5)
        noted.setdefault("drawn", {})[name] = [len(found[kind]["drawn"]), round(scale(), 2)]
    icons = [e["icon"] for p in found.values() for e in p.get("drawn", ()) if e["kind"] == "button"]
    noted["icons"] = [i for i in icons if i != "NONE"]
    view.ui_scale, bpy.context.preferences.is_dirty = before
    yield from resized(*size)


SCENE = "suzanne"
STORIES = (panel,)

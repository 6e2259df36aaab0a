"""What stories share: the window, the keyboard, waiting, and what must stay as it was."""

import hashlib
import importlib
import os
import subprocess
import time
from pathlib import Path

import bpy

OUT = Path("/project/out/gui")
OPENED = OUT / "opened"  # what the browser was asked to open
MODULE = "bl_ext.user_default.reference_tracer"
SIDEBAR_TAB = "Reference Tracer"
# Blender's timers come before the events that it has just received, and the drawing after those.
ROUNDS = 3
# By their numbers: by its name, newer tools press Alt with the one, and Shift with the other.
KEYS = {"F3": "69", "F12": "96", "Numpad 0": "90"}
noted = {}  # what the story that is played has found; see play.py


def window():
    return bpy.context.window_manager.windows[0]


def resized(width, height):
    """Make the window so large, as a hand would."""
    if (window().width, window().height) == (width, height):
        return
    names = subprocess.run(
        ["xdotool", "search", "--onlyvisible", "--name", "Blender"], capture_output=True, text=True
    )
    for name in names.stdout.split():
        subprocess.run(["xdotool", "windowsize", name, str(width), str(height)], check=True)

    def it_is():
        return window().width == width

    yield from until(it_is, 20)
    yield


def scaled(pixels):
    """Return so many pixels of a window whose scale is 1, in this one."""
    return round(pixels * bpy.context.preferences.view.ui_scale)


def over_the_view():
    """Return a place on the screen that is over the 3D view, as text."""
    return str(scaled(500)), str(scaled(350))


def press(key):
    """Press a key as a keyboard does, with the pointer over the 3D view."""
    key = KEYS.get(key, key)
    subprocess.run(["xdotool", "mousemove", *over_the_view(), "key", key], check=True)


def screenshot(name, area=None):
    """Write what the window shows, or an area of it, or the screen if it has more, into a PNG.

    An area is left, top, width and height, in pixels.
    """
    first, *others = bpy.context.window_manager.windows
    left, top, width, height = area or (0, 0, first.width, first.height)
    part = [] if others else ["-crop", f"{width}x{height}+{left}+{top}", "+repage"]
    quick = ["-quality", "10"]  # by the default, it takes up to seconds
    path = str(OUT / f"{name}.png")
    subprocess.run(["import", "-window", "root", *part, *quick, path], check=True)


def data_blocks():
    return {
        name: sorted(x.name_full for x in getattr(bpy.data, name))
        for name in (
            "scenes",
            "objects",
            "meshes",
            "materials",
            "images",
            "collections",
            "worlds",
            "node_groups",
        )
    }


def settings():
    """Everything of the user's that a comparison could have touched."""
    scene, preferences = window().scene, bpy.context.preferences
    out = {
        "scene": scene.name,
        "view_layer": window().view_layer.name,
        "viewport_aa": preferences.system.viewport_aa,
        "dirty": preferences.is_dirty,
    }
    shading = [a.spaces.active.shading for a in window().screen.areas if a.type == "VIEW_3D"]
    for name, owner in (
        ("render", scene.render),
        ("display", scene.display),
        ("shading", scene.display.shading),
        ("view", scene.view_settings),
        ("image", scene.render.image_settings),
        *((f"3d{k}", s) for k, s in enumerate(shading)),
    ):
        for prop in owner.bl_rna.properties:
            if prop.type in ("BOOLEAN", "INT", "FLOAT", "ENUM", "STRING"):
                value = getattr(owner, prop.identifier)
                out[f"{name}.{prop.identifier}"] = repr(
                    list(value) if getattr(prop, "is_array", False) else value
                )
    return out


def render_result():
    """A digest of the user's last render, read through a file as a user would save it."""
    image = bpy.data.images.get("Render Result")
    if image is None:
        return None
    path = OUT / "render_result.png"
    path.unlink(missing_ok=True)
    image.save_render(str(path), scene=window().scene)
    return hashlib.sha256(path.read_bytes()).hexdigest()


def by_rounds(going):
    """Yield the seconds until a story goes on: none, for each round of Blender's main loop."""
    for seconds in going:
        yield from [0] * ROUNDS if seconds is None else [seconds]


def until(condition, seconds=300):
    """Wait for something; an error if it does not come."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(condition.__name__)
        yield 0.05


def with_browser():
    """Have whatever opens a page write its address down: see `opened`.

    Python asks for the browser once a process, so all stories have the same.
    """
    browser = OUT / "browser"
    browser.write_text(f'#!/bin/sh\necho "$1" > {OPENED}\n')
    browser.chmod(0o755)
    os.environ["BROWSER"] = str(browser)
    OPENED.unlink(missing_ok=True)


def opened():
    """Return the address that the browser was asked to open, if it was."""
    return OPENED.exists() and OPENED.read_text().strip()


def reports():
    """What the Info editor lists."""
    area = window().screen.areas[0]
    area.type = "INFO"
    with bpy.context.temp_override(window=window(), area=area, region=area.regions[-1]):
        bpy.ops.info.select_all(action="SELECT")
        bpy.ops.info.report_copy()
    return bpy.context.window_manager.clipboard


def module(name):
    """A module of the installed extension, which imports most of its own late."""
    return importlib.import_module(f"{MODULE}.addon.{name}")


def result(kind="COMPARISON"):
    """The latest result of a kind, if there is one."""
    results = module("blender.ui.results")
    found = results.latest(results.Kind[kind], window().scene)
    return None if found.content is None else found


def compared():
    return result() is not None


def invoke(name, **options):
    """Press the button of an operator; undo is as for a button, which a script's call is not."""
    with bpy.context.temp_override(window=window()):
        return getattr(bpy.ops.reference_tracer, name)("INVOKE_DEFAULT", True, **options)


def press_compare():
    return invoke("compare")


def running():
    """Our operators that are."""
    return [
        o.bl_idname for o in window().modal_operators if "reference_tracer" in o.bl_idname.lower()
    ]


def ended():
    return not running()


def open_tab(area=None):
    """Bring our tab of an editor's sidebar to the front, of the 3D view's by default."""
    area = area or next(a for a in window().screen.areas if a.type == "VIEW_3D")
    area.spaces.active.show_region_ui = True
    yield 0.3  # it slides in
    next(r for r in area.regions if r.type == "UI").active_panel_category = SIDEBAR_TAB
    area.tag_redraw()
    yield


def show_panel():
    for area in window().screen.areas:
        if area.type == "VIEW_3D":
            area.spaces.active.show_region_ui = True
        if area.type == "PROPERTIES":
            area.spaces.active.context = "RENDER"

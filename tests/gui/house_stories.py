"""The add-on in Blender's own menus and presets, played in Blender's window: see `play.py`."""

import ctypes
import sys

import bpy
from story import module, noted, press, screenshot, show_panel, window

MENUS = {
    "TOPBAR_MT_render": "PROPERTIES",  # and the editor that it is opened over
    "IMAGE_MT_image": "IMAGE_EDITOR",
    "TOPBAR_MT_file_export": "PROPERTIES",
}
PRESETS = "REFERENCE_TRACER_PT_presets"
PANEL = "RENDER_PT_reference_tracer"
WORDS = {
    ("Operator", "Trace and Compare"): "Trazar y comparar",
    ("*", "More Comparisons"): "Otras comparaciones",
    ("*", "{} differ, {} open"): "{} distintos, {} sin causa",
}

introspecting = []


def held(event, _):
    """Hold the namespace in which introspect() evaluates its text, as Blender frees it twice.

    Since Python 3.14 it would end with a segmentation fault, at once or later.
    """
    if introspecting and event == "exec":
        namespace = vars(sys.modules["__main__"])
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(namespace))


sys.addaudithook(held)


def drawn(kind):
    """Have the texts noted that a panel or menu draws, whenever it does; gives what does it."""

    def note(self, context):
        introspecting.append(kind)
        noted.setdefault("drawn", {})[kind] = str(self.layout.introspect())
        introspecting.clear()

    getattr(bpy.types, kind).append(note)
    return note


def over(kind):
    """Act as if the pointer were over an editor."""
    area = next(a for a in window().screen.areas if a.type == kind)
    return bpy.context.temp_override(window=window(), area=area, region=area.regions[-1])


def house():
    """Menus, the panel in another language and at twice the size, a preset, Material Preview."""
    scene, view = window().scene, bpy.context.preferences.view
    notes = {kind: drawn(kind) for kind in (*MENUS, PANEL, PRESETS)}
    before = view.ui_scale, view.language, bpy.context.preferences.is_dirty
    scene.render.engine = "REFERENCE_TRACER"
    show_panel()
    timeline = next(a for a in window().screen.areas if a.type == "DOPESHEET_EDITOR")
    timeline.type = "IMAGE_EDITOR"
    yield
    for menu, editor in MENUS.items():
        with over(editor):
            bpy.ops.wm.call_menu(name=menu)
        yield
        screenshot(menu)
        press("Escape")
        yield
    with over("PROPERTIES"):
        bpy.ops.wm.call_panel(name=PRESETS)
    yield
    screenshot("presets")
    press("Escape")
    noted["english"] = noted.pop("drawn")
    [folder] = bpy.utils.preset_paths("reference_tracer")
    bpy.ops.script.execute_preset(filepath=f"{folder}/Fast_look.xml", menu_idname=PRESETS)
    stored = scene.reference_tracer
    noted["preset"] = {name: getattr(stored, name) for name in stored.keys()}
    bpy.app.translations.register("story", {"es": WORDS})
    view.language = "es"
    yield
    noted["spanish"] = noted.pop("drawn")
    noted["formatted"] = module("blender.ui.panels").iface_("{} differ, {} open")
    view.language = before[1]
    bpy.app.translations.unregister("story")
    view.ui_scale = 2 * before[0]
    with over("PROPERTIES"):
        bpy.ops.screen.screen_full_area()
    yield
    screenshot("twice_the_size")
    with over("PROPERTIES"):
        bpy.ops.screen.screen_full_area()
    view.ui_scale, bpy.context.preferences.is_dirty = before[0], before[2]
    yield
    for area in window().screen.areas:
        if area.type == "VIEW_3D":
            shading = area.spaces.active.shading
            shading.type = "MATERIAL"  # refused where there is none
            noted["shading"] = shading.type
            shading.type = "SOLID"  # before it is drawn: EEVEE's shaders take a minute in software
    for kind, note in notes.items():
        getattr(bpy.types, kind).remove(note)


SCENE = "exercise_triangle"
STORIES = (house,)

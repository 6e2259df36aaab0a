"""A scene with what draws itself, in a light theme and a quad view; and Ctrl+Q after a result."""

import json

import bpy
from hands import close, windows
from seen_stories import at_rest, front
from story import (
    OUT,
    noted,
    press,
    press_compare,
    result,
    screenshot,
    until,
    window,
)


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


def quitted():
    """Ctrl+Q after a comparison ends Blender, which asks nothing that it would not after F12."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    yield
    window().scene.render.resolution_percentage = 20
    press_compare()
    yield from until(at_rest, 60)
    yield
    (OUT / "quitted.json").write_text(json.dumps({"verdict": result().content.verdict}))
    press("ctrl+q")
    yield from until(lambda: False, 60)


STORIES = (tried, quitted)
SCENE = "exercise_perspective"

"""A comparison leaves the user's scene, preferences, Render Result and data as they were."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
import reference_tracer
from reference_tracer.blender.drawing import drawings
from reference_tracer.blender.jobs import compare as compare_module
from reference_tracer.blender.ui.blocks import BLENDER, CAUSES, DIFFERENCE, TRACED

from .scenes import save

OURS = {TRACED, BLENDER, DIFFERENCE, CAUSES}
# 4.2 itself counts a scene's collections once more for every copy of it that comes and goes.
COUNTS_USERS = bpy.app.version >= (4, 3, 0)
# What Blender counts or draws for itself, or what leads back to where one came from.
_NOT_STATE = {
    "rna_type",
    "id_data",
    "is_evaluated",
    "session_uid",
    "original",
    "users",
    "tag",
    "bl_rna",
    "stereo_3d_format",
    "views",
    "depsgraph",
    "preview",
    "is_dirty",
    "use_extra_user",
    "is_embedded_data",
    "users_pass",
    # reading its brush crashes 4.2
    "uv_sculpt",
    # found out by the first render of a process
    "gpu_preferred_device",
    "selected_studio_light",
}


def snapshot(thing, depth: int = 4):
    """Return all RNA properties of a thing as plain values, those it owns recursively."""
    out = {}
    for prop in thing.bl_rna.properties:
        name = prop.identifier
        if name in _NOT_STATE:
            continue
        try:
            value = getattr(thing, name)
        except (AttributeError, RuntimeError):
            continue
        if prop.type == "POINTER":
            if value is None or isinstance(value, bpy.types.ID):
                out[name] = value and (value.name_full, value.as_pointer())
            elif depth:
                out[name] = snapshot(value, depth - 1)
        elif prop.type == "COLLECTION":
            out[name] = [item.name if hasattr(item, "name") else None for item in value]
        elif getattr(prop, "array_length", 0):
            out[name] = np.array(value).ravel().tolist()
        else:
            out[name] = value
    return out


def layer_flags(layer):
    return (
        layer.name,
        layer.exclude,
        layer.hide_viewport,
        layer.holdout,
        layer.indirect_only,
        [layer_flags(child) for child in layer.children],
    )


def render_result():
    image = bpy.data.images.get("Render Result")
    return image and (tuple(image.size), image.as_pointer())


def state():
    context, preferences = bpy.context, bpy.context.preferences
    scene = context.scene
    names = {}
    for kind in dir(bpy.data):
        collection = getattr(bpy.data, kind)
        if isinstance(collection, bpy.types.bpy_prop_collection):
            names[kind] = sorted(
                (block.name_full, block.users if COUNTS_USERS else 0)
                for block in collection
                if block.name not in OURS
            )
    return {
        "scene": snapshot(scene),
        "layers": {
            layer.name: (snapshot(layer, 1), layer_flags(layer.layer_collection))
            for layer in scene.view_layers
        },
        "objects": {
            obj.name_full: (
                np.array(obj.matrix_world).tolist(),
                obj.hide_viewport,
                obj.hide_render,
                obj.hide_get(),
                obj.select_get(),
                obj.as_pointer(),
                [c.name for c in obj.users_collection],
                obj.get("bend"),
            )
            for obj in scene.objects
        },
        "materials": {m.name: list(m.diffuse_color) for m in bpy.data.materials},
        "collections": {c.name: [o.name for o in c.objects] for c in bpy.data.collections},
        "preferences": snapshot(preferences.system, 0) | {"is_dirty": preferences.is_dirty},
        "names": names,
        "active": (
            context.scene.name,
            context.view_layer.name,
            context.view_layer.objects.active and context.view_layer.objects.active.name,
        ),
        "render result": render_result(),
        "file": bpy.data.filepath,
    }


def animated_and_moved(obj):
    """Animate values of an object and its material, and change them by hand since."""
    material = obj.material_slots[0].material
    obj["bend"] = 1.0
    for owner, path in ((obj, "location"), (material, "diffuse_color"), (obj, '["bend"]')):
        owner.keyframe_insert(path, frame=1)
    track = obj.animation_data.nla_tracks.new()
    track.strips.new("Strip", 1, obj.animation_data.action)
    obj.location.x += 0.5
    material.diffuse_color = (0.1, 0.2, 0.3, 1)
    obj["bend"] = 3.0


@pytest.fixture
def user_scene(build, tmp_path):
    """A scene with much that a comparison could upset: all of it other than what it sets."""
    scene = build.room()
    animated_and_moved(bpy.data.objects["Red"])
    hidden = build.collection("Hidden", build.cube("In Hidden", link=False), link=True)
    hidden.hide_render = True
    plane = build.square("Ground", link=False, location=(0, 0, -1.5))
    plane.reference_tracer.infinite_plane = True
    inner = build.collection("Inner", plane)
    outer = build.collection("Outer", link=True)
    outer.children.link(inner)
    build.cube("Eye", 0.3).hide_set(True)
    other = scene.view_layers.new("Other")
    other.layer_collection.children["Outer"].exclude = True
    shading, render = scene.display.shading, scene.render
    shading.light, shading.show_shadows, shading.show_cavity = "MATCAP", True, True
    shading.show_object_outline, shading.show_xray = True, False
    scene.display.render_aa, scene.display.viewport_aa = "16", "FXAA"
    render.engine, render.film_transparent = "CYCLES", False
    render.use_border = render.use_stamp = True
    render.border_min_x, render.border_max_x = 0.1, 0.9
    render.filepath, render.image_settings.file_format = "//somewhere_####", "JPEG"
    scene.view_settings.exposure, scene.view_settings.gamma = 1.5, 0.8
    scene.reference_tracer.method = "moller_trumbore"
    bpy.context.preferences.system.viewport_aa = "16"
    bpy.context.preferences.is_dirty = False
    save(tmp_path / "user.blend")
    return scene


def differences(before, after, path=""):
    """Return the paths of what differs, so that a failure can be read."""
    if isinstance(before, dict) and isinstance(after, dict):
        return [
            d
            for key in sorted({*before, *after})
            for d in differences(before.get(key), after.get(key), f"{path}/{key}")
        ]
    same = before == after or (before != before and after != after)
    return [] if same else [(path, before, after)]


@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
@pytest.mark.parametrize("shading", ["LIKE_FOR_LIKE", "AS_IS"])
def test_nothing_is_changed(shading, judge, user_scene, tmp_path):
    """Nor by a second comparison, which adds no image, and writes files."""
    user_scene.reference_tracer.judge, user_scene.reference_tracer.shading = judge, shading
    before = state()
    for folder in ("", str(tmp_path / "out")):
        assert bpy.ops.reference_tracer.compare(directory=folder) == {"FINISHED"}
        assert differences(before, state()) == []
        assert {i.name for i in bpy.data.images} == OURS


@pytest.mark.parametrize(
    ("module", "where"),
    [
        (compare_module, "export"),
        (drawings, "prepare_scene"),
        (drawings, "stand_ins"),
        (drawings, "picture"),
        (drawings, "_owners"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
@pytest.mark.parametrize("kind", [RuntimeError, KeyError, MemoryError])
def test_nothing_is_changed_by_an_error(kind, module, where, user_scene, monkeypatch):
    def fail(*args, **options):
        raise kind("on purpose")

    monkeypatch.setattr(module, where, fail)
    before = state()
    with pytest.raises(RuntimeError, match="on purpose"):
        bpy.ops.reference_tracer.compare()
    assert differences(before, state()) == []
    assert not {i.name for i in bpy.data.images}


def test_the_last_render_stays(user_scene, tmp_path):
    """The user's own F12 picture, saved before and after: the same file."""
    user_scene.render.engine = "BLENDER_WORKBENCH"
    user_scene.render.image_settings.file_format = "PNG"
    bpy.ops.render.render()
    before = state()
    result = bpy.data.images["Render Result"]
    result.save_render(str(tmp_path / "before.png"), scene=user_scene)
    assert bpy.ops.reference_tracer.compare() == {"FINISHED"}
    assert differences(before, state()) == []
    result.save_render(str(tmp_path / "after.png"), scene=user_scene)
    assert (tmp_path / "before.png").read_bytes() == (tmp_path / "after.png").read_bytes()


def test_off_and_on_a_hundred_times_leaves_nothing(user_scene, compare):
    """The user's own settings of the add-on are there again, too, each time."""
    lists = (getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers))
    handlers = [h for h in lists if isinstance(h, list)]
    before, counts = state(), [len(h) for h in handlers]
    classes = len(bpy.types.Operator.__subclasses__()), len(bpy.types.Panel.__subclasses__())
    for _ in range(100):
        reference_tracer.unregister()
        reference_tracer.register()
    assert differences(before, state()) == []
    assert [len(h) for h in handlers] == counts
    after = len(bpy.types.Operator.__subclasses__()), len(bpy.types.Panel.__subclasses__())
    assert after == classes
    assert user_scene.reference_tracer.method == "moller_trumbore"
    compare()
    assert differences(before, state()) == []

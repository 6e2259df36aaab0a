"""What the diagnosis takes for a mistaken exporter's scene is what Blender exports of that mistake.

Each variant is held against Blender: the user's scene is changed by hand, and exported as ever.
"""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from reference_tracer.blender.jobs.variants import variants
from reference_tracer.causes.case import WHOLE


@pytest.fixture
def rich(build):
    """A scene in which each kind of variant has something to change; all of it is in view."""
    scene = build.scene(64, 36)
    camera = build.far_camera()
    camera.data.ortho_scale = 40
    parent = build.empty("Parent", location=(1, 2, 3), rotation=(0.1, 0.2, 0.3))
    child = build.cube("Child", location=(2, 0, 0))
    child.parent = parent
    child.matrix_parent_inverse = Matrix.Translation((0, -1, 0.5))
    bent = build.cube("Bent", location=(-3, 0, 0))
    bent.modifiers.new("Subdivision", "SUBSURF").levels = 1
    bent.modifiers["Subdivision"].render_levels = 2
    bent.delta_location, bent.delta_rotation_euler[2] = (0.4, 0, 0.2), 0.3
    bent.delta_scale = (1, 1.5, 1)
    posed = build.cube("Posed", location=(0, 4, 0))
    posed.modifiers.new("Hook", "HOOK").object = parent
    posed.modifiers["Hook"].strength = 1.0
    posed.modifiers["Hook"].vertex_indices_set([0, 1, 2])
    build.cube("Hidden", location=(0, -4, 0)).hide_render = True
    moving = build.square("Moving")
    for frame, x in ((1, -2.0), (11, 3.0)):
        moving.location.x = x
        moving.keyframe_insert("location", frame=frame)
    other = bpy.data.objects.new("Side", bpy.data.cameras.new("Side"))
    build.link(other)
    other.data.lens = 25
    other.matrix_world = Matrix.Translation((3, 0, 40))
    camera.scale = (2, 2, 2)
    kit = build.collection("Kit", build.cube("InKit", link=False, location=(1, 0, 0)))
    kit.instance_offset = (2, -1, 0.5)
    build.instances("Instance", kit, location=(-5, -4, 0), rotation=(0, 0, 0.4))
    sub = build.collection("Extra", build.cube("InExtra", link=False, location=(5, 5, 0)))
    scene.collection.children.link(sub)
    second = scene.view_layers.new("Second")
    second.layer_collection.children["Extra"].exclude = True
    scene.frame_set(5)
    return scene


def seen(scene):
    """Return what is traced: each appearance in world space, in an order of its own."""
    out = []
    for i in scene.instances:
        mesh, m = scene.meshes[i.mesh], i.world_from_object
        points = mesh.vertices @ m[:3, :3].T + m[:3, 3]
        out.append((scene.objects[i.object], len(mesh.triangles), points[mesh.triangles].ravel()))
    return sorted(out, key=lambda one: (one[0], one[1], one[2].sum()))


def assert_same(one, other):
    first, second = seen(one), seen(other)
    assert [x[:2] for x in first] == [x[:2] for x in second]
    for a, b in zip(first, second, strict=True):
        np.testing.assert_allclose(a[2], b[2], atol=2e-6)
    a, b = one.camera.to_dict(), other.camera.to_dict()
    for camera in (a, b):
        camera.pop("name")
    np.testing.assert_allclose(a.pop("world_from_camera"), b.pop("world_from_camera"), atol=1e-6)
    assert a == b


def made(scene, fault, words="", name=None):
    """Return the scene of a variant, by its fault and a part of its words, or its object."""
    found = [
        v
        for v in variants(scene.name_full, scene.view_layers[0].name, ())
        if v.fault == fault and words in v.words and (name is None or v.object == name)
    ]
    assert found, f"no variant {fault} {words}"
    return found[0].scene


def modifiers_off(scene):
    bpy.data.objects["Bent"].modifiers.clear()


def viewport_levels(scene):
    modifier = bpy.data.objects["Bent"].modifiers[0]
    modifier.render_levels = modifier.levels


def another_level(scene):
    bpy.data.objects["Bent"].modifiers[0].render_levels += 1


def at_rest(scene):
    bpy.data.objects["Posed"].modifiers.clear()


def without_parent(scene):
    child = bpy.data.objects["Child"]
    basis = child.matrix_basis.copy()
    child.parent = None
    child.matrix_basis = basis


def without_inverse(scene):
    bpy.data.objects["Child"].matrix_parent_inverse = Matrix()


def without_delta(scene):
    bent = bpy.data.objects["Bent"]
    bent.delta_location, bent.delta_rotation_euler = (0, 0, 0), (0, 0, 0)
    bent.delta_scale = (1, 1, 1)


def without_offset(scene):
    bpy.data.collections["Kit"].instance_offset = (0, 0, 0)


def shown(scene):
    bpy.data.objects["Hidden"].hide_render = False


def a_frame_later(scene):
    scene.frame_set(6)


def half_a_frame_earlier(scene):
    scene.frame_set(4, subframe=0.5)


def through_the_side(scene):
    scene.camera = bpy.data.objects["Side"]


def sides_swapped(scene):
    data = scene.camera.data
    data.sensor_width, data.sensor_height = data.sensor_height, data.sensor_width


def fitted_vertically(scene):
    scene.camera.data.sensor_fit = "VERTICAL"


def parallel(scene):
    scene.camera.data.type = "ORTHO"


@pytest.mark.parametrize(
    ("fault", "words", "name", "change"),
    [
        ("no_modifiers", "", "Bent", modifiers_off),
        ("viewport_modifiers", "", "Bent", viewport_levels),
        ("subdivision", "+1", None, another_level),
        ("rest_pose", "", "Posed", at_rest),
        ("parent_left_out", "Child", None, without_parent),
        ("parent_inverse", "Child", None, without_inverse),
        ("delta_left_out", "Bent", None, without_delta),
        ("instance_offset", "'Kit'", None, without_offset),
        ("hidden_shown", "", "Hidden", shown),
        ("other_frame", "6 in place of 5", None, a_frame_later),
        ("other_frame", "4.5 in place of 5", None, half_a_frame_earlier),
        ("other_camera", "Side", None, through_the_side),
        ("sensor_width_for_height", "", None, sides_swapped),
        ("sensor_fit_setting", "vertical", None, fitted_vertically),
        ("camera_type", "orthographic", None, parallel),
    ],
)
def test_a_variant_is_what_blender_exports_after_the_change(
    rich, export, fault, words, name, change
):
    before, _ = export.render()
    variant = made(rich, fault, words, name)
    assert_same(before, export.render()[0])  # the user's scene is as it was
    change(rich)
    bpy.context.view_layer.update()
    expected, _ = export.render()
    with pytest.raises(AssertionError):
        assert_same(before, expected)  # the change changes something
    assert_same(variant, expected)


def test_what_has_no_delta_transform_has_none_left_out(rich, build):
    """Neither far away, nor where Blender normalises a quaternion itself."""
    build.cube("Far", location=(1e5, 2e5, 0.1), rotation=(0.1, 0.2, 0.3))
    long = build.cube("Long", location=(-5, 0, 0))
    long.rotation_mode = "QUATERNION"
    long.rotation_quaternion = (2, 1, 0, 0)
    bpy.context.view_layer.update()
    found = variants(rich.name_full, rich.view_layers[0].name, ())
    assert [v.words for v in found if v.fault == "delta_left_out"] == ["that of 'Bent'"]


def test_a_parents_scale_is_left_out(rich, export, build):
    """Of an object and of the camera: its place is scaled, and the object itself."""
    scaled = build.empty("Scaled", location=(1, -2, 0), rotation=(0.2, 0.1, -0.3))
    scaled.scale = (2, 0.5, 1.5)
    below = build.cube("Below", location=(1.5, 1, 0.5))
    below.parent = scaled
    rich.camera.parent = scaled
    bpy.context.view_layer.update()
    of_object = made(rich, "parent_scale", "Below")
    of_camera = made(rich, "parent_scale", "camera")
    before, _ = export.render()
    scaled.scale = (1, 1, 1)
    bpy.context.view_layer.update()
    expected, _ = export.render()
    with pytest.raises(AssertionError):
        assert_same(before, expected)
    assert_same(of_object, expected.seen_by(before.camera))
    assert_same(of_camera, before.seen_by(expected.camera))


def test_an_instance_is_taken_for_its_object_and_no_instance_for_the_object(rich, build):
    """Where an object is in the scene and instanced, too."""
    child = bpy.data.objects["Child"]
    build.instances("Again", build.collection("Shared", child), location=(4, -4, 0))
    bpy.context.view_layer.update()

    def places(scene):
        named = [i for i in scene.instances if scene.objects[i.object] == "Child"]
        return [i.world_from_object for i in named]

    assert np.allclose(places(made(rich, "instance_transform")), child.matrix_world)
    instanced = Matrix.Translation((4, -4, 0)) @ child.matrix_world
    own, other = places(made(rich, "parent_left_out", "Child"))
    assert np.allclose(own, child.matrix_basis) and np.allclose(other, instanced)


def test_another_view_layer(rich, export):
    variant = made(rich, "other_layer", "Second")
    bpy.context.window.view_layer = rich.view_layers["Second"]
    expected, _ = export.render()
    assert "InExtra" not in expected.objects
    assert_same(variant, expected)


def test_the_users_scene_is_as_it_was(rich):
    rich.frame_set(5, subframe=0.25)
    bpy.data.objects["Child"].location.x += 0.125  # moved, and not keyed
    bpy.context.view_layer.update()

    def state():
        return (
            [(o.name, *map(tuple, o.matrix_world), o.hide_render) for o in bpy.data.objects],
            [(m.name, m.levels, m.render_levels) for m in bpy.data.objects["Bent"].modifiers],
            (rich.frame_current, rich.frame_subframe, rich.camera.name),
            [len(getattr(bpy.data, n)) for n in ("scenes", "objects", "meshes", "collections")],
            [s.name for s in bpy.data.scenes],
        )

    before = state()
    making = variants(rich.name_full, rich.view_layers[0].name, ())
    found = []
    for variant in making:  # between two the user's own objects are as they were
        found.append(variant.fault)
        assert state()[:3] == before[:3]
    assert {WHOLE, "other_frame", "subdivision", "other_layer"} <= {*found}
    assert state() == before
    making = variants(rich.name_full, rich.view_layers[0].name, ())
    next(making)
    assert state() != before
    making.close()  # as at Esc
    assert state() == before

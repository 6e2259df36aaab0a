"""What the tracer does not model is named by object, and explains pixels in its place alone."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

MODES = ("VIEWPORT", "RENDER")


def transparent_material(build):
    build.cube("Thing", material=build.material("Glass", 0.2, 0.7, 0.9, 0.4))


def transparent_object(build):
    bpy.context.scene.display.shading.color_type = "OBJECT"
    build.cube("Thing", color=(0.2, 0.7, 0.9, 0.4))


def in_front(build):
    build.cube("Thing", 1, location=(0, 0, -1.5)).show_in_front = True
    build.square("Before", 4, material=build.material("Red", 0.9, 0.1, 0.1))


def holdout(build):
    build.cube("Thing").is_holdout = True


def hair(build):
    obj = build.square("Thing")
    obj.modifiers.new("Hair", "PARTICLE_SYSTEM")
    settings = obj.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 200, 0.8


def textured(build):
    bpy.context.scene.display.shading.color_type = "TEXTURE"
    material = build.material("Textured", 0.5, 0.5, 0.5)
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("Checks", 8, 8)
    node.image.pixels = [0.1, 0.9, 0.3, 1] * 64
    build.cube("Thing", material=material)


def grease_pencil(build):
    if bpy.app.version >= (4, 3, 0):
        bpy.ops.object.grease_pencil_add(type="MONKEY")
    else:
        bpy.ops.object.gpencil_add(type="MONKEY")
    bpy.context.object.name = "Thing"
    bpy.context.object.rotation_euler.x = 1.0  # edge-on, 4.5 draws nothing


def hair_curves(build):
    curves = bpy.data.hair_curves.new("Thing")
    curves.add_curves([2] * 20)
    x = np.linspace(-1, 1, 20)
    points = np.stack([np.stack((x, 0 * x, 0 * x), 1), np.stack((x, 0 * x + 1, 0 * x), 1)], 1)
    curves.attributes["position"].data.foreach_set("vector", points.astype(np.float32).ravel())
    build.link(bpy.data.objects.new("Thing", curves))


def point_cloud(build):
    build.link(bpy.data.objects.new("Thing", bpy.data.pointclouds.new("Thing")))


def volume(build):
    build.link(bpy.data.objects.new("Thing", bpy.data.volumes.new("Thing")))


OF_OBJECTS = {
    transparent_material: "transparency",
    transparent_object: "transparency",
    in_front: "in-front drawing",
    holdout: "holdout",
    hair: "hair",
    textured: "texture",
    grease_pencil: "grease pencil",
    hair_curves: "hair curves",
    point_cloud: "point cloud",
    volume: "volume",
}


@pytest.mark.parametrize("make", OF_OBJECTS, ids=lambda make: make.__name__)
@pytest.mark.parametrize("mode", MODES)
def test_is_named_with_object_and_bounds(mode, make, build, export):
    build.scene()
    build.camera()
    make(build)
    build.cube("Other", 0.1)
    _, manifest = export.modes[mode]()
    found = [u for u in manifest.unmodelled if u.feature == OF_OBJECTS[make]]
    assert [u.object for u in found] == ["Thing"]
    assert all(not u.object == "Other" for u in manifest.unmodelled)
    obj = bpy.data.objects["Thing"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    corners = np.array([obj.matrix_world @ type(obj.location)(c) for c in obj.bound_box])
    assert (found[0].bounds[0] <= corners.min(axis=0) + 1e-6).all()
    assert (found[0].bounds[1] >= corners.max(axis=0) - 1e-6).all()
    assert any(
        line.startswith(f"  not modelled: Thing: {OF_OBJECTS[make]}") for line in manifest.lines()
    )
    entry = manifest.to_dict()["unmodelled"]
    assert any(u["object"] == "Thing" and len(u["bounds"]) == 2 for u in entry)


def test_explains_nothing_elsewhere(build, compare, shown_otherwise):
    """A pixel outside of the bounds stays unexplained."""
    build.scene()
    transparent_material(build)
    build.camera((0, 0, 8))

    def with_a_fault(pixels):
        pixels[0, 0] = (1, 0, 0, 1)
        return pixels

    shown_otherwise(with_a_fault)
    comparison = compare()
    assert comparison.counts.unexplained == 1
    assert comparison.verdict == "differences"


def depth_of_field(scene, build):
    scene.camera.data.dof.use_dof = True


def motion_blur(scene, build):
    scene.render.use_motion_blur = True


def multiview(scene, build):
    scene.render.use_multiview = True


def freestyle(scene, build):
    scene.render.use_freestyle = True


def x_ray(scene, build):
    scene.display.shading.show_xray = True


def backface_culling(scene, build):
    scene.display.shading.show_backface_culling = True


def mist(scene, build):
    scene.world = bpy.data.worlds.new("World")
    scene.world.mist_settings.use_mist = True


def compositor(scene, build):
    build.compositor()


def sequencer(scene, build):
    build.sequencer()


OF_SCENES = {
    depth_of_field: "depth of field",
    motion_blur: "motion blur",
    multiview: "multiview",
    freestyle: "freestyle lines",
    x_ray: "x-ray shading",
    backface_culling: "backface culling",
    mist: "mist",
    compositor: "compositor",
    sequencer: "sequencer",
}


@pytest.mark.parametrize("make", OF_SCENES, ids=lambda make: make.__name__)
def test_of_the_scene_is_not_in_the_picture_and_still_named(make, build, compare):
    scene = build.scene()
    build.solids()
    build.corner_camera(lens=40)
    make(scene, build)
    comparison = compare()
    assert comparison.counts.unexplained == 0
    found = [u for u in comparison.manifest.unmodelled if u.feature == OF_SCENES[make]]
    assert [u.object for u in found] == [
        "Camera" if make is depth_of_field else f"scene '{scene.name}'"
    ]
    assert found[0].bounds is None


def test_several_instances_share_one_entry_around_all_of_them(build, export):
    build.camera()
    cube = build.cube("Thing", 1, link=False, material=build.material("Glass", 1, 1, 1, 0.5))
    collection = build.collection("Kit", cube)
    for x in (-4, 4):
        empty = build.empty(f"Empty {x}", location=(x, 0, 0))
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
    _, manifest = export.viewport()
    (found,) = manifest.unmodelled
    np.testing.assert_allclose(found.bounds, [(-4.5, -0.5, -0.5), (4.5, 0.5, 0.5)])


def test_an_ordinary_scene_has_nothing_of_it(build, export):
    build.scene()
    build.solids()
    build.corner_camera()
    for run in export.modes.values():
        assert run()[1].unmodelled == ()

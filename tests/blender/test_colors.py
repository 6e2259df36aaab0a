"""The colours of Blender's solid viewport: the traced ones are those of Workbench's picture."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from reference_tracer.blender.reading.colors import background
from reference_tracer.blender.versions import WITHOUT_ATTRIBUTE
from reference_tracer.pictures.palette import By

from .scenes import HALF_FLOAT, assert_same_colors

COLOR_TYPES = ("MATERIAL", "OBJECT", "SINGLE", "VERTEX", "RANDOM")


def objects(build):
    """Several slots; empty ones; slots past the end; a slot linked to the object; no material."""
    red, green, blue = (
        build.material(n, *rgb)
        for n, rgb in (
            ("Red", (0.9, 0.1, 0.05)),
            ("Green", (0.1, 0.6, 0.2)),
            ("Blue", (0.1, 0.3, 0.95)),
        )
    )
    for number, x in enumerate((-2.4, -0.8, 0.8, 2.4)):
        obj = build.cube(
            f"Cube {number}",
            1,
            location=(x, 0.8, 0),
            rotation=(0.5, 0.3 * x, x),
            color=(0.2 * number, 0.9 - 0.2 * number, 0.5, 1),
        )
        for material in ((red, green), (None, blue), (), (red,))[number]:
            obj.data.materials.append(material)
        for polygon in obj.data.polygons:
            polygon.material_index = polygon.index % 3
    linked = build.square(
        "Linked Slot", 1, location=(0, -0.9, 0.3), material=red, color=(1, 1, 0, 1)
    )
    linked.material_slots[0].link = "OBJECT"
    linked.material_slots[0].material = blue
    build.square("Object Slot", 1, location=(-2, -0.9, 0.3), material=green, color=(0, 1, 1, 1))


def collection_instances(build):
    """Two empties of different colour show the same collection, one of them mirrored."""
    cube = build.cube(
        "In Collection",
        1,
        link=False,
        location=(0.2, 0.5, 0),
        rotation=(0.3, 0.2, 0),
        material=build.material("Red", 0.9, 0.2, 0.1),
        color=(0.1, 0.9, 0.6, 1),
    )
    square = build.square("Plain", 1, link=False, location=(0, -0.9, 0.4))
    collection = build.collection("Shown", cube, square)
    for x, color in ((-1.5, (0.9, 0.6, 0.1, 1)), (1.5, (0.3, 0.2, 0.7, 1))):
        build.instances(
            f"Empty {x}", collection, location=(x, 0, 0), scale=(np.sign(x), 1, 1), color=color
        )


def node_instances(build):
    """Instances of an object and of a bare mesh, each by an object with a colour of its own."""
    source = build.cube(
        "Source",
        2,
        material=build.material("Red", 0.9, 0.2, 0.1),
        color=(0.1, 0.9, 0.6, 1),
        link=False,
    )
    for name, y, shown in (("Of Object", 0.7, source), ("Of Mesh", -0.7, "GeometryNodeMeshCube")):
        points = [(x, y, 0) for x in (-2, -0.5, 1, 2.5)]
        obj = build.mesh(name, points, [])
        obj.color = (0.8, 0.4 + y / 2, 0.2, 1)
        build.instances_on_points(obj, shown)


def node_materials(build):
    """Geometry nodes give the mesh a material that the object does not have."""
    obj = build.cube(
        "Set",
        2,
        location=(-1.5, 0, 0),
        rotation=(0.4, 0.5, 0.2),
        material=build.material("Own", 0.2, 0.2, 0.8),
        color=(0.7, 0.9, 0.1, 1),
    )
    _, (node,) = build.nodes(obj, "GeometryNodeSetMaterial")
    node.inputs["Material"].default_value = build.material("By Nodes", 0.9, 0.5, 0.1)
    obj = build.mesh("Made", [(0, 0, 0)], [])
    obj.location, obj.color = (1.5, 0, 0), (0.2, 0.4, 0.3, 1)
    build.nodes(obj, "GeometryNodeMeshUVSphere")


def generated_types(build):
    """What is no mesh before it is evaluated."""
    for number, (make, x, y) in enumerate(
        (
            (build.text, -2.6, 0.6),
            (build.bevelled_curve, 1.5, 1),
            (build.metaball, 1.2, -0.9),
            (build.surface, -1.6, -0.8),
        )
    ):
        obj = make(
            location=(x, y, 0),
            scale=(0.7, 0.7, 0.7),
            material=build.material(f"M{number}", 0.3 * number, 0.8, 0.9 - 0.3 * number),
        )
        obj.color = (0.9 - 0.2 * number, 0.2 * number, 0.4, 1)


OF_SLOTS = {"VERTEX"} if WITHOUT_ATTRIBUTE == "MATERIAL" else set()
INSTANCED = (collection_instances, node_instances)
SCENES = (objects, collection_instances, node_instances, node_materials, generated_types)


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.__name__)
@pytest.mark.parametrize("color_type", COLOR_TYPES)
@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_shows_what_blender_shows(judge, color_type, scene, build, compare):
    own = build.scene(color_type=color_type)
    own.display.shading.single_color = (0.3, 0.5, 0.7)
    own.reference_tracer.judge = judge
    scene(build)
    build.camera(type="ORTHO", ortho_scale=7)
    if judge == "CYCLES" and color_type == "RANDOM" and scene in INSTANCED:
        with pytest.raises(ValueError, match=r"random colours of instances.*Workbench"):
            compare(colors=By.VIEWPORT)
        return
    if judge == "CYCLES" and scene is objects and color_type in {"MATERIAL"} | OF_SLOTS:
        with pytest.raises(ValueError, match="'Cube 2' has faces of a material slot that it does"):
            compare(colors=By.VIEWPORT)  # they would be black
        for number in (2, 3):
            bpy.data.meshes[f"Cube {number}"].polygons.foreach_set("material_index", [0] * 6)
    found = compare(colors=By.VIEWPORT)
    assert found.case.picture.source.name == judge.lower()
    assert_same_colors(found, distinct=1 if color_type == "SINGLE" else 2)


@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
@pytest.mark.parametrize("kind", ["FLOAT_COLOR", "BYTE_COLOR"])
def test_color_attributes(kind, domain, build, compare):
    build.scene(color_type="VERTEX")
    for number, x in enumerate((-1.6, 1.6)):
        obj = build.cube(f"Cube {number}", 1.8, location=(x, 0, 0), rotation=(0.6, 0.3, x))
        build.color_attribute(obj, domain, kind, seed=number)
    build.camera(type="ORTHO", ortho_scale=7)
    assert_same_colors(compare(), distinct=100)


@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
def test_an_attribute_that_nodes_made(domain, build, compare):
    """It is named: 4.2 and 5.0 draw such a mesh black, as no attribute is active, 5.2 shows it."""
    build.scene(color_type="VERTEX")
    obj = build.mesh("Made", [(0, 0, 0)], [])
    obj.color = (0.1, 0.3, 0.9, 1)
    tree, (grid, store) = build.nodes(
        obj, "GeometryNodeMeshGrid", "GeometryNodeStoreNamedAttribute"
    )
    tree.links.new(grid.outputs[0], store.inputs[0])
    grid.inputs["Size X"].default_value = grid.inputs["Size Y"].default_value = 2
    store.data_type, store.domain = "FLOAT_COLOR", domain
    store.inputs["Name"].default_value = "Made By Nodes"
    next(s for s in store.inputs if s.name == "Value" and s.type == "RGBA").default_value = (
        0.8,
        0.4,
        0.1,
        1,
    )
    build.camera((0, 0, 8))  # it is less than half of the picture
    comparison = compare()
    assert [(u.object, u.feature) for u in comparison.manifest.unmodelled] == [
        ("Made", "colour attribute")
    ]
    assert comparison.counts.by_cause["not_modelled"] > 0
    assert comparison.verdict == "warnings"


@pytest.mark.parametrize("kind", ["THEME", "WORLD", "VIEWPORT"])
@pytest.mark.parametrize("film", ["opaque", "transparent"])
@pytest.mark.parametrize("world", [True, False], ids=["world", "no_world"])
def test_the_background_as_it_is(world, film, kind, build, compare):
    scene = build.scene()
    shading = scene.display.shading
    shading.light, scene.display.render_aa = "FLAT", "OFF"
    shading.show_specular_highlight = shading.show_object_outline = shading.show_shadows = False
    shading.background_type, shading.background_color = kind, (0.7, 0.2, 0.4)
    scene.render.film_transparent = film == "transparent"
    scene.world = bpy.data.worlds.new("World") if world else None
    if world:
        scene.world.color = (0.1, 0.5, 0.9)
    build.square(material=build.material("Green", 0.2, 0.9, 0.3))
    build.camera()
    comparison = compare(as_is=True)
    assert comparison.case.picture.source.settings["like_for_like"] is False
    np.testing.assert_allclose(
        comparison.picture[0, 0], comparison.frame.color[0, 0], atol=HALF_FLOAT
    )
    assert comparison.frame.color[0, 0, 3] == comparison.picture[0, 0, 3]
    assert_same_colors(comparison, distinct=1)
    np.testing.assert_array_equal(background(scene), comparison.scene.background)

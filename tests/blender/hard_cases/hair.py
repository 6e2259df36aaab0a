"""What draws itself: hair, strokes, points, volumes."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from .simulated import fountain
from .stage import CYAN, ORANGE, ball, colored, grid, stage, step_to


def grow_hair(obj: Any, count: int, length: float) -> Any:
    obj.modifiers.new("Hair", "PARTICLE_SYSTEM")
    settings = obj.particle_systems[-1].settings
    settings.type, settings.count, settings.hair_length = "HAIR", count, length
    settings.use_advanced_hair, settings.brownian_factor = True, 0.05
    return settings


def particle_hair(build: Any) -> None:
    """A tuft on the floor and before the solids."""
    stage(build)
    patch = grid(build, "Patch", 4, 1, location=(-0.2, -1.3, -0.9))
    patch.data.materials.append(colored(build, "Orange", ORANGE))
    grow_hair(patch, 120, 0.7)


def hair_and_particles(build: Any) -> None:
    """One object has both: what is simulated must outlast whatever is done about the hair."""
    obj = fountain(build).id_data
    grow_hair(obj, 120, 0.8)
    step_to(10)


def hair_everywhere(build: Any) -> None:
    """A lawn that fills the picture."""
    scene = stage(build)
    lawn = grid(build, "Lawn", 10, 24, location=(0, 0, -1.01))
    lawn.data.materials.append(colored(build, "Orange", ORANGE))
    grow_hair(lawn, 16000, 1.2)
    scene.camera.location = (0, 0, 9)
    scene.camera.rotation_euler = (0.1, 0, 0)


def _hair_curves(build: Any, link: bool = True) -> Any:
    curves = bpy.data.hair_curves.new("Hair Curves")
    curves.add_curves([3] * 60)
    x = np.linspace(-0.6, 0.6, 60)
    y = 0.2 * np.sin(9 * x)
    points = np.stack([np.stack((x, y + 0.1 * z, 0 * x + z), 1) for z in (0, 0.4, 0.8)], 1)
    curves.attributes["position"].data.foreach_set("vector", points.astype(np.float32).ravel())
    radius = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(180, 0.015, np.float32))
    curves.materials.append(colored(build, "Orange", ORANGE))
    obj = bpy.data.objects.new("Hair Curves", curves)
    return build.link(obj) if link else obj


def hair_curves(build: Any) -> None:
    stage(build)
    _hair_curves(build).location = (-0.2, -1.3, -0.8)


def instanced_hair(build: Any) -> None:
    """Curves and a tuft in a collection that an empty shows, beside a cube of it."""
    stage(build)
    tuft = build.square("Tuft", 0.6, link=False, location=(0.9, 0, 0))
    grow_hair(tuft, 60, 0.5)
    cube = build.cube(
        "Cube", 0.4, link=False, location=(0, 0.3, 0.2), material=colored(build, "Cyan", CYAN)
    )
    kit = build.collection("Kit", _hair_curves(build, link=False), tuft, cube)
    build.instances("Instances", kit, location=(-0.4, -1.3, -0.8))


def _grease_pencil(build: Any, kind: str) -> None:
    stage(build)
    if bpy.app.version >= (4, 3, 0):
        bpy.ops.object.grease_pencil_add(type=kind, radius=0.8)
    else:
        bpy.ops.object.gpencil_add(type=kind, radius=0.8)
    obj = bpy.context.object
    obj.location, obj.rotation_euler = (0.6, -1.3, 0.2), (0, 0, 0.6)
    bpy.context.view_layer.update()  # 4.2's stays where it was made


def grease_pencil(build: Any) -> None:
    _grease_pencil(build, "MONKEY")


def empty_grease_pencil(build: Any) -> None:
    _grease_pencil(build, "EMPTY")


def point_cloud(build: Any) -> None:
    stage(build)
    cloud = bpy.data.pointclouds.new("Cloud")
    if not hasattr(cloud, "resize"):
        import pytest  # not in a window's Blender

        pytest.skip("a script can make no points in this Blender")
    cloud.resize(80)
    places = np.random.default_rng(2).uniform(-0.6, 0.6, (80, 3)).astype(np.float32)
    cloud.attributes["position"].data.foreach_set("vector", places.ravel())
    radius = cloud.attributes.get("radius") or cloud.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(80, 0.06, np.float32))
    cloud.materials.append(colored(build, "Orange", ORANGE))
    build.object("Cloud", cloud, location=(0, -1.2, 0.1))


def empty_volume(build: Any) -> None:
    stage(build)
    build.object("Volume", bpy.data.volumes.new("Volume"))


def _nodes_beside_mesh(build: Any, name: str) -> tuple[Any, Any, Any]:
    """A mesh whose nodes join it with what one node makes of it, moved upwards."""
    stage(build)
    obj = ball(build, "Nodes", 0.5, location=(0, -1.2, -0.3))
    obj.data.materials.append(colored(build, "Orange", ORANGE))
    tree, (make, move, join) = build.nodes(
        obj, name, "GeometryNodeTransform", "GeometryNodeJoinGeometry"
    )
    move.inputs["Translation"].default_value = (0.3, 0, 0.7)
    tree.links.new(tree.nodes["Group Input"].outputs[0], join.inputs[0])
    return obj, tree, make


def nodes_with_curves(build: Any) -> None:
    """Curves without a profile: no picture shows them."""
    _nodes_beside_mesh(build, "GeometryNodeMeshToCurve")


def hair_curves_with_mesh(build: Any) -> None:
    """Nodes on hair that join a cube to it."""
    stage(build)
    obj = _hair_curves(build)
    obj.location = (-0.2, -1.3, -0.8)
    tree, (join,) = build.nodes(obj, "GeometryNodeJoinGeometry")
    cube = tree.nodes.new("GeometryNodeMeshCube")
    cube.inputs["Size"].default_value = (0.4, 0.4, 0.4)
    tree.links.new(cube.outputs["Mesh"], join.inputs[0])


def hair_on_points(build: Any) -> None:
    """Nodes that put a hair object on the points of a mesh."""
    stage(build)
    hair = _hair_curves(build)
    hair.location = (60, 0, 0)
    points = grid(build, "Points", 1, 1.2, location=(0, -1.2, -0.8))
    build.instances_on_points(points, hair)
    tree = points.modifiers[0].node_group
    on_points = next(n for n in tree.nodes if n.type == "INSTANCE_ON_POINTS")
    on_points.inputs["Scale"].default_value = (0.7, 0.7, 0.7)


def nodes_with_points(build: Any) -> None:
    _, _, make = _nodes_beside_mesh(build, "GeometryNodeMeshToPoints")
    make.inputs["Radius"].default_value = 0.05


# Hairs, strokes and points over less than half of the picture.
HAIR = (
    particle_hair,
    hair_and_particles,
    hair_curves,
    instanced_hair,
    grease_pencil,
    point_cloud,
    hair_curves_with_mesh,
    hair_on_points,
    nodes_with_points,
)
DRAWS_NOTHING = (empty_grease_pencil, empty_volume, nodes_with_curves)

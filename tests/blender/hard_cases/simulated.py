"""What Blender simulates, at a frame that shows it."""

from __future__ import annotations

from typing import Any

import bpy

from .stage import CYAN, ORANGE, PINK, ball, colored, emitter, grid, stage, step_to


def fountain(build: Any) -> Any:
    stage(build)
    source = build.cube("Chip", 2, location=(60, 0, 0), material=colored(build, "Orange", ORANGE))
    obj = grid(build, "Emitter", 4, 0.8, location=(-0.4, -1.2, -0.9))
    return emitter(build, obj, source)


def particles(build: Any) -> None:
    fountain(build)
    step_to(10)


def particles_of_collection(build: Any) -> None:
    stage(build)
    chips = [
        build.cube("Chip", 2, link=False, material=colored(build, "Orange", ORANGE)),
        build.cube("Slab", 2.5, link=False, material=colored(build, "Cyan", CYAN)),
    ]
    obj = grid(build, "Emitter", 4, 0.8, location=(-0.4, -1.2, -0.9))
    emitter(build, obj, build.collection("Chips", *chips))
    step_to(10)


def cloth(build: Any) -> None:
    stage(build)
    obstacle = ball(
        build, "Obstacle", 0.5, location=(0, -0.8, 0.6), material=colored(build, "Pink", PINK)
    )
    obstacle.modifiers.new("Collision", "COLLISION")
    cloth = grid(
        build, "Cloth", 12, 2, location=(0, -0.8, 1.2), material=colored(build, "Orange", ORANGE)
    )
    cloth.modifiers.new("Cloth", "CLOTH").settings.quality = 3
    step_to(24)


def soft_body(build: Any) -> None:
    stage(build)
    obj = grid(
        build, "Soft", 8, 1.6, location=(0, -0.8, 1.2), material=colored(build, "Orange", ORANGE)
    )
    group = obj.vertex_groups.new(name="Held")
    group.add(list(range(9)), 1.0, "REPLACE")
    settings = obj.modifiers.new("Soft", "SOFT_BODY").settings
    settings.use_goal, settings.vertex_group_goal = True, "Held"
    settings.goal_default, settings.goal_min = 0.0, 0.0
    step_to(16)


def simulation_zone(build: Any) -> None:
    """Geometry nodes that move a grid's points farther every frame, and put a cube on each."""
    stage(build)
    obj = grid(build, "Swarm", 3, 1.6, location=(0, -0.8, -0.2))
    obj.data.materials.append(colored(build, "Orange", ORANGE))
    tree, (start, move, end, on_points, real, paint) = build.nodes(
        obj,
        "GeometryNodeSimulationInput",
        "GeometryNodeSetPosition",
        "GeometryNodeSimulationOutput",
        "GeometryNodeInstanceOnPoints",
        "GeometryNodeRealizeInstances",
        "GeometryNodeSetMaterial",
    )
    start.pair_with_output(end)
    for first, second in (
        (tree.nodes["Group Input"].outputs[0], start.inputs[0]),
        (start.outputs["Geometry"], move.inputs["Geometry"]),
        (move.outputs["Geometry"], end.inputs["Geometry"]),
        (end.outputs["Geometry"], on_points.inputs["Points"]),
        (on_points.outputs[0], real.inputs[0]),
    ):
        tree.links.new(first, second)
    noise = tree.nodes.new("FunctionNodeRandomValue")
    noise.data_type = "FLOAT_VECTOR"
    noise.inputs["Min"].default_value = (-0.03, -0.03, 0.0)
    noise.inputs["Max"].default_value = (0.03, 0.03, 0.15)
    tree.links.new(noise.outputs["Value"], move.inputs["Offset"])
    cube = tree.nodes.new("GeometryNodeMeshCube")
    cube.inputs["Size"].default_value = (0.2, 0.2, 0.2)
    tree.links.new(cube.outputs["Mesh"], on_points.inputs["Instance"])
    paint.inputs["Material"].default_value = obj.data.materials[0]
    step_to(8)


def rigid_body(build: Any) -> None:
    stage(build)
    bpy.ops.rigidbody.world_add()
    bodies = build.collection("Bodies", link=True)
    bpy.context.scene.rigidbody_world.collection = bodies
    for n, rgb in enumerate((ORANGE, CYAN, PINK)):
        obj = build.cube(
            f"Body {n}",
            0.5,
            location=(-0.2 + 0.15 * n, -1, 0.2 + 0.8 * n),
            rotation=(0.3 * n, 0.2, 0),
            material=colored(build, f"Body {n}", rgb),
        )
        bpy.context.view_layer.objects.active = obj
        bpy.ops.rigidbody.object_add()
    floor = bpy.data.objects["Floor"]
    bpy.context.view_layer.objects.active = floor
    bpy.ops.rigidbody.object_add()
    floor.rigid_body.type = "PASSIVE"
    step_to(16)


def baked_rigid_body(build: Any) -> None:
    rigid_body(build)
    scene = bpy.context.scene
    cache = scene.rigidbody_world.point_cache
    cache.frame_end = 20
    with bpy.context.temp_override(scene=scene, point_cache=cache):
        bpy.ops.ptcache.bake(bake=True)
    scene.frame_set(16)


SIMULATIONS = (
    particles,
    particles_of_collection,
    cloth,
    soft_body,
    simulation_zone,
    baked_rigid_body,
)

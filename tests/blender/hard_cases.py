"""Scenes that are hard to judge, as users build them: each builder takes a `Build` and makes one.

A scene has coloured solids in view besides its hard thing, and stands at a frame where it matters.
What is simulated is stepped there from the first frame on, as Blender keeps no other cache of it.
Nothing here needs more than `bpy` and numpy: a whole Blender can build these scenes, too.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

ORANGE, CYAN, PINK = (0.9, 0.45, 0.05), (0.05, 0.75, 0.8), (0.9, 0.3, 0.6)


def stage(build: Any, **scene: Any) -> Any:
    """Give a small picture with solids on a floor, seen from a corner; returns the scene."""
    out = build.scene(**scene)
    out.frame_end = 60  # also where caches end
    build.solids()
    build.corner_camera(lens=32)
    return out


def step_to(frame: int) -> None:
    """Play the scene from its start, so that what is simulated is simulated."""
    for number in range(1, frame + 1):
        bpy.context.scene.frame_set(number)


def grid(build: Any, name: str, n: int = 10, size: float = 2.0, **place: Any) -> Any:
    """A flat mesh of n x n squares."""
    ticks = np.linspace(-size / 2, size / 2, n + 1)
    vertices = [(x, y, 0.0) for y in ticks for x in ticks]
    faces = [
        (k, k + 1, k + n + 2, k + n + 1)
        for k in (row * (n + 1) + column for row in range(n) for column in range(n))
    ]
    return build.place(build.mesh(name, vertices, faces), **place)


def ball(build: Any, name: str, radius: float = 0.6, **place: Any) -> Any:
    """A sphere of 16 x 8 faces."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=radius)
    obj = bpy.context.object
    obj.name = name
    return build.place(obj, **place)


def colored(build: Any, name: str, rgb: tuple[float, ...], alpha: float = 1.0) -> Any:
    return build.material(name, *rgb, alpha)


def emitter(build: Any, obj: Any, source: Any, count: int = 60) -> Any:
    """Have an object throw copies of another, or of a collection's objects, upwards."""
    obj.modifiers.new("Thrower", "PARTICLE_SYSTEM")
    system = obj.particle_systems[-1]
    settings = system.settings
    settings.count, settings.frame_start, settings.frame_end = count, 1, 12
    settings.lifetime, settings.normal_factor, settings.factor_random = 60, 3.0, 1.0
    if isinstance(source, bpy.types.Collection):
        settings.render_type, settings.instance_collection = "COLLECTION", source
    else:
        settings.render_type, settings.instance_object = "OBJECT", source
    settings.particle_size, settings.size_random = 0.12, 0.3
    return system


def _fountain(build: Any) -> Any:
    stage(build)
    source = build.cube("Chip", 2, location=(60, 0, 0), material=colored(build, "Orange", ORANGE))
    obj = grid(build, "Emitter", 4, 0.8, location=(-0.4, -1.2, -0.9))
    return emitter(build, obj, source)


def particles(build: Any) -> None:
    _fountain(build)
    step_to(10)


def baked_particles(build: Any) -> None:
    system = _fountain(build)
    cache = system.point_cache
    cache.frame_end = 14
    with bpy.context.temp_override(point_cache=cache, active_object=system.id_data):
        bpy.ops.ptcache.bake(bake=True)
    bpy.context.scene.frame_set(10)


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


def explode(build: Any) -> None:
    stage(build)
    obj = ball(
        build, "Shell", 0.7, location=(0, -0.8, 0.6), material=colored(build, "Orange", ORANGE)
    )
    system = emitter(build, obj, None, 60)
    system.settings.render_type = "NONE"
    system.settings.frame_end, system.settings.normal_factor = 4, 2.0
    obj.modifiers.new("Explode", "EXPLODE")
    step_to(10)


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


def wave(build: Any) -> None:
    stage(build)
    obj = grid(
        build, "Pond", 20, 3, location=(0, -0.8, 0), material=colored(build, "Orange", ORANGE)
    )
    modifier = obj.modifiers.new("Wave", "WAVE")
    modifier.height, modifier.width, modifier.narrowness = 0.5, 0.8, 2.0
    step_to(24)


def ocean(build: Any) -> None:
    stage(build)
    obj = grid(build, "Sea", 2, 1, location=(0, -0.8, 0), material=colored(build, "Orange", ORANGE))
    modifier = obj.modifiers.new("Ocean", "OCEAN")
    modifier.geometry_mode, modifier.resolution, modifier.spatial_size = "GENERATE", 4, 3
    modifier.size, modifier.wave_scale, modifier.use_normals = 1.0, 1.0, False
    for frame in (1, 8):
        modifier.time = frame / 4
        modifier.keyframe_insert("time", frame=frame)
    step_to(5)


def dynamic_paint(build: Any) -> None:
    """Waves on a canvas, by a brush that has moved through it."""
    stage(build)
    canvas = grid(
        build, "Canvas", 20, 2.4, location=(0, -0.8, 0), material=colored(build, "Orange", ORANGE)
    )
    canvas.modifiers.new("Paint", "DYNAMIC_PAINT")
    brush = ball(
        build, "Brush", 0.3, location=(-0.6, -0.8, 0), material=colored(build, "Cyan", CYAN)
    )
    brush.modifiers.new("Paint", "DYNAMIC_PAINT")
    for obj, kind in ((canvas, "CANVAS"), (brush, "BRUSH")):
        with bpy.context.temp_override(object=obj, active_object=obj):
            bpy.ops.dpaint.type_toggle(type=kind)
    surface = canvas.modifiers["Paint"].canvas_settings.canvas_surfaces[0]
    surface.surface_type, surface.frame_end = "WAVE", 60
    for frame, x in ((1, -0.6), (12, 0.6)):
        brush.location.x = x
        brush.keyframe_insert("location", frame=frame)
    step_to(14)


SIMULATIONS = (
    particles,
    baked_particles,
    particles_of_collection,
    cloth,
    soft_body,
    explode,
    simulation_zone,
    baked_rigid_body,
    wave,
    ocean,
    dynamic_paint,
)


def _edited(build: Any, *modifiers: str) -> Any:
    """A block of two materials by face, shown as its modifiers leave it, to be edited."""
    stage(build)
    obj = build.cube("Edited", 0.9, location=(0, -1.2, 0.3), rotation=(0.3, 0.2, 0.5))
    for name, rgb in (("Orange", ORANGE), ("Cyan", CYAN)):
        obj.data.materials.append(colored(build, name, rgb))
    for face in list(obj.data.polygons)[::2]:
        face.material_index = 1
    for kind in modifiers:
        obj.modifiers.new(kind, kind)
    bpy.context.view_layer.objects.active = obj
    return obj


def _edit() -> None:
    bpy.ops.object.mode_set(mode="EDIT")


def edited(build: Any) -> None:
    _edited(build)
    _edit()


def edited_with_mirror(build: Any) -> None:
    obj = _edited(build, "MIRROR")
    for vertex in obj.data.vertices:
        vertex.co.x += 0.6
    _edit()


def edited_with_subdivision(build: Any) -> None:
    modifier = _edited(build, "SUBSURF").modifiers[0]
    modifier.levels = modifier.render_levels = 2
    _edit()


def edited_without_its_modifier(build: Any) -> None:
    """The modifier is there, but not in Edit Mode."""
    modifier = _edited(build, "SUBSURF").modifiers[0]
    modifier.levels = modifier.render_levels = 2
    modifier.show_in_editmode = False
    _edit()


def edited_shared(build: Any) -> None:
    """One mesh of two objects and an instanced one; one of the objects has a modifier."""
    obj = _edited(build, "SUBSURF")
    obj.modifiers[0].levels = obj.modifiers[0].render_levels = 1
    other = build.link(bpy.data.objects.new("Other", obj.data))
    other.location, other.scale = (1.1, -1.2, 0.4), (0.8, 0.8, 0.8)
    instanced = bpy.data.objects.new("Instanced", obj.data)
    empty = build.empty("Instances", location=(-0.9, -1.2, -0.4), scale=(0.6, 0.6, 0.6))
    empty.instance_type = "COLLECTION"
    empty.instance_collection = build.collection("Kit", instanced)
    _edit()


def edited_and_changed(build: Any) -> None:
    """An edit that has not left Edit Mode yet: what is drawn is no longer what is stored."""
    import bmesh

    obj = _edited(build)
    _edit()
    editing = bmesh.from_edit_mesh(obj.data)
    for vertex in editing.verts:
        if vertex.co.z > 0:
            vertex.co.z += 0.7
    bmesh.update_edit_mesh(obj.data)


EDIT_MODE = (
    edited,
    edited_with_mirror,
    edited_with_subdivision,
    edited_without_its_modifier,
    edited_shared,
    edited_and_changed,
)


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
    obj = _fountain(build).id_data
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
    empty = build.empty("Instances", location=(-0.4, -1.3, -0.8))
    empty.instance_type, empty.instance_collection = "COLLECTION", kit


def _grease_pencil(build: Any, kind: str) -> None:
    stage(build)
    if bpy.app.version >= (4, 3, 0):
        bpy.ops.object.grease_pencil_add(type=kind, radius=0.8)
    else:
        bpy.ops.object.gpencil_add(type=kind, radius=0.8)
    obj = bpy.context.object
    obj.location, obj.rotation_euler = (0.6, -1.3, 0.2), (0, 0, 0.6)


def grease_pencil(build: Any) -> None:
    _grease_pencil(build, "MONKEY")


def empty_grease_pencil(build: Any) -> None:
    _grease_pencil(build, "EMPTY")


def point_cloud(build: Any) -> None:
    stage(build)
    cloud = bpy.data.pointclouds.new("Cloud")
    cloud.resize(80)
    places = np.random.default_rng(2).uniform(-0.6, 0.6, (80, 3)).astype(np.float32)
    cloud.attributes["position"].data.foreach_set("vector", places.ravel())
    radius = cloud.attributes.get("radius") or cloud.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", np.full(80, 0.06, np.float32))
    cloud.materials.append(colored(build, "Orange", ORANGE))
    build.place(build.link(bpy.data.objects.new("Cloud", cloud)), location=(0, -1.2, 0.1))


def empty_volume(build: Any) -> None:
    stage(build)
    build.link(bpy.data.objects.new("Volume", bpy.data.volumes.new("Volume")))


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


def painted_instances(build: Any) -> None:
    """Nodes that give their own material to instances of a mesh that they make."""
    stage(build)
    obj = grid(build, "Points", 3, 1.6, location=(0, -0.8, -0.2))
    obj.data.materials.append(colored(build, "Orange", ORANGE))
    tree, (on_points, paint) = build.nodes(
        obj, "GeometryNodeInstanceOnPoints", "GeometryNodeSetMaterial"
    )
    cube = tree.nodes.new("GeometryNodeMeshCube")
    cube.inputs["Size"].default_value = (0.2, 0.2, 0.2)
    tree.links.new(cube.outputs["Mesh"], on_points.inputs["Instance"])
    paint.inputs["Material"].default_value = colored(build, "Cyan", CYAN)


def glass_around(build: Any) -> None:
    """A transparent box around everything, seen from outside."""
    stage(build)
    build.cube("Box", 6.4, location=(0, 0, 1), material=colored(build, "Glass", CYAN, 0.3))
    camera = bpy.context.scene.camera
    camera.location = 1.7 * camera.location


def glass_pane(build: Any) -> None:
    """A transparent pane before less than half of the picture."""
    stage(build)
    build.square(
        "Pane",
        1.1,
        location=(-0.3, -1.7, 0.3),
        rotation=(np.pi / 2, 0, 0.5),
        material=colored(build, "Glass", CYAN, 0.4),
    )


def see_through_object_color(build: Any) -> None:
    stage(build, color_type="OBJECT")
    for name, rgba in (
        ("Red", (0.8, 0.1, 0.1, 1.0)),
        ("Green", (0.1, 0.7, 0.2, 0.4)),
        ("Floor", (0.3, 0.3, 0.3, 1.0)),
    ):
        bpy.data.objects[name].color = rgba


def textured(build: Any) -> None:
    """The solid shading shows textures, and one object has one."""
    stage(build, color_type="TEXTURE")
    material = colored(build, "Checks", ORANGE)
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("Checks", 8, 8)
    checks = np.indices((8, 8)).sum(axis=0) % 2
    pixels = np.where(checks[..., None], (0.1, 0.9, 0.9, 1.0), (0.9, 0.1, 0.9, 1.0))
    node.image.pixels = pixels.ravel().tolist()
    node.image.pack()
    obj = build.cube("Textured", 0.9, location=(0, -1.3, 0.2), material=material)
    uv = obj.data.uv_layers.new(name="UV")
    corners = np.tile([(0, 0), (1, 0), (1, 1), (0, 1)], (6, 1)).astype(np.float32)
    uv.data.foreach_set("uv", corners.ravel())
    material.node_tree.nodes.active = node


def no_active_color(build: Any) -> None:
    """Colours by attribute, and a mesh that has two of which none is the active one."""
    stage(build, color_type="VERTEX")
    obj = bpy.data.objects["Green"]
    build.color_attribute(obj, "CORNER")
    build.color_attribute(bpy.data.objects["Red"], "POINT")
    obj.data.color_attributes.active_color_name = ""


GLASS = (glass_pane, see_through_object_color, textured)


def in_front(build: Any) -> None:
    stage(build)
    behind = build.cube(
        "Behind", 0.8, location=(-0.6, 1.4, -0.3), material=colored(build, "Orange", ORANGE)
    )
    behind.show_in_front = True


def two_in_front(build: Any) -> None:
    in_front(build)
    other = build.cube(
        "Farther", 0.8, location=(-0.9, 2, 0.1), material=colored(build, "Cyan", CYAN)
    )
    other.show_in_front = True


def in_front_and_transparent(build: Any) -> None:
    in_front(build)
    bpy.data.materials["Orange"].diffuse_color[3] = 0.5


IN_FRONT = (in_front, two_in_front, in_front_and_transparent)


def unseen_by_camera_rays(build: Any) -> None:
    """Holdout, indirect only and hidden from the camera: Cycles heeds these, Workbench does not."""
    stage(build)
    bpy.data.objects["Red"].is_holdout = True
    bpy.data.objects["Green"].visible_camera = False
    cube = build.cube(
        "Indirect", 0.7, link=False, location=(0, -1.3, 0), material=colored(build, "Pink", PINK)
    )
    build.collection("Indirect", cube, link=True)
    bpy.context.view_layer.layer_collection.children["Indirect"].indirect_only = True


def holdout(build: Any) -> None:
    stage(build)
    bpy.data.objects["Blue"].is_holdout = True


def camera_looks_away(build: Any) -> None:
    stage(build).camera.rotation_euler = (np.pi, 0, 0)


def all_hidden(build: Any) -> None:
    for obj in stage(build).objects:
        if obj.type == "MESH":
            obj.hide_render = obj.hide_viewport = True


def all_behind(build: Any) -> None:
    camera = stage(build).camera
    camera.rotation_euler.rotate_axis("Y", np.pi)


def no_mesh(build: Any) -> None:
    build.scene()
    build.camera()
    build.empty("Empty")


EMPTY = (camera_looks_away, all_hidden, all_behind, no_mesh)


def fine_edges(build: Any) -> None:
    """Arrays of arrays, mirrored and subdivided: edges in thousands of pixels."""
    stage(build, width=320, height=180)
    for n, rgb in enumerate((ORANGE, CYAN, PINK)):
        obj = build.cube(
            f"Beads {n}",
            0.2,
            location=(0, -0.6, 0.3 * n),
            rotation=(0.3 * n, 0.2, 0.4 * n),
            material=colored(build, f"Beads {n}", rgb),
        )
        for axis in range(2):
            array = obj.modifiers.new("Array", "ARRAY")
            array.count = 6
            array.relative_offset_displace = (1.4, 0, 0) if axis else (0, 1.4, 0)
        mirror = obj.modifiers.new("Mirror", "MIRROR")
        mirror.use_axis = (True, True, False)
        smooth = obj.modifiers.new("Subdivision", "SUBSURF")
        smooth.levels = smooth.render_levels = 2


def depth_of_field(build: Any) -> None:
    camera = stage(build).camera.data
    camera.dof.use_dof, camera.dof.focus_distance = True, 2
    camera.dof.aperture_fstop = 0.2
    bpy.context.scene.display.shading.use_dof = True


def motion_blur(build: Any) -> None:
    scene = stage(build)
    cube = bpy.data.objects["Red"]
    for frame, x in ((1, -2.0), (9, 2.0)):
        cube.location.x = x
        cube.keyframe_insert("location", frame=frame)
    scene.render.use_motion_blur = True
    scene.frame_set(4)


def freestyle(build: Any) -> None:
    stage(build).render.use_freestyle = True


def multiview(build: Any) -> None:
    render = stage(build).render
    render.use_multiview, render.views_format = True, "STEREO_3D"


# What the temporary scene switches off, or Workbench does not draw.
SWITCHED_OFF = (depth_of_field, motion_blur, freestyle, multiview)


def far_from_origin(build: Any) -> None:
    for obj in stage(build).objects:
        obj.location.x += 1e5


def _scaled(build: Any, factor: float) -> None:
    """Meshes of one size, shown in another by their objects' scale, and a camera to match."""
    scene = stage(build)
    for obj in scene.objects:
        obj.location *= factor
        if obj.type == "MESH":
            obj.scale *= factor
    camera = scene.camera.data
    camera.clip_start, camera.clip_end = 0.1 * factor, 100 * factor


def tiny(build: Any) -> None:
    _scaled(build, 1e-3)


def huge(build: Any) -> None:
    _scaled(build, 1e3)


SCALED = (tiny, huge)

ALL = (
    *SIMULATIONS,
    *EDIT_MODE,
    *HAIR,
    hair_everywhere,
    *DRAWS_NOTHING,
    *GLASS,
    glass_around,
    no_active_color,
    *IN_FRONT,
    unseen_by_camera_rays,
    holdout,
    *EMPTY,
    fine_edges,
    painted_instances,
    *SWITCHED_OFF,
    far_from_origin,
    *SCALED,
)

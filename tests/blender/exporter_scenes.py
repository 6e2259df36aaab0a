"""Nineteen scenes for Blender's exporters: what a mesh file may hold, and what it cannot.

Each is a function of the builder and of random numbers, and sets a camera that sees all of it. No
two surfaces coincide: which of them is seen would be chance.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
from mathutils import Euler, Matrix

from .scenes import Build

SIZE = 96, 64
Random = np.random.Generator


def looking(build: Build, scale: float = 1.0, at: tuple[float, ...] = (0, 0, 0)) -> None:
    """A camera that looks down at some 9 x 6 scaled metres around a point, from 16 away."""
    place = Matrix.Translation(at) @ Matrix.Scale(scale, 4)
    turned = Matrix.LocRotScale((4, -13, 8), Euler((1.05, 0.02, 0.3)), None)
    camera = build.camera(lens=58, clip_start=0.5 * scale, clip_end=60 * scale)
    camera.matrix_world = Matrix.LocRotScale(
        (place @ turned).to_translation(), turned.to_quaternion(), None
    )


def turn(rng: Random) -> tuple[float, float, float]:
    x, y, z = rng.uniform(-0.6, 0.6, 3)
    return x, y, z


def grid(
    build: Build,
    rng: Random,
    name: str,
    count: int = 5,
    rough: float = 0.4,
    cut: bool = False,
    **place: Any,
) -> Any:
    """A square of quadrilaterals that are not flat, `cut` into triangles or not."""
    line = np.linspace(-1.5, 1.5, count)
    points = [(x, y, rough * rng.normal()) for x in line for y in line]
    corner = [i * count + j for i in range(count - 1) for j in range(count - 1)]
    faces: list[tuple[int, ...]] = [(k, k + count, k + count + 1, k + 1) for k in corner]
    if cut:
        faces = [half for a, b, c, d in faces for half in ((a, b, c), (a, c, d))]
    return build.place(build.mesh(name, points, faces), **place)


def star(build: Build, rng: Random, name: str, tips: int, **place: Any) -> Any:
    """One polygon, flat and concave."""
    angles = np.arange(2 * tips) * np.pi / tips
    radii = np.where(np.arange(2 * tips) % 2, rng.uniform(0.3, 0.8, 2 * tips), 1.8)
    points = [(r * np.cos(a), r * np.sin(a), 0) for r, a in zip(radii, angles, strict=True)]
    return build.place(build.mesh(name, points, [range(2 * tips)]), **place)


def posed_rig(build: Build, rng: Random) -> None:
    """A mesh that bends where one bone ends."""
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    rig.name = rig.data.name = "Rig"
    bent = grid(build, rng, "Bent", cut=True, scale=(1, 1, 0.3))
    bent.parent = rig
    bent.modifiers.new("Armature", "ARMATURE").object = rig
    group = bent.vertex_groups.new(name="Bone")
    for vertex in bent.data.vertices:
        group.add([vertex.index], max(0.0, vertex.co.x) / 1.5, "REPLACE")
    bone = rig.pose.bones["Bone"]
    bone.rotation_mode, bone.rotation_euler = "XYZ", (0.9, 0.3, 0.2)
    rig.location, rig.rotation_euler = (0.5, 0, 0), turn(rng)
    build.cube("Beside", 1.5, location=(-3, 0, 0), rotation=turn(rng))


def shape_keys(build: Build, rng: Random) -> None:
    """Of triangles: Blender cuts a quadrilateral by its shape, glTF's exporter by its basis."""
    for k in range(3):
        place = {"location": (3 * k - 3, 0, 0), "rotation": turn(rng)}
        obj = grid(build, rng, f"Keyed {k}", cut=True, **place)
        obj.shape_key_add(name="Basis")
        for value in (0.3, 0.0, 0.8):
            key = obj.shape_key_add(name=f"Key {value}")
            for point in key.data:
                point.co.z += 0.6 * rng.normal()
            key.value = value


def collection_instances(build: Build, rng: Random) -> None:
    ball = build.cube("Kit Cube", 1, link=False, rotation=turn(rng))
    flat = build.square("Kit Square", 1.2, link=False, location=(1, 0, 0.4), rotation=turn(rng))
    kit = build.collection("Kit", ball, flat)
    inner = bpy.data.objects.new("Inner", None)
    inner.instance_type, inner.instance_collection, inner.location = "COLLECTION", kit, (0, 1, 1)
    double = build.collection("Double", inner, build.cube("Pole", 0.4, link=False))
    for k, collection in enumerate((kit, double, double)):
        build.instances(f"Copy {k}", collection, location=(3.2 * k - 3, 0, 0), rotation=turn(rng))


def linked_duplicates(build: Build, rng: Random) -> None:
    first = star(build, rng, "First", 5, location=(-3, 0, 0), rotation=turn(rng))
    for k in range(3):
        copy = build.object(f"Copy {k}", first.data)
        copy.location, copy.rotation_euler = (2 * k - 1, 0.5 * k, 0.4 * k), turn(rng)
        copy.scale = rng.uniform(0.5, 1.2, 3)


def node_instances(build: Build, rng: Random) -> None:
    source = build.cube("Source", 1.5, location=(0, 3, 0), rotation=turn(rng))
    points = build.mesh("Points", rng.uniform(-3, 3, (7, 3)) * (1, 0.5, 0.4), [])
    build.instances_on_points(points, source)


def concave(build: Build, rng: Random) -> None:
    for k in range(3):
        star(build, rng, f"Star {k}", 4 + k, location=(3 * k - 3, 0, 0), rotation=turn(rng))
    ell = [(0, 0, 0), (2, 0, 0), (2, 0.5, 0), (0.5, 0.5, 0), (0.5, 2, 0), (0, 2, 0)]
    build.place(build.mesh("Ell", ell, [range(6)]), location=(0, -2, 1), rotation=(1.2, 0, 0.3))


def not_planar(build: Build, rng: Random) -> None:
    grid(build, rng, "Rough", 7, 0.5, location=(-2, 0, 0), rotation=(0.3, 0.2, 0.1))
    grid(build, rng, "Rougher", 4, 1.0, location=(2, 0, 0), rotation=(0.5, 0, 0.4))
    fan = [(np.cos(a), np.sin(a), 0.5 * rng.normal()) for a in np.arange(7) * 2 * np.pi / 7]
    build.place(build.mesh("Bent", fan, [range(7)]), location=(0, -2, 1.5))


def holes(build: Build, rng: Random) -> None:
    """One polygon around a hole, with a bridge to it, and two that enclose another one."""
    outer = [(-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0), (-1.5, -1.5, 0)]
    inner = [(-0.6, -0.6, 0), (-0.6, 0.6, 0), (0.6, 0.6, 0), (0.6, -0.6, 0), (-0.6, -0.6, 0)]
    bridged = build.mesh("Bridged", outer + inner, [range(10)])
    build.place(bridged, location=(-2, 0, 0), rotation=(0.3, 0.2, 0))
    faces = (0, 1, 2, 6, 5, 8), (2, 3, 0, 8, 7, 6)
    halves = build.mesh("Halves", [*outer[:4], (0, 0, -1), *inner[3::-1]], faces)
    build.place(halves, location=(2, 0, 0), rotation=turn(rng))
    build.cube("Behind", 1, location=(-2, 3, 0))


def scales(build: Build, rng: Random) -> None:
    for k, scale in enumerate(((-1, 1, 1), (1.5, 0.3, 1), (-0.7, -1.2, 0.5), (-1, -1, -1))):
        place = {"location": (2.2 * k - 3.3, 0, 0), "rotation": turn(rng), "scale": scale}
        grid(build, rng, f"Scaled {k}", 3, 0.3, **place)


def parents(build: Build, rng: Random) -> None:
    """One that shears its child, and one that mirrors it."""
    for k, scale in enumerate(((2, 0.6, 1), (-1, 1, 1))):
        place = {"location": (4 * k - 2, 0, 0), "rotation": turn(rng), "scale": scale}
        parent = build.cube(f"Parent {k}", 1, **place)
        child = star(build, rng, f"Child {k}", 5, location=(0.3, 0, 1), rotation=(0.5, 0.6, 0.7))
        child.parent = parent
        child.matrix_parent_inverse = Matrix.Translation((0.3, 0.2, 0.1))


def modifiers(build: Build, rng: Random) -> None:
    smooth = build.cube("Smooth", 2, location=(-3, 0, 0), rotation=turn(rng))
    levels = smooth.modifiers.new("Subdivision", "SUBSURF")
    levels.levels = levels.render_levels = 2
    row = build.cube("Row", 0.7, location=(-0.5, -1, 0), rotation=turn(rng))
    row.modifiers.new("Array", "ARRAY").count = 3
    cut = build.cube("Cut", 2, location=(3, 0, 0), rotation=turn(rng))
    knife = build.cube("Knife", 1.2, location=(3.5, -0.8, 0.8), rotation=turn(rng))
    knife.hide_render = True
    knife.hide_set(True)
    boolean = cut.modifiers.new("Boolean", "BOOLEAN")
    boolean.object, boolean.solver = knife, "EXACT"


def curves(build: Build, rng: Random) -> None:
    build.text("Text", location=(-3, 0, 0), rotation=(1.2, 0, 0.2), scale=(2, 2, 2))
    build.bevelled_curve("Curve", location=(1.5, -1, 0), rotation=turn(rng))
    build.surface("Surface", location=(2.5, 1.5, 0.5), rotation=turn(rng))


def metaballs(build: Build, rng: Random) -> None:
    build.metaball("Metaball", location=(-2, 0, 0), rotation=turn(rng))
    build.cube("Beside", 1.5, location=(2, 0, 0), rotation=turn(rng))


def tiny(build: Build, rng: Random, size: float = 1e-4) -> None:
    for k in range(3):
        obj = grid(build, rng, f"Part {k}", 4, 0.3, rotation=turn(rng), scale=(size,) * 3)
        obj.location.x = (3 * k - 3) * size
    looking(build, size)


def huge(build: Build, rng: Random) -> None:
    tiny(build, rng, 1e6)


def far_away(build: Build, rng: Random) -> None:
    at = 20000.0, -30000.0, 5000.0
    for k in range(3):
        build.cube(f"Far {k}", 1.5, location=(at[0] + 3 * k - 3, *at[1:]), rotation=turn(rng))
    looking(build, at=at)


def materials_and_loose(build: Build, rng: Random) -> None:
    painted = grid(build, rng, "Painted", 4, 0.3, location=(-2, 0, 0))
    for k in range(3):
        painted.data.materials.append(build.material(f"Colour {k}", *rng.random(3)))
    for face in painted.data.polygons:
        face.material_index = face.index % 3
    points = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (2, 2, 1), (0, 0, 2), (3, 0, 2)]
    mesh = bpy.data.meshes.new("Loose")
    mesh.from_pydata(points, [(3, 4), (4, 5)], [(0, 1, 2)])
    build.object("Loose", mesh, location=(1.5, 0, 0))


def hidden_and_empty(build: Build, rng: Random) -> None:
    build.cube("Seen", 2, rotation=turn(rng))
    hidden = build.cube("Hidden", 1, location=(3, -1, 0))
    off = build.cube("Off", 1, location=(-3, -1, 0))
    excluded = build.cube("Excluded", 1, link=False, location=(0, -2, 1))
    aside = build.collection("Aside", excluded, link=True)
    build.mesh("Empty", [], [])
    build.mesh("Points Alone", [(1, 1, 1), (2, 2, 2)], [])
    bpy.context.view_layer.update()  # what is hidden stays where it was evaluated last
    hidden.hide_set(True)
    off.hide_viewport = off.hide_render = True
    bpy.context.view_layer.layer_collection.children[aside.name].exclude = True


def names(build: Build, rng: Random) -> None:
    for k, name in enumerate(("Größe mit Lücke", "立方 体", "a  two spaces", 'o #1 "x" \\y')):
        build.cube(name, 1.3, location=(2.3 * k - 3.4, 0, 0), rotation=turn(rng))


SCENES: dict[str, Callable[[Build, Random], None]] = {
    make.__name__: make
    for make in (
        posed_rig,
        shape_keys,
        collection_instances,
        linked_duplicates,
        node_instances,
        concave,
        not_planar,
        holes,
        scales,
        parents,
        modifiers,
        curves,
        metaballs,
        tiny,
        huge,
        far_away,
        materials_and_loose,
        hidden_and_empty,
        names,
    )
}


def make_scene(name: str, build: Build, seed: int = 0) -> None:
    """Make a scene in the empty file that is open."""
    build.scene(*SIZE)
    rng = np.random.default_rng((seed, *name.encode()))
    SCENES[name](build, rng)
    if bpy.context.scene.camera is None:
        looking(build)
    bpy.context.view_layer.update()

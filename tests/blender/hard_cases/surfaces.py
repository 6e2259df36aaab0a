"""Surfaces that Blender draws otherwise: see-through, in front, not at all."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from .stage import CYAN, ORANGE, PINK, colored, grid, stage


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

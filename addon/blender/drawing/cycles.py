"""Cycles drawing the same constant colours: one emission material over a whole view layer.

Materials are the user's own, so nothing of them is changed. The override material asks for the
viewport colour of the face's slot by its data path, and lives as long as one picture. So long the
camera has no depth of field, and random colours are the objects' own.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from ...scene import GREY, SceneError
from ..reading.colors import random_color
from ..versions import WITHOUT_ATTRIBUTE
from .temporary import drawn, in_colors

SLOTS = 32  # material slots that are told apart: each is some nodes


@contextmanager
def constant_colors(scene: Any, layer: str, sample_radius: float) -> Iterator[None]:
    """Set a temporary scene up to be drawn by Cycles in constant colours.

    Its samples are at most `sample_radius` pixels from their pixel's centre: 0.005 is the least.

    Raises
    ------
    SceneError
        If the colours are ones that a material cannot ask for.
    """
    if scene.display.shading.color_type == "RANDOM":
        scene.view_layers[layer].update()  # or its list lacks the stand-ins of infinite planes
        objects = drawn(scene, layer)
        colors = np.array([random_color(o)[:3] for o in objects]).reshape(-1, 3)
        scene.display.shading.color_type = "OBJECT"
        with in_colors(objects, colors), constant_colors(scene, layer, sample_radius):
            yield
        return
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 2 * sample_radius
    lens = scene.camera.data.dof
    material, blurred = bpy.data.materials.new("Reference Tracer Constant"), lens.use_dof
    try:
        lens.use_dof = False
        _emission(material, scene)
        scene.view_layers[layer].material_override = material
        yield
    finally:
        bpy.data.materials.remove(material)
        lens.use_dof = blurred


def _emission(material: Any, scene: Any) -> None:
    material.use_nodes = True
    tree, shading = material.node_tree, scene.display.shading
    tree.nodes.clear()
    emission = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    color = emission.inputs["Color"]
    if shading.color_type == "SINGLE":
        color.default_value = (*shading.single_color, 1.0)
    else:
        made = {"OBJECT": _object_color, "VERTEX": _vertex_color}
        tree.links.new(made.get(shading.color_type, _material_color)(tree), color)


def _object_color(tree: Any) -> Any:
    return _attribute(tree, "OBJECT", "color").outputs["Color"]


def _vertex_color(tree: Any) -> Any:
    """Return a socket: the active colour attribute, or what is shown of a mesh without one."""
    without = _material_color if WITHOUT_ATTRIBUTE == "MATERIAL" else _object_color
    found = without(tree)
    # By name: Cycles itself would take the one that is active for renders.
    for name in sorted({m.color_attributes.active_color_name for m in bpy.data.meshes} - {""}):
        node = tree.nodes.new("ShaderNodeVertexColor")  # alpha 0 where a mesh has none of this name
        node.layer_name = name
        found = _where_found(tree, node, found)
    return found


def _material_color(tree: Any) -> Any:
    """Return a socket: the viewport colour of the material in the face's slot, grey where empty."""
    slot = _attribute(tree, "GEOMETRY", "material_index").outputs["Fac"]
    owners = [*bpy.data.objects, *bpy.data.meshes]  # instances may be of objects elsewhere
    count = max(
        (len(getattr(o, "material_slots", getattr(o, "materials", ()))) for o in owners), default=0
    )
    if any(m.type == "NODES" for o in bpy.data.objects for m in o.modifiers):
        count = max(count, min(len(bpy.data.materials), SLOTS))  # a mesh may get any of them
    if count > SLOTS:
        raise SceneError(
            f"A mesh has {count} material slots, and Cycles can be asked for {SLOTS} viewport "
            "colours: set the colour of the scene's solid shading to object, or compare with "
            "Workbench."
        )
    grey = tree.nodes.new("ShaderNodeRGB").outputs[0]
    grey.default_value = GREY
    color = grey
    for index in reversed(range(max(count, 1))):
        found = grey  # first what geometry nodes gave to the mesh, then what the object shows
        for path in (
            f"data.materials[{index}].diffuse_color",
            f"material_slots[{index}].material.diffuse_color",
        ):
            found = _where_found(tree, _attribute(tree, "OBJECT", path), found)
        after = _greater(tree, slot, index + 0.5)
        color = _mix(tree, after, found, color if color is not grey else found)
    return color


def _attribute(tree: Any, kind: str, name: str) -> Any:
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_type, node.attribute_name = kind, name
    return node


def _where_found(tree: Any, node: Any, otherwise: Any) -> Any:
    """Return the colour of an attribute node, or the other where its alpha says there is none."""
    there = _greater(tree, node.outputs["Alpha"], 0.0)
    return _mix(tree, there, otherwise, node.outputs["Color"])


def _greater(tree: Any, socket: Any, limit: float) -> Any:
    node = tree.nodes.new("ShaderNodeMath")
    node.operation, node.inputs[1].default_value = "GREATER_THAN", limit
    tree.links.new(socket, node.inputs[0])
    return node.outputs[0]


def _mix(tree: Any, factor: Any, first: Any, second: Any) -> Any:
    node = tree.nodes.new("ShaderNodeMix")
    node.data_type = "RGBA"
    for index, value in ((0, factor), (6, first), (7, second)):
        tree.links.new(value, node.inputs[index])
    return node.outputs[2]

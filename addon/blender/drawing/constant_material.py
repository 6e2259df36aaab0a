"""Shows the viewport's constant colours in an engine that draws materials.

One emission material is the override of a whole view layer, since materials are the user's own and
stay as they are. It asks for the viewport colour of the face's slot by its data path. It lives as
long as one picture. For as long, the camera has no depth of field, and random colours are set as
the objects' own.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import bpy
import numpy as np

from ...scene import GREY, SceneError
from ..reading.colors import random_color
from ..temporary import drawn
from ..values import in_colors
from ..versions import WITHOUT_ATTRIBUTE

SLOTS = 32  # material slots that are told apart: each is some nodes


@contextmanager
def constant_colors(scene: Any, layer: str) -> Iterator[None]:
    """Have an engine with materials draw a temporary scene in constant colours, for a while.

    Raises
    ------
    SceneError
        If the colours are ones that a material cannot ask for.
    """
    with ExitStack() as stack:
        if scene.display.shading.color_type == "RANDOM":
            scene.view_layers[layer].update()  # or its list lacks the stand-ins of infinite planes
            objects = drawn(scene, layer)
            colors = np.array([random_color(o)[:3] for o in objects], np.float32).reshape(-1, 3)
            scene.display.shading.color_type = "OBJECT"
            stack.enter_context(in_colors(objects, colors))
        lens = scene.camera.data.dof
        material = bpy.data.materials.new("Reference Tracer Constant")
        blurred = lens.use_dof
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
    tree = material.node_tree
    shading = scene.display.shading
    tree.nodes.clear()
    emission = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    color = emission.inputs["Color"]
    if shading.color_type == "SINGLE":
        color.default_value = (*shading.single_color, 1.0)
    else:
        by_type = {"OBJECT": _object_color, "VERTEX": _vertex_color}
        make = by_type.get(shading.color_type, _material_color)
        tree.links.new(make(tree), color)


def _object_color(tree: Any) -> Any:
    return _attribute(tree, "OBJECT", "color").outputs["Color"]


def _vertex_color(tree: Any) -> Any:
    """Return a socket: the active colour attribute, or what is shown of a mesh without one."""
    without = _material_color if WITHOUT_ATTRIBUTE == "MATERIAL" else _object_color
    found = without(tree)
    # By name: Cycles itself would take the one that is active for renders.
    names = {m.color_attributes.active_color_name or "" for m in bpy.data.meshes}
    for name in sorted(names - {""}):
        node = tree.nodes.new("ShaderNodeVertexColor")  # alpha 0 where a mesh has none of this name
        node.layer_name = name
        found = _where_found(tree, node, found)
    return found


def _material_color(tree: Any) -> Any:
    """Return a socket: the viewport colour of the material in the face's slot, grey where empty."""
    grey = tree.nodes.new("ShaderNodeRGB").outputs[0]
    grey.default_value = GREY
    slot = _attribute(tree, "GEOMETRY", "material_index").outputs["Fac"]
    color = _color_of_slot(tree, 0, grey)
    for index in range(1, _slot_count()):
        is_behind = _greater(tree, slot, index - 0.5)
        color = _mix(tree, is_behind, color, _color_of_slot(tree, index, grey))
    return color


def _color_of_slot(tree: Any, index: int, grey: Any) -> Any:
    """Return a socket: the viewport colour of one slot's material, grey without one."""
    found = grey  # first what geometry nodes gave to the mesh, then what the object shows
    for path in (
        f"data.materials[{index}].diffuse_color",
        f"material_slots[{index}].material.diffuse_color",
    ):
        found = _where_found(tree, _attribute(tree, "OBJECT", path), found)
    return found


def _slot_count() -> int:
    """Return how many material slots a mesh in the file has at most, at least one."""
    slots = [len(o.material_slots) for o in bpy.data.objects]  # instances may be of any object
    count = max([1, *slots, *(len(mesh.materials) for mesh in bpy.data.meshes)])
    if any(m.type == "NODES" for o in bpy.data.objects for m in o.modifiers):
        count = max(count, min(len(bpy.data.materials), SLOTS))  # a mesh may get any of them
    if count > SLOTS:
        raise SceneError(
            f"A mesh has {count} material slots, and Cycles can be asked for {SLOTS} viewport "
            "colours: set the colour of the scene's solid shading to object, or compare with "
            "Workbench."
        )
    return count


def _attribute(tree: Any, kind: str, name: str) -> Any:
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_type = kind
    node.attribute_name = name
    return node


def _where_found(tree: Any, node: Any, otherwise: Any) -> Any:
    """Return the colour of an attribute node, or the other where its alpha says there is none."""
    there = _greater(tree, node.outputs["Alpha"], 0.0)
    return _mix(tree, there, otherwise, node.outputs["Color"])


def _greater(tree: Any, socket: Any, limit: float) -> Any:
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = "GREATER_THAN"
    node.inputs[1].default_value = limit
    tree.links.new(socket, node.inputs[0])
    return node.outputs[0]


def _mix(tree: Any, factor: Any, first: Any, second: Any) -> Any:
    node = tree.nodes.new("ShaderNodeMix")
    node.data_type = "RGBA"
    for index, value in ((0, factor), (6, first), (7, second)):
        tree.links.new(value, node.inputs[index])
    return node.outputs[2]

"""Shows the viewport's constant colours in an engine that draws materials.

One emission material is the override of a whole view layer, since materials are the user's own and
stay as they are. It asks for the viewport colour of the face's slot by its data path. As they are
evaluated, the camera has no depth of field and sees no lights, and random colours are the objects'
own. The temporary scene has no world: one may hold a fog.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, NamedTuple

import bpy
from bpy.types import Depsgraph, Material, Node, NodeSocket, NodeTree, Object, Scene

from ...scene import GREY, SceneError
from ...scene import Scene as Traced
from ..reading.colors import random_color, slot_materials
from ..temporary import made_for, show_in
from ..values import is_animated
from ..versions import WITHOUT_ATTRIBUTE

Color = tuple[float, ...]
SLOTS = 32  # material slots that are distinguished: each is some nodes
_BORROWING = "BOOLEAN", "DATA_TRANSFER", "NODES"  # modifiers that take attributes of other meshes
_OF_MESH = "data.materials[{}].diffuse_color"  # what geometry nodes gave to it
_OF_OBJECT = "material_slots[{}].material.diffuse_color"


def constant_colors(scene: Scene, depsgraph: Depsgraph) -> None:
    """Have an engine with materials draw a temporary scene's evaluation in constant colours.

    Raises
    ------
    SceneError
        If the colours are ones that a material cannot ask for.
    """
    # Once a script has read an evaluated object, Blender tells an engine in Python its own colour,
    # not that of what instances it. So all objects are read only where instances are refused.
    if scene.display.shading.color_type == "RANDOM":
        objects = (block for block in depsgraph.ids if isinstance(block, Object))
        show_in(scene, depsgraph, {o.original.name_full: random_color(o)[:3] for o in objects})
    for lamp in (o.evaluated_get(depsgraph) for o in bpy.data.objects if o.type == "LIGHT"):
        if lamp.is_evaluated:  # else it is the user's, and not drawn
            lamp.visible_camera = False
    scene.camera.evaluated_get(depsgraph).data.dof.use_dof = False
    material = made_for(scene, bpy.data.materials.new("Reference Tracer Constant"))
    _emit(material, scene, depsgraph)
    scene.world = None
    [layer] = scene.view_layers
    layer.use_solid = True
    layer.material_override = material


def check_slots(scene: Traced, color_type: str) -> None:
    """Refuse faces of a slot that their object lacks and another one has: they would be black.

    The solid viewport shows them in the last slot's colour, which no material can ask for.

    Raises
    ------
    SceneError
        If there are such faces.
    """
    by_slots = {"MATERIAL", "VERTEX"} if WITHOUT_ATTRIBUTE == "MATERIAL" else {"MATERIAL"}
    if color_type not in by_slots:
        return
    counts = [len(obj.material_slots) for obj in bpy.data.objects]
    most = max(*counts, *(len(instance.colors) for instance in scene.instances), 0)
    for instance in scene.instances:
        mesh = scene.meshes[instance.mesh]
        lacking = (mesh.slots >= len(instance.colors)) & (mesh.slots < most)
        if mesh.corner_colors is None and lacking.any():
            raise SceneError(
                f"'{scene.objects[instance.object]}' has faces of a material slot that it does not "
                "have: give them another slot, set Colors to Object, or compare with Workbench."
            )


def emission(material: Material) -> Any:
    """Have a material emit, and nothing else; return the socket of the colour."""
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return node.inputs["Color"]


def _emit(material: Material, scene: Any, depsgraph: Depsgraph) -> None:
    """Have a material emit the colours of a scene's solid shading."""
    color = emission(material)
    tree = material.node_tree
    shading = scene.display.shading
    if shading.color_type == "SINGLE":
        color.default_value = (*shading.single_color, 1.0)
    else:
        objects = scene.view_layers[0].objects
        tree.links.new(_color(tree, shading.color_type, depsgraph, objects), color)


def _color(
    tree: NodeTree, color_type: str, depsgraph: Depsgraph, objects: Collection[Any]
) -> NodeSocket:
    """Return a socket: the colour by a type of the solid shading.

    By vertices, it is the active colour attribute, or what is shown of a mesh without one.
    """
    if color_type == "OBJECT":
        return _attribute(tree, "OBJECT", "color").outputs["Color"]
    if color_type != "VERTEX":
        return _material_color(tree, depsgraph)
    found = _color(tree, WITHOUT_ATTRIBUTE, depsgraph, objects)
    # By name: Cycles itself would take the one that is active for renders.
    for name in sorted(attribute_names(objects)):
        # Its alpha is 0 where a mesh has none of this name.
        node: Any = tree.nodes.new("ShaderNodeVertexColor")
        node.layer_name = name
        found = _where_found(tree, node, found)
    return found


def attribute_names(objects: Collection[Any]) -> set[str]:
    """Return the active colour attributes of what is rendered: these the material asks for.

    Of a view layer's objects. Where some of them instance, or take geometry from elsewhere, these
    are the attributes of all meshes of the file.
    """
    if any(_takes_from_elsewhere(o) for o in objects):
        meshes = set(bpy.data.meshes)
    else:
        rendered = (o for o in objects if not o.hide_render or is_animated(o, "hide_render"))
        meshes = {o.data for o in rendered if o.type == "MESH"}
    return {m.color_attributes.active_color_name or "" for m in meshes} - {""}


def _takes_from_elsewhere(obj: Object) -> bool:
    borrows = any(m.type in _BORROWING for m in obj.modifiers)
    return borrows or obj.instance_type != "NONE" or len(obj.particle_systems) > 0


class _Slots(NamedTuple):
    """The colours of each material slot in the file, and the data paths to them."""

    colors: list[set[Color | None]]  # of materials; None where there is no material
    paths: tuple[str, ...]  # of a material's viewport colour, for an object and its slot

    def add(self, obj: Object) -> None:
        """Add the slots of an object; it may be an evaluated one."""
        if not hasattr(obj.data, "materials"):
            return
        materials = slot_materials(obj) or [None]
        self.colors.extend(set() for _ in range(len(materials) - len(self.colors)))
        for colors, material in zip(self.colors, materials, strict=False):
            colors.add((*material.diffuse_color,) if material else None)
            if material and is_animated(material, "diffuse_color"):
                colors.add(())  # what it is by then


def _slots_of(depsgraph: Depsgraph) -> _Slots:
    """Return what an evaluated scene, and the file, may show in material slots, at least in one.

    Raises
    ------
    SceneError
        If there are more slots than a material can ask for.
    """
    is_made = any(m.type == "NODES" for o in bpy.data.objects for m in o.modifiers)
    slots = _Slots([set()], (_OF_MESH, _OF_OBJECT) if is_made else (_OF_OBJECT,))
    for obj in bpy.data.objects:  # instances may be of any object
        slots.add(obj)
    if is_made:
        for instance in depsgraph.object_instances:
            slots.add(instance.object)
    if len(slots.colors) > SLOTS:
        raise SceneError(
            f"A mesh has {len(slots.colors)} material slots, and a material can be asked for "
            f"{SLOTS} viewport colours: set the colour of the scene's solid shading to object, or "
            "compare with Workbench."
        )
    return slots


def _material_color(tree: NodeTree, depsgraph: Depsgraph) -> NodeSocket:
    """Return a socket: the viewport colour of the material in the face's slot, grey where empty."""
    slots = _slots_of(depsgraph)
    slot = _attribute(tree, "GEOMETRY", "material_index").outputs["Fac"]
    color = _color_of_slot(tree, 0, slots)
    for index in range(1, len(slots.colors)):
        is_behind = _greater(tree, slot, index - 0.5)
        color = _mix(tree, is_behind, color, _color_of_slot(tree, index, slots))
    return color


def _color_of_slot(tree: NodeTree, index: int, slots: _Slots) -> NodeSocket:
    """Return a socket: the viewport colour of one slot's material, grey without one.

    Asks only what is needed: each question makes EEVEE's shader take seconds more to compile.
    """
    colors = slots.colors[index]
    asked = slots.paths if len(colors) > 1 else ()
    nodes = [_attribute(tree, "OBJECT", path.format(index)) for path in asked]
    if len(nodes) == 1 and None not in colors:
        return nodes[0].outputs["Color"]
    found: Any = tree.nodes.new("ShaderNodeRGB").outputs[0]
    [color, *others] = colors or {None}
    found.default_value = GREY if others or color is None else color
    for node in nodes:
        found = _where_found(tree, node, found)
    return found


def _attribute(tree: NodeTree, kind: str, name: str) -> Node:
    node: Any = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_type = kind
    node.attribute_name = name
    return node


def _where_found(tree: NodeTree, node: Node, otherwise: Any) -> NodeSocket:
    """Return the colour of an attribute node, or the other where its alpha says there is none."""
    there = _greater(tree, node.outputs["Alpha"], 0.0)
    return _mix(tree, there, otherwise, node.outputs["Color"])


def _greater(tree: NodeTree, socket: Any, limit: float) -> NodeSocket:
    node: Any = tree.nodes.new("ShaderNodeMath")
    node.operation = "GREATER_THAN"
    node.inputs[1].default_value = limit
    tree.links.new(socket, node.inputs[0])
    return node.outputs[0]


def _mix(tree: NodeTree, factor: Any, first: Any, second: Any) -> NodeSocket:
    node: Any = tree.nodes.new("ShaderNodeMix")
    node.data_type = "RGBA"
    for index, value in ((0, factor), (6, first), (7, second)):
        tree.links.new(value, node.inputs[index])
    return node.outputs[2]

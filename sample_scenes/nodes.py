"""Geometry nodes for the sample scenes: node trees, and the collections that they instance."""

from __future__ import annotations

import bpy


def hidden_collection(name: str) -> bpy.types.Collection:
    """Add a collection that the view layer leaves out: it shows only where it is instanced."""
    collection = bpy.data.collections.new(name)
    bpy.context.scene.collection.children.link(collection)
    bpy.context.view_layer.layer_collection.children[name].exclude = True
    return collection


class Tree:
    """A geometry node tree on an object, with its group input and output."""

    def __init__(self, obj: bpy.types.Object, name: str) -> None:
        self.group = bpy.data.node_groups.new(name, "GeometryNodeTree")
        for way in ("INPUT", "OUTPUT"):
            self.group.interface.new_socket(
                "Geometry", in_out=way, socket_type="NodeSocketGeometry"
            )
        self.input = self.add("NodeGroupInput")
        self.output = self.add("NodeGroupOutput")
        obj.modifiers.new(name, "NODES").node_group = self.group

    def add(self, kind: str, settings: dict | None = None, **inputs) -> bpy.types.Node:
        """Add a node; `settings` are its properties.

        `inputs` are its sockets, with _ for a space: a value, or the node or socket to link.
        """
        node = self.group.nodes.new(kind)
        node.location = (180 * (len(self.group.nodes) - 1), 0)
        for name, value in (settings or {}).items():
            setattr(node, name, value)
        for name, value in inputs.items():
            wanted = name.replace("_", " ")
            socket = next(s for s in node.inputs if s.name == wanted and s.enabled)
            if isinstance(value, bpy.types.Node):
                value = next(s for s in value.outputs if s.enabled)
            if isinstance(value, bpy.types.NodeSocket):
                self.group.links.new(value, socket)
            else:
                socket.default_value = value
        return node

    def attribute(self, name: str, form: str = "FLOAT") -> bpy.types.Node:
        """Add a node that reads a named attribute."""
        return self.add("GeometryNodeInputNamedAttribute", {"data_type": form}, Name=name)

    def finish(self, node: bpy.types.Node) -> None:
        """Make this node's geometry the result."""
        self.group.links.new(next(s for s in node.outputs if s.enabled), self.output.inputs[0])


def instances_on_points(points: bpy.types.Object, kinds: bpy.types.Collection) -> None:
    """Instance a member of `kinds` on each vertex, by the vertex's attributes kind, size, turn."""
    tree = Tree(points, "Instances On Points")
    members = tree.add(
        "GeometryNodeCollectionInfo", Collection=kinds, Separate_Children=True, Reset_Children=True
    )
    turn = tree.add("ShaderNodeCombineXYZ", Z=tree.attribute("turn"))
    tree.finish(
        tree.add(
            "GeometryNodeInstanceOnPoints",
            Points=tree.input,
            Instance=members,
            Pick_Instance=True,
            Instance_Index=tree.attribute("kind", "INT"),
            Rotation=turn,
            Scale=tree.attribute("size"),
        )
    )


def ripple(obj: bpy.types.Object) -> None:
    """Raise the object's own vertices in rings."""
    tree = Tree(obj, "Ripple")
    far = tree.add(
        "ShaderNodeVectorMath",
        {"operation": "LENGTH"},
        Vector=tree.add("GeometryNodeInputPosition"),
    )
    rings = tree.add("ShaderNodeMath", {"operation": "MULTIPLY"}, Value=far.outputs["Value"])
    rings.inputs[1].default_value = 4.0
    wave = tree.add("ShaderNodeMath", {"operation": "SINE"}, Value=rings)
    rise = tree.add("ShaderNodeMath", {"operation": "MULTIPLY"}, Value=wave)
    rise.inputs[1].default_value = 0.12
    tree.finish(
        tree.add(
            "GeometryNodeSetPosition",
            Geometry=tree.input,
            Offset=tree.add("ShaderNodeCombineXYZ", Z=rise),
        )
    )


def crown(obj: bpy.types.Object, member: bpy.types.Object, radius: float) -> None:
    """Put instances of `member` on a circle in place of the geometry, every other one mirrored."""
    tree = Tree(obj, "Crown")
    odd = tree.add(
        "ShaderNodeMath", {"operation": "MODULO"}, Value=tree.add("GeometryNodeInputIndex")
    )
    odd.inputs[1].default_value = 2.0
    flip = tree.add("ShaderNodeMath", {"operation": "MULTIPLY_ADD"}, Value=odd)
    flip.inputs[1].default_value, flip.inputs[2].default_value = -1.5, 1.0  # 1 or -0.5
    tree.finish(
        _on_circle(tree, member, radius, tree.add("ShaderNodeCombineXYZ", X=1.0, Y=1.0, Z=flip))
    )


def realised_crown(obj: bpy.types.Object, member: bpy.types.Object, radius: float) -> None:
    """Add a circle of `member` made real, coloured by its height, to the object's geometry.

    The object's own mesh, joined last, says which colour attribute is the active one. A mesh from
    nodes alone has none active: Blender 4.2 and 5.0 draw it black, 5.2 in its first attribute.
    """
    tree = Tree(obj, "Realised Crown")
    real = tree.add(
        "GeometryNodeRealizeInstances", Geometry=_on_circle(tree, member, radius, (1.4, 1.4, 1.4))
    )
    place = tree.add("ShaderNodeSeparateXYZ", Vector=tree.add("GeometryNodeInputPosition"))
    height = tree.add("ShaderNodeMath", {"operation": "MULTIPLY"}, Value=place.outputs["Z"])
    height.inputs[1].default_value = 1.4
    colour = tree.add("FunctionNodeCombineColor", Red=1.0, Green=height, Blue=0.25)
    store = tree.add(
        "GeometryNodeStoreNamedAttribute",
        {"data_type": "FLOAT_COLOR", "domain": "POINT"},
        Geometry=real,
        Name="Colour",
        Value=colour,
    )
    both = tree.add("GeometryNodeJoinGeometry", Geometry=store)
    tree.group.links.new(tree.input.outputs[0], both.inputs[0])
    tree.finish(both)


def _on_circle(tree: Tree, member: bpy.types.Object, radius: float, scale) -> bpy.types.Node:
    circle = tree.add("GeometryNodeMeshCircle", Vertices=24, Radius=radius)
    source = tree.add("GeometryNodeObjectInfo", Object=member, As_Instance=True)
    return tree.add(
        "GeometryNodeInstanceOnPoints",
        Points=circle,
        Instance=source.outputs["Geometry"],
        Scale=scale,
    )

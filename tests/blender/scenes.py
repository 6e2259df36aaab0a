"""Small Blender scenes, a thing in a line each."""

from __future__ import annotations

from collections.abc import Collection
from itertools import pairwise
from typing import Any

import bpy
import numpy as np
from mathutils import Euler, Matrix

HALF_FLOAT = 2 * 2.0**-11  # Blender hands its colours over in 11 bits: two roundings up to 1
SAME = 1e-5  # metres: what float32 sines and cosines of different Blender builds may differ by

CUBE_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def save(path: Any) -> None:
    """Save the open file."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path))


class Build:
    """Small scenes: each method adds one thing to the scene and returns it."""

    def scene(self, width: int = 96, height: int = 54, color_type: str = "MATERIAL") -> Any:
        scene = bpy.context.scene
        scene.render.resolution_x, scene.render.resolution_y = width, height
        scene.render.resolution_percentage = 100
        scene.display.shading.color_type = color_type
        return scene

    def link(self, obj: Any, collection: Any = None) -> Any:
        (collection or bpy.context.scene.collection).objects.link(obj)
        return obj

    def object(self, name: str, data: Any = None, **place: Any) -> Any:
        return self.place(self.link(bpy.data.objects.new(name, data)), **place)

    def camera(self, location=(0.0, 0.0, 5.0), rotation=(0.0, 0.0, 0.0), **data: Any) -> Any:
        """By default straight above the origin, looking down, +Y upwards in the picture."""
        camera = bpy.data.cameras.new("Camera")
        for name, value in data.items():
            setattr(camera, name, value)
        obj = self.object("Camera", camera)
        obj.location, obj.rotation_euler = location, rotation
        bpy.context.scene.camera = obj
        return obj

    def far_camera(self) -> Any:
        """A camera that sees everything within ten metres of the origin: all of it is exported."""
        return self.camera((0.0, 0.0, 50.0), lens=18)

    def mesh(self, name: str, vertices: Any, faces: Any, link: bool = True) -> Any:
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [tuple(f) for f in faces])
        obj = bpy.data.objects.new(name, mesh)
        return self.link(obj) if link else obj

    def square(
        self, name: str = "Square", size: float = 2.0, link: bool = True, **place: Any
    ) -> Any:
        h = size / 2
        obj = self.mesh(
            name, [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2, 3)], link
        )
        return self.place(obj, **place)

    def cube(self, name: str = "Cube", size: float = 2.0, link: bool = True, **place: Any) -> Any:
        h = size / 2
        corners = [(x, y, z) for x in (-h, h) for y in (-h, h) for z in (-h, h)]
        return self.place(self.mesh(name, corners, CUBE_FACES, link), **place)

    def place(
        self,
        obj: Any,
        location=(0, 0, 0),
        rotation=(0, 0, 0),
        scale=(1, 1, 1),
        material: Any = None,
        color: Any = None,
    ) -> Any:
        obj.matrix_basis = Matrix.LocRotScale(location, Euler(rotation), scale)
        if material is not None:
            obj.data.materials.append(material)
        if color is not None:
            obj.color = color
        return obj

    def material(self, name: str, *rgba: float) -> Any:
        material = bpy.data.materials.new(name)
        material.diffuse_color = (*rgba, 1.0)[:4]
        return material

    def empty(self, name: str, **place: Any) -> Any:
        return self.object(name, **place)

    def instances(self, name: str, collection: Any, **place: Any) -> Any:
        """An empty that shows a collection."""
        empty = self.empty(name, **place)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection
        return empty

    def collection(self, name: str, *objects: Any, link: bool = False) -> Any:
        collection = bpy.data.collections.new(name)
        for obj in objects:
            collection.objects.link(obj)
        if link:
            bpy.context.scene.collection.children.link(collection)
        return collection

    def nodes(self, obj: Any, *names: str) -> tuple[Any, Any]:
        """Give an object a modifier of new geometry nodes, linked one behind the other.

        Returns their tree and nodes. The first takes the object's own geometry, if it takes any.
        """
        tree = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
        for direction in ("INPUT", "OUTPUT"):
            tree.interface.new_socket(
                "Geometry", in_out=direction, socket_type="NodeSocketGeometry"
            )
        nodes = [tree.nodes.new(name) for name in ("NodeGroupInput", *names, "NodeGroupOutput")]
        for first, second in pairwise(nodes):
            sockets = [s for s in second.inputs if s.type == "GEOMETRY"]
            if sockets:
                tree.links.new(first.outputs[0], sockets[0])
        obj.modifiers.new("Nodes", "NODES").node_group = tree
        return tree, nodes[1:-1]

    def instances_on_points(self, obj: Any, source: Any) -> None:
        """Have geometry nodes put an object, or a primitive by its node's name, on the points."""
        tree, (on_points,) = self.nodes(obj, "GeometryNodeInstanceOnPoints")
        by_name = isinstance(source, str)
        node = tree.nodes.new(source if by_name else "GeometryNodeObjectInfo")
        if not by_name:
            node.inputs["Object"].default_value = source
            node.inputs["As Instance"].default_value = True
        output = node.outputs["Mesh" if by_name else "Geometry"]
        tree.links.new(output, on_points.inputs["Instance"])
        on_points.inputs["Scale"].default_value = (0.3, 0.3, 0.3)

    def text(self, name: str = "Text", **place: Any) -> Any:
        curve = bpy.data.curves.new(name, "FONT")
        curve.body, curve.extrude = "Ray", 0.1
        return self.object(name, curve, **place)

    def bevelled_curve(self, name: str = "Curve", **place: Any) -> Any:
        curve = bpy.data.curves.new(name, "CURVE")
        curve.dimensions, curve.bevel_depth = "3D", 0.2
        spline = curve.splines.new("BEZIER")
        spline.bezier_points.add(1)
        for point, x in zip(spline.bezier_points, (-1, 1), strict=True):
            point.co, point.handle_left, point.handle_right = (x, 0, 0), (x, -1, 0), (x, 1, 1)
        return self.object(name, curve, **place)

    def surface(self, name: str = "Surface", **place: Any) -> Any:
        bpy.ops.surface.primitive_nurbs_surface_sphere_add(radius=1)
        obj = bpy.context.object
        obj.name = name
        return self.place(obj, **place)

    def metaball(self, name: str = "Metaball", **place: Any) -> Any:
        ball = bpy.data.metaballs.new(name)
        ball.resolution = ball.render_resolution = 0.4
        ball.elements.new().co = (0, 0, 0)
        ball.elements.new().co = (1, 0, 0)
        return self.object(name, ball, **place)

    def color_attribute(
        self, obj: Any, domain: str, kind: str = "FLOAT_COLOR", seed: int = 5
    ) -> Any:
        attribute = obj.data.color_attributes.new("Shown", kind, domain)
        values = np.random.default_rng(seed).random((len(attribute.data), 4), np.float32)
        attribute.data.foreach_set("color", values.ravel())
        obj.data.color_attributes.active_color = attribute
        return attribute

    def compositor(self) -> tuple[Any, Any]:
        """Give the scene a compositor with its Render Layers node; returns both."""
        scene = bpy.context.scene
        if bpy.app.version >= (5, 0, 0):
            tree = bpy.data.node_groups.new("Compositor", "CompositorNodeTree")
            scene.compositing_node_group = tree
        else:
            scene.use_nodes = True
            tree = scene.node_tree
            tree.nodes.clear()
        node = tree.nodes.new("CompositorNodeRLayers")
        node.scene = scene
        return tree, node

    def sequencer(self) -> None:
        """Give the scene a sequencer that shows a plain colour."""
        editor = bpy.context.scene.sequence_editor_create()
        strips = editor.strips if hasattr(editor, "strips") else editor.sequences
        length = {"length" if bpy.app.version >= (5, 0, 0) else "frame_end": 100}
        strips.new_effect("Color", "COLOR", channel=1, frame_start=1, **length)

    def solids(self) -> None:
        """A red, a green and a blue solid that overlap in the picture, on a grey floor."""
        self.square("Floor", 6, location=(0, 0, -1), material=self.material("Grey", 0.3, 0.3, 0.3))
        for name, x, rgba in (
            ("Red", -1.1, (0.8, 0.1, 0.1)),
            ("Green", 0.3, (0.1, 0.7, 0.2)),
            ("Blue", 1.5, (0.1, 0.2, 0.9)),
        ):
            self.cube(
                name,
                1.2,
                location=(x, 0.3 * x, 0.2 * x),
                rotation=(0.4 + x, 0.3, x),
                material=self.material(name, *rgba),
            )

    def room(
        self, width: int = 96, height: int = 54, color_type: str = "MATERIAL", **camera: Any
    ) -> Any:
        """The solids, as the camera in the corner sees them; returns the scene."""
        scene = self.scene(width, height, color_type)
        self.solids()
        self.corner_camera(**camera)
        return scene

    def corner_camera(self, **data: Any) -> Any:
        """A camera that looks at the solids from the front, right and above."""
        return self.camera((3.1, -4.2, 3.3), (np.radians(60), 0.05, np.radians(37)), **data)


def assert_same_colors(comparison, distinct: int = 2) -> None:
    """Where the tracer and Blender see the same surface, they show the same colour."""
    pixels = comparison.counts
    assert pixels.unexplained == pixels.not_decidable == 0
    assert pixels.by_cause["not_modelled"] == pixels.by_cause["depth_tie"] == 0
    assert pixels.differ <= 0.02 * pixels.total  # edges
    seen = comparison.frame.instance_index >= 0
    assert seen.mean() > 0.05
    colors = np.unique(np.round(comparison.frame.color[seen], 3), axis=0)
    assert len(colors) >= distinct


def assert_same_scene(one: Any, other: Any, texts: Collection[str] = ()) -> None:
    """Two scenes are the same but for float32; of `texts` the triangles may be other ones."""
    from pytest import approx  # late: Blender's window, which makes scenes too, has none

    near = {"rtol": 1e-6, "atol": SAME}
    assert one.objects == other.objects and one.triangle_count == other.triangle_count > 0
    for name in ("width", "height", "region", "projection", "clip_start", "clip_end"):
        assert getattr(one.camera, name) == getattr(other.camera, name), name
    np.testing.assert_allclose(one.camera.world_from_camera, other.camera.world_from_camera, **near)
    assert vars(one.camera.window) == approx(vars(other.camera.window))
    for mine, theirs in zip(one.meshes, other.meshes, strict=True):
        if mine.name in texts:
            np.testing.assert_allclose(mine.bounds, theirs.bounds, **near)
            assert area(mine) == approx(area(theirs))
        else:
            corners = (m.vertices[m.triangles] for m in (mine, theirs))
            np.testing.assert_allclose(*corners, err_msg=mine.name, **near)
    for kind, names in (
        ("instances", ("mesh", "object", "world_from_object", "colors")),
        ("planes", ("object", "point", "normal", "color")),
    ):
        for mine, theirs in zip(getattr(one, kind), getattr(other, kind), strict=True):
            for name in names:
                np.testing.assert_allclose(getattr(mine, name), getattr(theirs, name), **near)


def area(mesh: Any) -> float:
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)

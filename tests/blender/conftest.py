"""One process is one Blender: the add-on is registered once, and every test begins with an empty file.

`build` makes small scenes, `export` and `compare` do to them what the add-on's buttons do.
"""

from __future__ import annotations

import contextlib
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import reference_tracer
from mathutils import Euler, Matrix
from reference_tracer.blender.compare import gather
from reference_tracer.blender.engine import export_for_render
from reference_tracer.blender.export import export as export_depsgraph
from reference_tracer.blender.viewport import temporary_scene
from reference_tracer.tracer.progress import result_of

SAMPLES = Path(__file__).resolve().parents[2] / "sample_scenes"
CUBE_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


@pytest.fixture(scope="session", autouse=True)
def addon():
    reference_tracer.register()
    yield
    reference_tracer.unregister()


@pytest.fixture(autouse=True)
def empty_file(addon):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


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

    def camera(self, location=(0.0, 0.0, 5.0), rotation=(0.0, 0.0, 0.0), **data: Any) -> Any:
        """By default straight above the origin, looking down, +Y upwards in the picture."""
        camera = bpy.data.cameras.new("Camera")
        for name, value in data.items():
            setattr(camera, name, value)
        obj = self.link(bpy.data.objects.new("Camera", camera))
        obj.location, obj.rotation_euler = location, rotation
        bpy.context.scene.camera = obj
        return obj

    def mesh(self, name: str, vertices: Any, faces: Any, link: bool = True) -> Any:
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [tuple(f) for f in faces])
        obj = bpy.data.objects.new(name, mesh)
        return self.link(obj) if link else obj

    def square(self, name: str = "Square", size: float = 2.0, link: bool = True, **place: Any) -> Any:
        h = size / 2
        obj = self.mesh(name, [(-h, -h, 0), (h, -h, 0), (h, h, 0), (-h, h, 0)], [(0, 1, 2, 3)], link)
        return self.place(obj, **place)

    def cube(self, name: str = "Cube", size: float = 2.0, link: bool = True, **place: Any) -> Any:
        h = size / 2
        corners = [(x, y, z) for x in (-h, h) for y in (-h, h) for z in (-h, h)]
        return self.place(self.mesh(name, corners, CUBE_FACES, link), **place)

    def place(self, obj: Any, location=(0, 0, 0), rotation=(0, 0, 0), scale=(1, 1, 1),
              material: Any = None, color: Any = None) -> Any:
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
        return self.place(self.link(bpy.data.objects.new(name, None)), **place)

    def collection(self, name: str, *objects: Any, link: bool = False) -> Any:
        collection = bpy.data.collections.new(name)
        for obj in objects:
            collection.objects.link(obj)
        if link:
            bpy.context.scene.collection.children.link(collection)
        return collection

    def nodes(self, obj: Any, *names: str) -> tuple[Any, Any]:
        """Give an object a modifier of new geometry nodes, linked one behind the other.

        Returns their tree and nodes. The first node takes the object's own geometry, if it takes any.
        """
        tree = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
        for direction in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
        nodes = [tree.nodes.new(name) for name in ("NodeGroupInput", *names, "NodeGroupOutput")]
        for first, second in zip(nodes, nodes[1:], strict=False):
            sockets = [s for s in second.inputs if s.type == "GEOMETRY"]
            if sockets:
                tree.links.new(first.outputs[0], sockets[0])
        obj.modifiers.new("Nodes", "NODES").node_group = tree
        return tree, nodes[1:-1]

    def instances_on_points(self, obj: Any, source: Any) -> None:
        """Have geometry nodes put an object, or a mesh primitive by its node's name, on the points."""
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
        return self.place(self.link(bpy.data.objects.new(name, curve)), **place)

    def bevelled_curve(self, name: str = "Curve", **place: Any) -> Any:
        curve = bpy.data.curves.new(name, "CURVE")
        curve.dimensions, curve.bevel_depth = "3D", 0.2
        spline = curve.splines.new("BEZIER")
        spline.bezier_points.add(1)
        for point, x in zip(spline.bezier_points, (-1, 1), strict=True):
            point.co, point.handle_left, point.handle_right = (x, 0, 0), (x, -1, 0), (x, 1, 1)
        return self.place(self.link(bpy.data.objects.new(name, curve)), **place)

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
        return self.place(self.link(bpy.data.objects.new(name, ball)), **place)

    def color_attribute(self, obj: Any, domain: str, kind: str = "FLOAT_COLOR", seed: int = 5) -> Any:
        attribute = obj.data.color_attributes.new("Shown", kind, domain)
        values = np.random.default_rng(seed).random((len(attribute.data), 4), np.float32)
        attribute.data.foreach_set("color", values.ravel())
        obj.data.color_attributes.active_color = attribute
        return attribute

    def solids(self) -> None:
        """A red, a green and a blue solid that overlap in the picture, on a grey floor."""
        self.square("Floor", 6, location=(0, 0, -1), material=self.material("Grey", 0.3, 0.3, 0.3))
        for name, x, rgba in (("Red", -1.1, (0.8, 0.1, 0.1)), ("Green", 0.3, (0.1, 0.7, 0.2)),
                              ("Blue", 1.5, (0.1, 0.2, 0.9))):
            self.cube(name, 1.2, location=(x, 0.3 * x, 0.2 * x), rotation=(0.4 + x, 0.3, x),
                      material=self.material(name, *rgba))

    def corner_camera(self, **data: Any) -> Any:
        """A camera that looks at the solids from the front, right and above."""
        return self.camera((3.1, -4.2, 3.3), (np.radians(60), 0.05, np.radians(37)), **data)


@pytest.fixture
def build() -> Build:
    return Build()


def _export_viewport(diagnosis: bool = False):
    return export_depsgraph(bpy.context.evaluated_depsgraph_get(), diagnosis)


def _export_render():
    with temporary_scene(bpy.context.scene) as copy:
        return export_for_render(copy, bpy.context.view_layer.name)


@pytest.fixture
def export() -> SimpleNamespace:
    """The open scene as the viewport and as a render has it: (Scene, Manifest)."""
    return SimpleNamespace(viewport=_export_viewport, render=_export_render,
                           modes={"VIEWPORT": _export_viewport, "RENDER": _export_render})


@pytest.fixture
def compare():
    """Trace the open scene and compare it, as the button does."""
    def run(**choices: Any):
        return result_of(gather(bpy.context, **choices).steps())

    return run


@pytest.fixture
def entries():
    """Return a manifest's entries by name, which must be unique."""
    def by_name(manifest: Any) -> dict:
        out = {entry.name: entry for entry in manifest.objects}
        assert len(out) == len(manifest.objects)
        return out

    return by_name


@pytest.fixture
def opened():
    """Open a sample scene, its picture made at most so wide."""
    def run(name: str, width: int | None = None) -> Any:
        bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{name}.blend"), load_ui=False)
        scene = bpy.context.scene
        if width:
            scene.render.resolution_percentage = max(1, 100 * width // scene.render.resolution_x)
        return scene

    return run


@pytest.fixture
def workbench(tmp_path):
    """Blender's own Workbench picture of the open scene by its own settings, but 32-bit EXR."""
    def run(**display: Any) -> np.ndarray:
        scene = bpy.context.scene
        for name, value in display.items():
            setattr(scene.display.shading if hasattr(scene.display.shading, name) else scene.display,
                    name, value)
        scene.render.engine = "BLENDER_WORKBENCH"
        scene.view_settings.view_transform = "Raw"
        image = scene.render.image_settings
        with contextlib.suppress(AttributeError):  # from 5.0 on
            image.media_type = "IMAGE"
        image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGBA", "32"
        scene.render.filepath = str(tmp_path / "workbench.exr")
        bpy.ops.render.render(write_still=True)
        loaded = bpy.data.images.load(scene.render.filepath, check_existing=False)
        width, height = loaded.size
        pixels = np.array(loaded.pixels[:], np.float32).reshape(height, width, 4)
        bpy.data.images.remove(loaded)
        return pixels

    return run

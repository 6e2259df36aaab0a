"""Makes a copy of a scene for other renderers: its materials emit the colours of a comparison.

The copy is what was exported: every instance is an object with a mesh of triangles, where Blender's
modifiers have put it. So a renderer that knows no more than meshes and emission can draw it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import bpy
import numpy as np
from bpy.types import Context, Material, Object
from mathutils import Matrix

from ...arrays import Colors, Floats, Integers
from ...pictures.palette import By, eight_bits
from ...scene import Scene, SceneError
from ..drawing.constant_material import emission
from ..drawing.judges import RENDER_RESULT
from ..reading.view_volume import polygon
from .against import exported_in

_Rgba = tuple[float, ...]

# Settings copied from a scene's `render`: the picture's size, and its engine.
_KEPT = (
    "engine",
    "resolution_x",
    "resolution_y",
    "resolution_percentage",
    "pixel_aspect_x",
    "pixel_aspect_y",
    "use_border",
    "use_crop_to_border",
    "border_min_x",
    "border_max_x",
    "border_min_y",
    "border_max_y",
)


def colors_scene(context: Context, colors: By) -> Any:
    """Add a scene in which the context's scene has constant colours; return it.

    A comparison of it is with its Render Result. Infinite planes are polygons that fill the view.

    Raises
    ------
    SceneError
        If the scene cannot be traced, or shows colours that are no material's.
    """
    user = context.scene
    _, exported, _ = exported_in(context, colors)
    for mesh in exported.meshes:
        if mesh.corner_colors is not None:
            raise SceneError(
                f"Mesh '{mesh.name}' shows a colour attribute, which is no material's colour: set "
                "Colors to Object."
            )
    scene = bpy.data.scenes.new(f"{user.name} colors")
    _set(scene, user)
    above = bpy.data.objects.new(scene.name, None)  # an empty that gives all exact matrices
    scene.collection.objects.link(above)
    lens = user.camera.data.copy()
    lens.animation_data_clear()
    lens.dof.use_dof = False
    scene.camera = bpy.data.objects.new(user.camera.name, lens)  # as it is now, whatever moves it
    _place(scene, scene.camera, above, exported.camera.world_from_camera)
    _add_surfaces(scene, above, exported)
    return scene


def _set(scene: Any, user: Any) -> None:
    """Set a new scene up to be rendered as a scene of the user's, flat and without effects."""
    for name in _KEPT:
        setattr(scene.render, name, getattr(user.render, name))
    for name in ("renderer", "filter"):
        setattr(scene.reference_tracer, name, getattr(user.reference_tracer, name))
    scene.frame_set(user.frame_current, subframe=user.frame_subframe)
    scene.render.film_transparent = True
    scene.view_settings.view_transform = "Standard"
    scene.render.dither_intensity = 0.0
    scene.display.shading.light = "FLAT"
    scene.display.shading.color_type = "MATERIAL"
    scene.display.shading.show_specular_highlight = False
    scene.display.render_aa = "OFF"
    scene.reference_tracer.judge = RENDER_RESULT
    scene.reference_tracer.colors = "VIEWPORT"


def _add_surfaces(scene: bpy.types.Scene, above: Any, exported: Scene) -> None:
    """Add an object for each instance and plane, below an empty."""
    meshes = {
        k: _mesh(m.name, m.vertices, m.triangles, m.slots)
        for k, m in enumerate(exported.meshes)
        if k in exported.instance_meshes
    }
    made = cache(_material)  # one for each colour
    for instance in exported.instances:
        own = bpy.data.objects.new(exported.objects[instance.object], meshes[instance.mesh])
        _place(scene, own, above, instance.world_from_object)
        _color(own, instance.colors, made)
    for plane in exported.planes:
        corners = polygon(exported.camera, plane)
        if len(corners):
            name = exported.objects[plane.object]
            mesh = _mesh(name, corners, np.arange(len(corners))[None], np.zeros(1, np.int32))
            own = bpy.data.objects.new(name, mesh)
            _place(scene, own, above, np.eye(4))
            _color(own, plane.color[None], made)


def _place(scene: bpy.types.Scene, obj: Object, above: Any, matrix: Floats) -> None:
    """Link an object; as the inverse of its parent's matrix, one with a shear is kept, too."""
    obj.parent = above
    obj.matrix_parent_inverse = Matrix(matrix.tolist())
    scene.collection.objects.link(obj)


def _mesh(name: str, vertices: Floats, faces: Any, slots: Integers) -> bpy.types.Mesh:
    """Return a mesh of Blender's with as many empty material slots as its faces need."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices.tolist(), [], faces.tolist())
    for _ in range(max(slots.tolist()) + 1):
        mesh.materials.append(None)
    mesh.polygons.foreach_set("material_index", slots)
    return mesh


def _color(obj: Object, colors: Colors, made: Callable[[_Rgba], Material]) -> None:
    """Show an object in colours by its slots; a slot past the end has the last one."""
    opaque = [(*map(float, color[:3]), 1.0) for color in colors]
    for number, slot in enumerate(obj.material_slots):
        slot.link = "OBJECT"
        slot.material = made(opaque[min(number, len(opaque) - 1)])
    obj.color = opaque[0]


def _material(rgba: _Rgba) -> Material:
    name = "#" + eight_bits(np.array(rgba[:3], np.float32)).tobytes().hex()
    material = bpy.data.materials.new(name)
    material.diffuse_color = rgba
    emission(material).default_value = rgba
    return material

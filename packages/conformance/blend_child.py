"""Writes scenes of the kit as .blend: a process of its own, which has bpy.

    python -m reference_tracer_conformance.blend_child FOLDER...

A folder bears the name of its scene; in it comes scene.blend.
"""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
from mathutils import Matrix
from reference_tracer.blender.drawing.camera_object import add_camera
from reference_tracer.blender.drawing.constant_material import emission

from .scenes import PALETTE, Item, KitScene, Sheared, kit_scenes
from .shapes import Shape


def write(kit: KitScene, path: Path) -> None:
    """Write one scene."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    meshes = {}
    for item in kit.items:
        key = item.shape, item.colors
        if key not in meshes:
            meshes[key] = _mesh(item.shape, item.colors)
        _placed(item, meshes[key])
    scene = bpy.context.scene
    add_camera(scene, kit.camera)
    scene.view_settings.view_transform = "Standard"
    scene.render.film_transparent = True
    scene.display.shading.light = "FLAT"
    scene.display.shading.color_type = "MATERIAL"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)


def _mesh(shape: Shape, colors: tuple[int, ...]) -> bpy.types.Mesh:
    mesh = bpy.data.meshes.new(shape.name)
    # Blender's faces have no corner twice: what is left out has no area.
    faces = zip(shape.polygons, shape.slot_of, strict=True)
    kept = [(p, slot) for p, slot in faces if len(set(p)) == len(p)]
    mesh.from_pydata(shape.vertices.tolist(), [], [p for p, _ in kept])
    mesh.polygons.foreach_set("material_index", [slot for _, slot in kept])
    for color in colors:
        mesh.materials.append(_material(color))
    return mesh


def _material(color: int) -> bpy.types.Material:
    name = f"color{color}"
    if name in bpy.data.materials:
        return bpy.data.materials[name]
    material = bpy.data.materials.new(name)
    rgba = (*PALETTE[color].tolist(), 1.0)
    material.diffuse_color = rgba
    emission(material).default_value = rgba
    return material


def _placed(item: Item, mesh: bpy.types.Mesh) -> None:
    """Link an object for each transform, the outermost parent first; the last has the mesh."""
    parent = None
    moves = item.moves or (None,)
    for level, move in enumerate(moves, 1 - len(moves)):
        name = item.name if level == 0 else f"{item.name}, parent {-level}"
        made = _object(name, mesh if level == 0 else None)
        made.parent = parent
        if isinstance(move, Sheared):  # only the inverse of a parent's matrix holds a shear
            made.parent = parent or _object(f"{name}, root")
            made.matrix_parent_inverse = Matrix(move.matrix.tolist())
        elif move:
            x, y, z, w = move.turn
            made.rotation_mode = "QUATERNION"
            made.location, made.scale = move.at, move.scale
            made.rotation_quaternion = w, x, y, z
        parent = made


def _object(name: str, mesh: bpy.types.Mesh | None = None) -> bpy.types.Object:
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    return made


def main() -> None:
    """Write the .blend of each folder that is named."""
    known = {kit.name: kit for kit in kit_scenes()}
    for folder in map(Path, sys.argv[1:]):
        write(known[folder.name], folder / "scene.blend")


if __name__ == "__main__":
    main()

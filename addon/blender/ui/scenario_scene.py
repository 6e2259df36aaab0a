"""Builds a scenario of the extremes as a scene in Blender, as closely as float32 allows.

The study's scenes are float64, and some have numbers that Blender cannot store. What changed when
it was stored is said, and a custom property of the new scene keeps it.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ...arrays import Floats
from ...scene import Camera, Instance, Mesh, Scene, SceneError, drop_non_finite
from ...study.extremes import written
from ...study.scenarios.sweeps import BY_NAME, Scenario
from ...tracer.vector import transform_points
from ..drawing.camera_object import LEAST_CLIP, add_camera
from ..engine import ENGINE
from ..reading.camera import window_of
from .results import areas

CHANGED = "reference_tracer_float32"  # the custom property: lines of text

_ROUNDING = 2.0**-22  # relative: what storing a view window in float32 does to it at most


def open_scenario(context: Any, name: str, scale: str = "", width: int = 0) -> Any:
    """Build a scenario as a new scene, and go there; returns it.

    The scale is a number; empty for the scenario's last. The width is that of the picture, in
    pixels; 0 for the study's own.

    Raises
    ------
    SceneError
        If there is no such scale, or Blender's numbers cannot hold the scene.
    """
    scenario = BY_NAME[name]
    value = _number(scale, scenario)
    width = width or scenario.width
    height = max(1, round(width * scenario.height / scenario.width))
    title = f"{scenario.title}, {scenario.scale_name} {written(value)} {scenario.unit}".strip()
    try:
        wanted = scenario.build(value, width, height)
    except (SceneError, ValueError, ArithmeticError) as error:
        raise SceneError(f"There is no '{title}': {error}") from error
    if wanted.camera.clip_end <= LEAST_CLIP:
        raise SceneError(
            f"'{title}' cannot be a scene in Blender: all of it is nearer to the camera than "
            f"{LEAST_CLIP:g} m, Blender's least clip start. Choose a scale nearer to the first."
        )
    stored = [_storable(wanted, i, title) for i in wanted.instances]
    scene = bpy.data.scenes.new(title)
    _set_up(scene, wanted)
    add_camera(scene, wanted.camera)
    for (mesh, matrix), instance in zip(stored, wanted.instances, strict=True):
        _add_object(scene, mesh, matrix, instance)
    changes = _changes(wanted, stored, scene)
    scene[CHANGED] = "\n".join(changes or ["float32 holds this scene without a change"])
    _go_to(context, scene)
    return scene


def _number(text: str, scenario: Scenario) -> float:
    try:
        value = float(text) if text else float(scenario.scales[-1])
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise SceneError(f"The scale is '{text}': it must be a number, such as 1e8.")
    return value


def _storable(wanted: Scene, instance: Instance, title: str) -> tuple[Mesh, Floats]:
    """Return an instance's mesh and matrix as float32 holds them.

    Where it cannot hold the matrix, the mesh is stored where it appears.
    """
    mesh = wanted.meshes[instance.mesh]
    matrix = instance.world_from_object
    with np.errstate(over="ignore", under="ignore"):
        small = matrix.astype(np.float32).astype(np.float64)
        vertices = mesh.vertices.astype(np.float32)
        lost = not np.isfinite(small).all() or ((small == 0) & (matrix != 0)).any()
        if lost or not np.isfinite(vertices).all():
            vertices = _placed(mesh.vertices, matrix).astype(np.float32)
            small = np.eye(4)
    seen = vertices[mesh.triangles]
    finite = seen[np.isfinite(seen).all(axis=(1, 2))].reshape(-1, 3)
    if not len(finite) or not np.ptp(finite, axis=0).any():
        raise SceneError(
            f"'{title}' cannot be a scene in Blender: its numbers are float32, from 1e-45 to "
            "3e+38. Choose a scale nearer to the first."
        )
    # Blender would cut a corner beyond float32 off at the limit: its triangles are left out.
    vertices, keep = drop_non_finite(vertices, mesh.triangles)
    return Mesh(vertices, mesh.triangles[keep], name=mesh.name), small


def _placed(points: Floats, matrix: Floats) -> Floats:
    """Return points (n, 3) in world space."""
    with np.errstate(over="ignore", invalid="ignore"):
        placed = transform_points(matrix, points.astype(np.float64).T).T
    return np.asarray(placed, np.float64)


def _set_up(scene: Any, wanted: Scene) -> None:
    """Give the scene flat colours, as they are, on the study's background; F12 traces it."""
    scene.render.engine = ENGINE
    scene.display.shading.light = "FLAT"
    scene.display.shading.color_type = "MATERIAL"
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new(scene.name)
    scene.world.color = wanted.background[:3]


def _add_object(scene: Any, mesh: Mesh, matrix: Floats, instance: Instance) -> None:
    data: Any = bpy.data.meshes.new(mesh.name)
    data.from_pydata(mesh.vertices.tolist(), [], mesh.triangles.tolist())
    material: Any = bpy.data.materials.new(mesh.name)
    data.materials.append(material)
    material.diffuse_color = instance.colors[0]
    obj: Any = bpy.data.objects.new(mesh.name, data)
    scene.collection.objects.link(obj)
    diagonal = np.diag(np.diagonal(matrix[:3, :3]))
    if (matrix[:3, :3] == diagonal).all():
        obj.location = matrix[:3, 3]
        obj.scale = np.diagonal(matrix)[:3]
        return
    # Location, rotation and scale have no shear: the matrix to a parent has.
    obj.parent = bpy.data.objects.new(f"{mesh.name} Matrix", None)
    scene.collection.objects.link(obj.parent)
    obj.matrix_parent_inverse = Matrix(matrix.tolist())


def _changes(wanted: Scene, stored: list[tuple[Mesh, Floats]], scene: Any) -> list[str]:
    """Return what changed when a scene was stored in float32, one fact in each line."""
    lines = []
    for (mesh, matrix), instance in zip(stored, wanted.instances, strict=True):
        whole = wanted.meshes[instance.mesh]
        should = _placed(whole.vertices, instance.world_from_object)
        used = np.unique(mesh.triangles)
        moved = np.abs(_placed(mesh.vertices, matrix)[used] - should[used]).max()
        if moved:
            far = np.abs(should[used]).max()
            lines.append(
                f"corners of {mesh.name} moved by up to {moved:.1e} m, at up to {far:.1e} m"
            )
        if left_out := len(whole.triangles) - len(mesh.triangles):
            lines.append(f"{left_out:,} triangles of {mesh.name} left out: beyond float32")
    return lines + _camera_changes(wanted.camera, scene)


def _camera_changes(camera: Camera, scene: Any) -> list[str]:
    data = scene.camera.data
    lines = []
    if moved := np.abs(np.array(scene.camera.location, np.float64) - camera.origin).max():
        lines.append(f"camera moved by up to {moved:.1e} m, at {np.abs(camera.origin).max():.1e} m")
    w = camera.window
    now = window_of(scene)
    for what, should, is_now, unit in (
        ("view window's width", w.right - w.left, now.right - now.left, ""),
        ("view window's height", w.top - w.bottom, now.top - now.bottom, ""),
        ("clip start", camera.clip_start, data.clip_start, " m"),
        ("clip end", camera.clip_end, data.clip_end, " m"),
    ):
        if abs(is_now - should) > _ROUNDING * should:
            lines.append(f"{what} {is_now:.2g}{unit} in place of {should:.2g}{unit}")
    return lines


def _go_to(context: Any, scene: Any) -> None:
    """Show the scene through its camera."""
    if not context.window:
        return
    context.window.scene = scene
    for area in areas(context, "VIEW_3D"):
        if area.spaces.active.region_3d:
            area.spaces.active.region_3d.view_perspective = "CAMERA"

"""Measures Blender for the benchmark, in a process of its own that `blender_peer.py` asks."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree
from reference_tracer.blender.drawing.camera_object import add_camera
from reference_tracer.blender.drawing.constant_material import emission
from reference_tracer.scene import Mesh, Scene

from .peers import fitting
from .rays import Rays

ENGINES = {"cycles": "CYCLES", "workbench": "BLENDER_WORKBENCH"}


_opened: dict[str, Any] = {}  # the camera, the object with the mesh, and what was drawn once


def suzanne(path: Path) -> None:
    """Write Blender's monkey, its faces cut in 9 and then smoothly in 4, 3 times, to a .npz."""
    mesh = _monkey()
    mesh.calc_loop_triangles()
    vertices = np.empty((len(mesh.vertices), 3), np.float32)
    triangles = np.empty((len(mesh.loop_triangles), 3), np.int32)
    mesh.vertices.foreach_get("co", vertices.ravel())
    mesh.loop_triangles.foreach_get("vertices", triangles.ravel())
    np.savez(path, vertices=vertices, triangles=triangles)


def _monkey() -> Any:
    import bmesh  # it is there only once bpy is

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    whole = bmesh.new()
    whole.from_mesh(obj.data)
    bmesh.ops.subdivide_edges(whole, edges=whole.edges, cuts=2, use_grid_fill=True)
    whole.to_mesh(obj.data)
    whole.free()
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = 3
    return bpy.data.meshes.new_from_object(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()))


def open_scene(wanted: Scene) -> None:
    """Build a scene of the benchmark in an empty Blender."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    add_camera(scene, wanted.camera)
    obj = bpy.data.objects.new("Mesh", _mesh(wanted.meshes[0]))
    scene.collection.objects.link(obj)
    material = bpy.data.materials.new("Constant")
    emission(material)  # what costs Cycles least: it sends no further ray
    obj.data.materials.append(material)
    render, cycles = scene.render, scene.cycles
    render.threads_mode, render.threads = "FIXED", 1
    render.use_compositing = render.use_sequencer = False
    render.film_transparent = True
    cycles.device, cycles.samples, cycles.max_bounces = "CPU", 1, 0
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    scene.display.render_aa = "OFF"
    scene.display.shading.light = "FLAT"
    bpy.context.view_layer.update()
    _opened.update(camera=wanted.camera, object=obj)


def _mesh(wanted: Mesh) -> Any:
    """Return a Blender mesh: the arrays of ours, in bulk."""
    mesh, count = bpy.data.meshes.new("Mesh"), len(wanted.triangles)
    mesh.vertices.add(len(wanted.vertices))
    mesh.vertices.foreach_set("co", wanted.vertices.ravel())
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", wanted.triangles.ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    return mesh


def cast(tree: BVHTree, rays: Rays) -> float:
    """Cast rays in a loop, as a script does; returns seconds."""
    pairs = list(zip(rays.origins.tolist(), rays.directions.tolist(), strict=True))
    ray_cast = tree.ray_cast
    began = time.process_time()
    for origin, direction in pairs:
        ray_cast(origin, direction)
    return time.process_time() - began


def bvhtree(budget: float) -> tuple[float, int]:
    """Build mathutils' tree and cast the rays of a picture, or of as many rows as fit a budget.

    Returns the seconds for the whole picture, and how many rays were cast.
    """
    tree = BVHTree.FromObject(_opened["object"], bpy.context.evaluated_depsgraph_get())
    rays = fitting(lambda few: cast(tree, few), _opened["camera"], budget)
    return cast(tree, rays) * rays.of / rays.count, rays.count


def render(engine: str) -> float:
    """Render the open scene, which is what a user waits for; returns seconds."""
    if engine == "workbench" and not _opened.get("has drawn"):  # it makes its shaders
        _opened["has drawn"] = True
        render(engine)
    bpy.context.scene.render.engine = ENGINES[engine]
    began = time.perf_counter()
    bpy.ops.render.render()
    return time.perf_counter() - began

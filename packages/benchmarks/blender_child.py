"""Measures Blender for the benchmark, in a process of its own that `blender_peer.py` asks.

A question is a line of JSON on standard input, and its answer one on what was standard output. What
Blender itself prints goes to standard error.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree
from reference_tracer.blender.drawing.camera_object import add_camera
from reference_tracer.scene import Mesh, Scene

from . import scenes
from .peers import fitting
from .rays import Rays

ENGINES = {"cycles": "CYCLES", "workbench": "BLENDER_WORKBENCH"}


def suzanne() -> Any:
    """Return Blender's monkey as a new mesh, its faces cut in 9 and then smoothly in 4, 3 times."""
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


def arrays(mesh: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertices, (v, 3) float32, and the triangles, (n, 3) int32, of a Blender mesh."""
    mesh.calc_loop_triangles()
    vertices = np.empty((len(mesh.vertices), 3), np.float32)
    triangles = np.empty((len(mesh.loop_triangles), 3), np.int32)
    mesh.vertices.foreach_get("co", vertices.ravel())
    mesh.loop_triangles.foreach_get("vertices", triangles.ravel())
    return vertices, triangles


def open_scene(wanted: Scene) -> Any:
    """Build a scene of the benchmark in an empty Blender; returns the object with its mesh."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    add_camera(scene, wanted.camera)
    obj = bpy.data.objects.new("Mesh", _mesh(wanted.meshes[0]))
    scene.collection.objects.link(obj)
    obj.data.materials.append(_emission())
    render, cycles = scene.render, scene.cycles
    render.threads_mode, render.threads = "FIXED", 1
    render.use_compositing = render.use_sequencer = False
    render.film_transparent = True
    cycles.device, cycles.samples, cycles.max_bounces = "CPU", 1, 0
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    scene.display.render_aa = "OFF"
    scene.display.shading.light = "FLAT"
    bpy.context.view_layer.update()
    return obj


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


def _emission() -> Any:
    """Return the material that costs Cycles least: it sends no further ray."""
    material = bpy.data.materials.new("Constant")
    if not material.node_tree:  # before 5.0
        material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission, output = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("Emission", "OutputMaterial")
    )
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def cast(tree: BVHTree, rays: Rays) -> float:
    """Cast rays in a loop, as a script does; returns seconds."""
    pairs = list(zip(rays.origins.tolist(), rays.directions.tolist(), strict=True))
    ray_cast = tree.ray_cast
    began = time.process_time()
    for origin, direction in pairs:
        ray_cast(origin, direction)
    return time.process_time() - began


def bvhtree(obj: Any, scene: Scene, budget: float) -> dict[str, float]:
    """Build mathutils' tree and cast the rays of a picture, or of as many rows as fit a budget."""
    tree = BVHTree.FromObject(obj, bpy.context.evaluated_depsgraph_get())
    rays = fitting(lambda few: cast(tree, few), scene.camera, budget)
    return {"seconds": cast(tree, rays) * rays.of / rays.count, "rays": rays.count}


def render(engine: str) -> dict[str, float]:
    """Render the open scene, which is what a user waits for; returns seconds."""
    bpy.context.scene.render.engine = ENGINES[engine]
    began = time.perf_counter()
    bpy.ops.render.render()
    return {"seconds": time.perf_counter() - began}


class Answers:
    """The measurements, by name, with the scene that is open."""

    def __init__(self) -> None:
        self._scene: Scene | None = None
        self._object: Any = None
        self._drawn = False  # whether Workbench has made its shaders

    def answer(self, question: dict[str, Any]) -> dict[str, Any]:
        """Do what a question asks for."""
        do = question.pop("do")
        if do == "suzanne":
            vertices, triangles = arrays(suzanne())
            np.savez(question["path"], vertices=vertices, triangles=triangles)
        elif do == "open":
            mesh = scenes.mesh_of(question["scene"], Path(question["cache"]))
            self._scene = scenes.build(mesh, *question["size"], question["camera"])
            self._object = open_scene(self._scene)
        elif do == "bvhtree":
            return bvhtree(self._object, self._scene, question["budget"])
        else:
            if do == "workbench" and not self._drawn:
                render(do)
                self._drawn = True
            return render(do)
        return {}


def main() -> None:
    """Answer until nobody asks."""
    with os.fdopen(os.dup(1), "w", encoding="utf-8") as out:
        os.dup2(2, 1)  # Blender prints what is no answer
        answers = Answers()
        for line in sys.stdin:
            try:
                answer = answers.answer(json.loads(line))
            except Exception as error:  # whoever asks is told, and goes on without
                answer = {"error": f"{type(error).__name__}: {error}"}
            print(json.dumps(answer), file=out, flush=True)


if __name__ == "__main__":
    main()

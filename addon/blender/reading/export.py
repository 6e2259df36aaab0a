"""An evaluated Blender scene -> `scene.Scene` and its `Manifest`.

The depsgraph says what is visible and evaluated, for the viewport or for a render as its mode has
it. What lies wholly outside the view is counted, and left out. Nothing of bpy is held in what is
returned.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ...manifest import OUTSIDE, Manifest, ObjectEntry
from ...scene import Camera, Instance, Plane, Scene
from ..drawing.temporary import user_scene
from .camera import export_camera
from .colors import background
from .planes import outside
from .unmodelled import of_scene
from .visible import Read, Seen, Shown, read_mesh, visible

NO_SURFACE = ("CAMERA", "LIGHT", "LIGHT_PROBE", "EMPTY", "ARMATURE", "LATTICE", "SPEAKER")


def export(depsgraph: Any) -> tuple[Scene, Manifest]:
    """Return what the tracer is to see of an evaluated depsgraph, and the account of it.

    The depsgraph's mode decides on visibility and modifier levels.

    Raises
    ------
    SceneError
        If the scene has no camera that can be traced.
    """
    scene = depsgraph.scene_eval
    camera = export_camera(scene)
    seen, shown, meshes = visible(depsgraph, scene.display.shading, read_mesh)
    parts, surfaces = assemble(seen, shown, meshes, _outside(camera, shown, meshes))
    manifest = _manifest(depsgraph, camera.name, seen, meshes)
    whole = Scene(camera=camera, background=background(scene), **parts)
    return whole, replace(manifest, owners=tuple(s.owner for s in surfaces))


def assemble(
    seen: dict[str, Seen],
    shown: list[Shown],
    meshes: dict[int, Read],
    unseen: Collection[int] = (),
) -> tuple[dict[str, tuple], list[Shown]]:
    """Return the parts of a `Scene` but its camera and background, and what its surfaces show.

    What is `unseen`, by its number in `shown`, is left out. What each object shows is counted in
    `seen`.
    """
    numbers: dict[int, int] = {}  # of those that something shows, in Scene.meshes
    # Numbered in the order in which they come, in the view or not: it stays when the camera moves.
    objects: dict[str, int] = {}
    instances: list[tuple[Instance, Shown]] = []
    planes: list[tuple[Plane, Shown]] = []
    all_finite = np.isfinite([s.matrix for s in shown]).reshape(-1, 16).all(axis=1)
    for n, (item, finite) in enumerate(zip(shown, all_finite, strict=True)):
        name, _, key, matrix, colors = item
        entry = seen[name]
        if key is None:
            if finite and matrix[:3, :2].any(axis=0).all():
                index = objects.setdefault(name, len(objects))
                planes.append((_plane(index, matrix, colors[0]), item))
                entry.planes += 1
            else:
                entry.left_out += 1
            continue
        if n in unseen:
            objects.setdefault(name, len(objects))
            entry.outside += 1
            continue
        mesh, left_out = meshes[key]
        entry.left_out += left_out if finite else len(mesh.triangles) + left_out
        if not finite or not len(mesh.triangles):
            continue
        entry.mesh_keys.setdefault(key)
        entry.instances += 1
        entry.triangles += len(mesh.triangles)
        number = numbers.setdefault(key, len(numbers))
        index = objects.setdefault(name, len(objects))
        instances.append((Instance(number, index, matrix, colors), item))
    instances.sort(key=lambda i: i[0].object)
    parts = {
        "meshes": tuple(meshes[key][0] for key in numbers),
        "instances": tuple(i for i, _ in instances),
        "planes": tuple(p for p, _ in planes),
        "objects": tuple(objects),
    }
    return parts, [item for _, item in (*instances, *planes)]


def _outside(camera: Camera, shown: list[Shown], meshes: dict[int, Read]) -> set[int]:
    """Return which appearances no ray of the camera can meet; an infinite plane is none."""
    whole = [n for n, s in enumerate(shown) if s.key is not None and not meshes[s.key][1]]
    if not whole:
        return set()
    low, high = np.swapaxes([meshes[shown[n].key][0].bounds for n in whole], 0, 1)
    out = outside(camera, low, high, np.array([shown[n].matrix for n in whole]))
    return set(np.array(whole)[out].tolist())


def _plane(index: int, matrix: np.ndarray, color: NDArray[np.float32]) -> Plane:
    """Return a plane through the object's origin, its normal the object's own +Z axis.

    The plane holds the object's X and Y axes, so under shear its normal is their cross product.
    """
    normal = np.cross(matrix[:3, 0], matrix[:3, 1])
    if (normal * matrix[:3, 2]).sum() < 0:  # mirrored
        normal = -normal
    return Plane(index, matrix[:3, 3], normal, color)


def _manifest(depsgraph, camera: str, seen, meshes) -> Manifest:
    scene, layer = user_scene(depsgraph.scene), depsgraph.view_layer
    entries = []
    for name, e in seen.items():
        own = [meshes[k] for k in e.mesh_keys]
        shown = bool(e.instances or e.planes)
        entries.append(
            ObjectEntry(
                name=name,
                type="INFINITE_PLANE" if e.planes else e.type,
                exported=shown,
                reason="" if shown else _nothing(e),
                triangles=sum(len(m.triangles) for m, _ in own),
                vertices=sum(len(m.vertices) for m, _ in own),
                instances=e.instances + e.planes,
                outside=e.outside,
                left_out=e.left_out,
                empty_slots=e.empty_slots,
                traced_triangles=e.triangles,
            )
        )
    for obj in scene.objects:
        if obj.name_full not in seen:
            why = _hidden(obj, layer, depsgraph.mode)
            entries.append(ObjectEntry(obj.name_full, obj.type, False, why, hidden=True))
    features = [u for e in seen.values() for u in e.features.values()]
    return Manifest(
        file=bpy.path.basename(bpy.data.filepath),
        scene=scene.name,
        view_layer=layer.name,
        frame=scene.frame_current,
        evaluation=depsgraph.mode,
        camera=camera,
        objects=tuple(entries),
        unmodelled=(*features, *of_scene(scene, depsgraph.scene)),
    )


def _nothing(entry: Seen) -> str:
    if entry.outside:
        return OUTSIDE
    if entry.left_out:
        return "all its triangles have a vertex or a matrix that is not finite"
    if entry.type in NO_SURFACE:
        return "has no surface"
    return "has no triangles as it is evaluated and drawn here"


def _hidden(obj: Any, layer: Any, mode: str) -> str:
    """Why the depsgraph does not hand an object out."""
    flag = "hide_viewport" if mode == "VIEWPORT" else "hide_render"
    where = "the viewport" if mode == "VIEWPORT" else "renders"
    if getattr(obj, flag):
        return f"hidden in {where}"
    if obj.name not in layer.objects:
        return f"not in view layer '{layer.name}' (its collection is excluded)"
    if mode == "VIEWPORT" and obj.hide_get(view_layer=layer):
        return "hidden in this view layer"
    return f"in a collection hidden in {where}, or its own display is off"

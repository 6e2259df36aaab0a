"""An evaluated Blender scene -> `scene.Scene` and its `Manifest`.

The depsgraph says what is visible and evaluated, for the viewport or for a render as its mode has
it, and hands out every object that has triangles as a mesh: text, curves, surfaces, metaballs and
what geometry nodes make, with all instances. Nothing of bpy is held in what is returned.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np

from ..manifest import Manifest, ObjectEntry, Unmodelled
from ..scene import Instance, Mesh, Plane, Scene
from ..scene_files import diagnose, merged
from .camera import export_camera
from .colors import background, instance_colors, slot_materials
from .meshes import export_mesh
from .temporary import judge_of, user_scene
from .unmodelled import of_object, of_scene

_NO_SURFACE = ("CAMERA", "LIGHT", "LIGHT_PROBE", "EMPTY", "ARMATURE", "LATTICE", "SPEAKER")


@dataclass
class _Seen:
    """What an object has shown so far."""

    type: str
    index: int = -1  # in Scene.objects, once it shows something
    mesh_keys: dict[int, None] = field(default_factory=dict)  # in the order in which they came
    instances: int = 0
    triangles: int = 0  # over all instances
    left_out: int = 0
    planes: int = 0
    empty_slots: int = 0
    features: dict[str, Unmodelled] = field(default_factory=dict)


def export(depsgraph: Any, diagnosis: bool = False) -> tuple[Scene, Manifest]:
    """Return what the tracer is to see of an evaluated depsgraph, and the account of it.

    Parameters
    ----------
    depsgraph : bpy.types.Depsgraph
        Its mode decides on visibility and modifier levels.
    diagnosis : bool
        Whether the manifest is to hold trimesh's diagnosis of every mesh.

    Raises
    ------
    SceneError
        If the scene has no camera that can be traced.
    """
    scene = depsgraph.scene_eval
    camera = export_camera(scene)
    viewport, judge = depsgraph.mode == "VIEWPORT", judge_of(depsgraph.scene)
    shading = scene.display.shading
    meshes: dict[int, tuple[Mesh, int]] = {}  # by address; with the triangles left out
    numbers: dict[int, int] = {}  # of those that something shows, in Scene.meshes
    seen: dict[str, _Seen] = {}
    instances: list[Instance] = []
    planes: list[Plane] = []
    for item in depsgraph.object_instances:
        obj = item.object
        name = obj.original.name_full
        matrix = np.array(item.matrix_world, dtype=np.float64)
        # The depsgraph hands out what only the eye of a collection hides.
        owner = (item.parent if item.is_instance else obj).original
        if viewport and not owner.visible_get(view_layer=depsgraph.view_layer):
            continue
        entry = seen.setdefault(name, _Seen(obj.original.type))
        if not item.show_self:
            continue
        finite = np.isfinite(matrix).all()
        for u in of_object(
            obj, item.matrix_world, shading, depsgraph.view_layer, depsgraph.mode, judge
        ):
            _widen(entry.features, u)
        if obj.original.reference_tracer.infinite_plane:
            if finite and matrix[:3, :2].any(axis=0).all():
                _number(entry, seen)
                planes.append(_plane(obj, matrix, entry.index, shading))
                entry.planes += 1
            else:
                entry.left_out += 1
            continue
        if obj.type != "MESH" or (viewport and obj.display_type in ("WIRE", "BOUNDS")):
            continue
        key = obj.data.as_pointer()
        if key not in meshes:
            meshes[key] = export_mesh(obj.data, name, shading.color_type == "VERTEX")
        mesh, left_out = meshes[key]
        entry.left_out += left_out if finite else len(mesh.triangles) + left_out
        if not finite or not len(mesh.triangles):
            continue
        _number(entry, seen)
        entry.mesh_keys.setdefault(key)
        entry.instances += 1
        entry.triangles += len(mesh.triangles)
        if shading.color_type == "MATERIAL":
            entry.empty_slots = max(entry.empty_slots, slot_materials(obj).count(None))
        colors = instance_colors(obj, shading.color_type, shading.single_color)
        number = numbers.setdefault(key, len(numbers))
        instances.append(Instance(number, entry.index, matrix, colors))
    instances.sort(key=lambda i: i.object)
    objects = sorted((e.index, n) for n, e in seen.items() if e.index >= 0)
    out = Scene(
        camera=camera,
        meshes=tuple(meshes[key][0] for key in numbers),
        instances=tuple(instances),
        planes=tuple(planes),
        background=background(scene),
        objects=tuple(n for _, n in objects),
    )
    return out, _manifest(depsgraph, camera.name, seen, meshes, diagnosis)


def _number(entry: _Seen, seen: dict[str, _Seen]) -> None:
    if entry.index < 0:
        entry.index = 1 + max(e.index for e in seen.values())


def _plane(obj: Any, matrix: np.ndarray, index: int, shading: Any) -> Plane:
    """Return a plane through the object's origin, its normal the object's own +Z axis.

    The plane holds the object's X and Y axes, so under shear its normal is their cross product.
    """
    normal = np.cross(matrix[:3, 0], matrix[:3, 1])
    if (normal * matrix[:3, 2]).sum() < 0:  # mirrored
        normal = -normal
    colors = instance_colors(obj, shading.color_type, shading.single_color, [obj.active_material])
    return Plane(index, matrix[:3, 3], normal, colors[0])


def _widen(features: dict[str, Unmodelled], found: Unmodelled) -> None:
    """Keep one entry a feature, its bounds around all the object's instances."""
    key = found.feature + found.detail
    if key in features and found.bounds is not None and features[key].bounds is not None:
        both = np.stack((features[key].bounds, found.bounds))
        bounds = np.stack((both[:, 0].min(axis=0), both[:, 1].max(axis=0)))
        found = Unmodelled(found.object, found.feature, found.detail, bounds)
    features[key] = found


def _manifest(depsgraph, camera: str, seen, meshes, diagnosis: bool) -> Manifest:
    scene, layer = user_scene(depsgraph.scene), depsgraph.view_layer
    diagnoses: dict[int, dict] = {}
    entries = []
    for name, e in seen.items():
        own = [meshes[k] for k in e.mesh_keys]
        if diagnosis:
            for key, (mesh, _) in zip(e.mesh_keys, own, strict=True):
                if key not in diagnoses:
                    diagnoses[key] = diagnose(mesh)
        shown = e.index >= 0
        entries.append(
            ObjectEntry(
                name=name,
                type="INFINITE_PLANE" if e.planes else e.type,
                exported=shown,
                reason="" if shown else _no_triangles(e),
                triangles=sum(len(m.triangles) for m, _ in own),
                vertices=sum(len(m.vertices) for m, _ in own),
                instances=e.instances + e.planes,
                left_out=e.left_out,
                empty_slots=e.empty_slots,
                diagnosis=merged([diagnoses[k] for k in e.mesh_keys if k in diagnoses]),
                traced_triangles=e.triangles,
            )
        )
    for obj in scene.objects:
        if obj.name_full not in seen:
            entries.append(
                ObjectEntry(obj.name_full, obj.type, False, _hidden(obj, layer, depsgraph.mode))
            )
    features = [u for e in seen.values() for u in e.features.values()]
    return Manifest(
        file=bpy.path.basename(bpy.data.filepath),
        scene=scene.name,
        view_layer=layer.name,
        frame=scene.frame_current,
        evaluation=depsgraph.mode,
        camera=camera,
        objects=tuple(entries),
        unmodelled=(*features, *of_scene(scene)),
    )


def _no_triangles(entry: _Seen) -> str:
    if entry.left_out:
        return "all its triangles have a vertex or a matrix that is not finite"
    if entry.type in _NO_SURFACE:
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

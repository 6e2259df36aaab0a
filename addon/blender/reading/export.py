"""Exports an evaluated Blender scene as a `scene.Scene` and its `Manifest`.

The depsgraph says what is visible and evaluated: for the viewport or for a render, by its mode.
What lies wholly outside the view is counted, and left out. Nothing of bpy is held in what is
returned.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import replace
from functools import partial
from typing import Any

import bpy
import numpy as np
from bpy.types import Depsgraph, Object, ViewLayer

from ...arrays import Colors, Floats, parts
from ...manifest import OUTSIDE, Manifest, ObjectEntry
from ...scene import Camera, Instance, Mesh, Plane, Scene
from ..temporary import HIDDEN_FACES, NOT_DRAWN, ignored_features, is_whole, user_scene
from .camera import export_camera
from .colors import background
from .meshes import Read, read_mesh
from .missing import gone_objects, missing
from .opened import notes
from .unmodelled import of_scene
from .view_volume import outside
from .visible import Seen, Shown, visible

NO_SURFACE = (*NOT_DRAWN, "EMPTY")
_TOGETHER = 1 << 15  # boxes that are looked at: some 30 MB


def export(
    depsgraph: Depsgraph,
    known: dict[Any, Read | None] | None = None,
    slots: str = "material_index",
) -> tuple[Scene, Manifest]:
    """Return what the tracer is to see of an evaluated depsgraph, and what the manifest says of it.

    The depsgraph's mode decides on visibility and modifier levels. What is `known` of its meshes is
    not read again, and the others are added: a mesh in Edit Mode can be read once alone. `slots` is
    the attribute of faces that takes the place of the material's slot.

    Raises
    ------
    SceneError
        If the scene has no camera that can be traced.
    """
    scene = depsgraph.scene_eval
    camera = export_camera(scene)
    hiding = HIDDEN_FACES not in (ignored_features(depsgraph.scene) or ())
    viewport = depsgraph.mode == "VIEWPORT"
    read = partial(read_mesh, viewport=viewport, hiding=hiding, slots=slots)
    if known is not None:
        read = partial(_read_once, known, read)
    seen, shown, meshes = visible(depsgraph, scene.display.shading, read)
    unseen = set() if is_whole(scene) else _outside(camera, shown, meshes)
    exported, owners = assemble(camera, background(scene), seen, shown, meshes, unseen)
    manifest = _manifest(depsgraph, camera.name, seen, meshes)
    return exported, replace(manifest, owners=owners)


def _read_once(
    known: dict[Any, Read | None], read: Callable[[Any, str, bool], Read | None], *args: Any
) -> Read | None:
    """Return what is known of an object's mesh, or read it; what had colours may be without."""
    obj, name, with_colors = args
    is_edited = getattr(obj.original.data, "is_editmode", False)  # of meshes alone
    key = name if is_edited else obj.data.as_pointer()
    if key not in known:
        known[key] = read(*args)
    found = known[key]
    if found is None or with_colors:
        return found
    mesh, left_out = found
    return replace(mesh, corner_colors=None), left_out


def assemble(
    camera: Camera,
    background: Colors,
    seen: dict[str, Seen],
    shown: list[Shown],
    meshes: dict[int, Read],
    unseen: Collection[int] = (),
) -> tuple[Scene, tuple[str, ...]]:
    """Return the scene that a camera sees, and the owner of each instance, then of each plane.

    What is `unseen`, by its number in `shown`, is left out. What each object shows is counted in
    `seen`.
    """
    numbers: dict[int, int] = {}  # of meshes that something shows, in Scene.meshes
    # Numbered in the order in which they come, in the view or not: it stays when the camera moves.
    objects: dict[str, int] = {}
    instances: list[tuple[Instance, str]] = []
    planes: list[tuple[Plane, str]] = []
    all_finite = np.isfinite([s.matrix for s in shown]).reshape(-1, 16).all(axis=1)
    for n, (item, finite) in enumerate(zip(shown, all_finite, strict=True)):
        entry = seen[item.name]
        if item.key is None:
            if finite and item.matrix[:3, :2].any(axis=0).all():
                index = objects.setdefault(item.name, len(objects))
                planes.append((_plane(index, item.matrix, item.colors[0]), item.owner))
                entry.instances += 1
            else:
                entry.left_out += 1
        elif n in unseen:
            objects.setdefault(item.name, len(objects))
            entry.outside += 1
        elif _count(entry, item.key, meshes[item.key], bool(finite)):
            number = numbers.setdefault(item.key, len(numbers))
            index = objects.setdefault(item.name, len(objects))
            instances.append((Instance(number, index, item.matrix, item.colors), item.owner))
    instances.sort(key=lambda i: i[0].object)
    scene = Scene(
        camera,
        tuple(meshes[key][0] for key in numbers),
        tuple(instance for instance, _ in instances),
        tuple(plane for plane, _ in planes),
        background,
        tuple(objects),
    )
    return scene, tuple(owner for _, owner in (*instances, *planes))


def _count(entry: Seen, key: int, read: Read, finite: bool) -> bool:
    """Count an appearance of a mesh; return whether any of its triangles can be traced."""
    mesh, left_out = read
    count = len(mesh.triangles)
    entry.left_out += left_out if finite else count + left_out
    if not finite or not count:
        return False
    entry.mesh_keys.setdefault(key)
    entry.instances += 1
    entry.triangles += count
    return True


def _outside(camera: Camera, shown: list[Shown], meshes: dict[int, Read]) -> set[int]:
    """Return which appearances of meshes no ray of the camera can meet, by their numbers."""
    whole = {
        n: meshes[item.key][0]
        for n, item in enumerate(shown)
        if item.key is not None and not meshes[item.key][1]
    }
    if not whole:
        return set()
    bounds = np.stack([mesh.bounds for mesh in whole.values()], axis=-1)
    matrices = np.stack([shown[n].matrix for n in whole], axis=-1)
    some = parts(len(whole), _TOGETHER)
    out = np.concatenate([outside(camera, bounds[..., k], matrices[..., k]) for k in some])
    return {n for n, is_out in zip(whole, out, strict=True) if is_out}


def _plane(index: int, matrix: Floats, color: Colors) -> Plane:
    """Return a plane through the object's origin, its normal the object's own +Z axis.

    The plane holds the object's X and Y axes, so under shear its normal is their cross product.
    """
    normal = np.cross(matrix[:3, 0], matrix[:3, 1])
    if (normal * matrix[:3, 2]).sum() < 0:  # mirrored
        normal = -normal
    return Plane(index, matrix[:3, 3], normal, color)


def _manifest(
    depsgraph: Depsgraph, camera: str, seen: dict[str, Seen], meshes: dict[int, Read]
) -> Manifest:
    drawn = depsgraph.scene
    layer = depsgraph.view_layer
    mode = depsgraph.mode
    scene = user_scene(drawn)
    gone = gone_objects()
    entries = [
        _entry(name, entry, [meshes[key][0] for key in entry.mesh_keys], gone.get(name, ""))
        for name, entry in seen.items()
    ]
    there = set(layer.objects)  # a name alone may be a library's object
    for obj in scene.objects:
        if obj.name_full not in seen:
            is_gone = obj.name_full in gone  # that excuses no pixel, as a flag that hides it does
            why = gone.get(obj.name_full) or _hidden(obj, obj in there, layer, mode)
            entries.append(ObjectEntry(obj.name_full, obj.type, False, why, hidden=not is_gone))
    features = [u for e in seen.values() for u in e.features.values()]
    return Manifest(
        file=bpy.path.basename(bpy.data.filepath),
        scene=scene.name,
        view_layer=layer.name,
        frame=scene.frame_current,
        evaluation=mode,
        camera=camera,
        objects=tuple(entries),
        unmodelled=(*features, *of_scene(scene, drawn), *missing(drawn, layer, mode, seen)),
        notes=notes(),
    )


def _entry(name: str, seen: Seen, meshes: list[Mesh], gone: str) -> ObjectEntry:
    exported = seen.instances > 0
    return ObjectEntry(
        name=name,
        type="INFINITE_PLANE" if exported and seen.is_plane else seen.type,
        exported=exported,
        reason="" if exported else gone or _nothing(seen),
        triangles=sum(len(mesh.triangles) for mesh in meshes),
        vertices=sum(len(mesh.vertices) for mesh in meshes),
        instances=seen.instances,
        outside=seen.outside,
        left_out=seen.left_out,
        empty_slots=seen.empty_slots,
        traced_triangles=seen.triangles,
    )


def _nothing(entry: Seen) -> str:
    if entry.outside:
        return OUTSIDE
    if entry.left_out:
        return "all its triangles have a vertex or a matrix that is not finite"
    if entry.type in NO_SURFACE:
        return "has no surface"
    return "has no triangles as it is evaluated and drawn here"


def _hidden(obj: Object, is_there: bool, layer: ViewLayer, mode: str) -> str:
    """Return why the depsgraph does not hand an object out."""
    flag = "hide_viewport" if mode == "VIEWPORT" else "hide_render"
    where = "the viewport" if mode == "VIEWPORT" else "renders"
    if getattr(obj, flag):
        return f"hidden in {where}"
    if not is_there:
        return f"not in view layer '{layer.name}' (its collection is excluded)"
    if mode == "VIEWPORT" and obj.hide_get(view_layer=layer):
        return "hidden in this view layer"
    return f"in a collection hidden in {where}, or its own display is off"

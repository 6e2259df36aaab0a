"""Finds what the camera sees of the open file: objects, and the faces of some meshes.

Faces are decided as a render has them. An attribute says which face of the user's mesh each comes
from: it goes through the modifiers on a copy of the object. Each of n faces has a random code below
2^31: what a modifier mixes of several is taken for one of them with a chance of n / 2^31.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple

import bpy
import numpy as np

from ...arrays import Bytes, Integers
from ...scene import SceneError
from ...tracer.progress import Work, scaled
from ...visible import steps
from ..evaluating import evaluated, export_for_render
from ..reading.camera import export_camera
from ..reading.export import export
from ..temporary import HIDDEN_FACES, everything, leave_out, made_for, temporary_scene
from ..turns import once
from ..values import values_restored
from .stepping import stepped

# Ranks: of what appears more than once, the highest counts. STATES has the state of each, and the
# rank of each state.
HIDDEN, MAY_BE, SEEN = range(3)
STATES = np.array([0, 2, 1], np.uint8)
_CODE = "reference_tracer_face"
_CODES = 2**31
_LINKED = "Mesh '{}' is linked from a library: nothing is stored with its faces"
_UNSURE = (
    "'{}' shows faces that modifiers or a simulation made, mixed, merged or left out: which of its "
    "own they come from is not known of all"
)


class CameraSees(NamedTuple):
    """The ranks of what a scene's camera sees.

    `objects` has that of each object that shows faces, by its full name: an instance is of what
    instances it. `faces` has those of each face (n,) of some meshes: it is seen if any that
    modifiers made of it is, in any object. `notes` name what is not known, or cannot be stored.
    """

    objects: dict[str, int]
    faces: dict[Any, Bytes]
    notes: dict[str, None]


def look(context: Any, meshes: Collection[Any], frames: Sequence[int]) -> Work[CameraSees]:
    """Find what is seen of all objects, and of the faces of meshes, as it is or in some frames.

    Raises
    ------
    SceneError
        If the scene has no camera, or a panorama's, or shows no faces.
    """
    scene = context.scene
    layer = context.view_layer.name
    objects: Any = bpy.data.objects
    own = {o.name_full: o for o in objects if o.data in meshes and not o.data.library}
    linked = (mesh.name for mesh in meshes if mesh.library)
    found = CameraSees({}, {}, dict.fromkeys(map(_LINKED.format, linked)))
    for obj in own.values():
        obj.update_from_editmode()
        unsure = MAY_BE * obj.reference_tracer.infinite_plane  # which has no faces
        found.faces[obj.data] = np.full(len(obj.data.polygons), unsure, np.uint8)
    if frames:
        with values_restored():
            for number, frame in enumerate(stepped(scene, frames)):
                work = _look(scene, layer, own, found)
                yield from scaled(work, number / len(frames), 1 / len(frames), f"frame {frame}")
    else:
        yield from _look(scene, layer, own, found)
    if not found.objects:
        raise SceneError(f"Scene '{scene.name}' shows no faces")
    return found


def _look(scene: Any, layer: str, own: Mapping[str, Any], found: CameraSees) -> Work[None]:
    """Add what is seen in this frame."""
    export_camera(scene)  # first: its errors name the user's scene
    with temporary_scene(scene, layer, (HIDDEN_FACES,)) as tmp, everything(tmp):
        whole, manifest = export_for_render(tmp)
        codes = _codes(tmp, own) if own else {}
    visible = yield from steps(whole)
    ranks = np.split(STATES[visible.seen], visible.start[1:-1])
    shown: dict[str, list[tuple[Integers, Bytes]]] = {}
    for instance, rank, owner in zip(whole.instances, ranks, manifest.owners, strict=False):
        found.objects[owner] = max(found.objects.get(owner, HIDDEN), int(np.max(rank)))
        name = whole.objects[instance.object]
        if name in own:
            triangles = whole.meshes[instance.mesh].triangles
            code = codes.get((name, triangles.tobytes()), np.zeros_like(rank))
            shown.setdefault(name, []).append((code, rank))
    for name, parts in shown.items():
        code, rank = map(np.concatenate, zip(*parts, strict=True))
        if _spread(found.faces[own[name].data], code, rank):
            found.notes[_UNSURE.format(name)] = None


def _spread(faces: Bytes, code: Integers, rank: Bytes) -> bool:
    """Give faces the ranks of an object's triangles (n,) that have their codes.

    If one that has no face's code may be seen, so may each face. And if any may be seen, so may
    each face that has left nothing: another one may have been merged with it. Returns whether there
    is such a face.
    """
    known = np.append(_codes_of(len(faces)), _CODES)  # the last one is nobody's
    number = np.searchsorted(known, code)
    is_known = known[number] == code
    np.maximum.at(faces, number[is_known], rank[is_known])
    unsure = np.full(len(faces), rank.any())
    unsure[number[is_known]] = rank[~is_known].any()
    faces[unsure] = np.maximum(faces[unsure], MAY_BE)
    return bool(unsure.any())


def _codes(tmp: Any, own: Mapping[str, Any]) -> dict[tuple[str, bytes], Integers]:
    """Return the codes of the triangles of objects' meshes, as a render has them.

    They are found by the object's name and the mesh's triangles: shape keys and simulations move
    points. The temporary scene has copies of the objects then, and nothing else.
    """
    leave_out(tmp, {*tmp.objects})
    coded = {obj.data: made_for(tmp, obj.data.copy()) for obj in own.values()}
    for mesh in coded.values():
        attribute = mesh.attributes.new(_CODE, "INT", "FACE")
        attribute.data.foreach_set("value", _codes_of(len(mesh.polygons)))
    names = {}
    for name, obj in own.items():
        copy = made_for(tmp, obj.copy())
        copy.data = coded[obj.data]
        copy.hide_render = False
        for modifier in copy.modifiers if obj.mode == "EDIT" else ():
            # What is edited is evaluated so, for a render, too.
            is_on = modifier.show_viewport and modifier.show_in_editmode
            modifier.show_render = is_on and getattr(modifier, "levels", 1) > 0
        tmp.collection.objects.link(copy)
        names[copy.name_full] = name
    copies, _ = evaluated(tmp, None, once(partial(export, slots=_CODE)))
    found: dict[tuple[str, bytes], Integers] = {}
    for instance in copies.instances:
        mesh = copies.meshes[instance.mesh]
        key = names.get(copies.objects[instance.object], ""), mesh.triangles.tobytes()
        code = mesh.slots
        found[key] = np.where(found.get(key, code) == code, code, 0)  # of any such mesh
    return found


def _codes_of(count: int) -> Integers:
    """Return different codes of so many faces, (n,) int32, in order; 0 is none."""
    codes = np.random.default_rng(0).choice(_CODES - 1, count, replace=False)
    return (1 + np.sort(codes)).astype(np.int32)

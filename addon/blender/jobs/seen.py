"""What the camera sees of the open file: of each object, and of each face of some meshes.

Faces are decided as a render has them. An attribute says which face of the user's mesh each comes
from: it goes through the modifiers on a copy of the object. A face's code is its number and two
random ones, so that what a modifier mixes of several faces is taken for none of them.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import bpy
import numpy as np

from ...arrays import Bytes, Floats, Index, Integers
from ...scene import Mesh, SceneError
from ...tracer.progress import Work, scaled
from ...visible import SEEN, steps
from ...wording import count_of
from ..evaluating import evaluated, export_for_render
from ..reading.camera import export_camera
from ..reading.meshes import read_mesh
from ..temporary import HIDDEN_FACES, everything, made_for, temporary_scene
from ..turns import Turns
from ..values import values_restored
from .stepping import stepped

# Of each state, and so the state of each: of a face that appears twice, the higher one counts.
_RANKS = np.array([0, 2, 1], np.uint8)
_MAY_BE = 1  # the rank of what is undecided
_CODE = "reference_tracer_face"
_EXACT = 2**24  # float32 has all whole numbers up to this
_MIXED, _MADE = -1, -2  # in place of a face's number: it comes from several, or from none

# An object's name, and the vertices and triangles of a mesh that it shows.
_Key: TypeAlias = tuple[str, bytes, bytes]
_Origins: TypeAlias = dict[_Key, Index | None]


@dataclass(eq=False)
class CameraSees:
    """What the camera sees, in one frame or in any of several, by full names.

    `objects` has the rank of each object that shows faces: instances are of what instances them.
    `faces` has for each mesh that was asked for the rank of each of its faces, (n,), and `frames`
    in how many frames each is seen. `notes` say of which nothing can be said, and why.
    """

    faces: dict[str, Bytes]
    frames: dict[str, Integers]
    objects: dict[str, int] = field(default_factory=dict)
    notes: dict[str, None] = field(default_factory=dict)

    def states(self, mesh: Any) -> Bytes:
        """Return HIDDEN, SEEN or UNDECIDED for each face of a mesh, (n,)."""
        return _RANKS[self.faces[mesh.name_full]]

    def state(self, obj: Any) -> int | None:
        """Return that of an object; None if it shows no faces."""
        rank = self.objects.get(obj.name_full)
        return None if rank is None else int(_RANKS[rank])


def camera_sees(context: Any, meshes: Collection[Any], frames: Sequence[int]) -> Work[CameraSees]:
    """Find what the camera of the context's scene sees, in its frame or in any of some.

    A face is seen if any that modifiers made of it is, in any object that has the mesh.

    Raises
    ------
    SceneError
        If the scene has no camera of which this can be said, or shows no faces.
    """
    scene, layer = context.scene, context.view_layer.name
    objects = [o for o in bpy.data.objects if o.type == "MESH" and o.data in meshes]
    for obj in objects:
        obj.update_from_editmode()
    counts = {mesh.name_full: len(mesh.polygons) for mesh in meshes}
    found = CameraSees(
        {name: np.zeros(count, np.uint8) for name, count in counts.items()},
        {name: np.zeros(count, np.int32) for name, count in counts.items()},
    )
    if not frames:
        yield from _look(scene, layer, objects, found)
    with values_restored():
        for number, frame in enumerate(stepped(scene, [*frames])):
            work = _look(scene, layer, objects, found)
            yield from scaled(work, number / len(frames), 1 / len(frames), f"frame {frame}")
    if not found.objects:
        raise SceneError(f"Scene '{scene.name}' shows no faces")
    return found


def _look(scene: Any, layer: str, objects: Sequence[Any], found: CameraSees) -> Work[None]:
    """Add what is seen in the scene's frame."""
    export_camera(scene)  # first: its errors name the user's scene
    with temporary_scene(scene, layer, (HIDDEN_FACES,)) as tmp:
        with everything(tmp):
            exported, manifest, _ = export_for_render(tmp)
        origins = _origins(tmp, objects) if objects else {}
    visible = yield from steps(exported)
    ranks = np.split(_RANKS[visible.seen], visible.start[1:-1])
    meshes = {obj.name_full: obj.data.name_full for obj in objects}
    now = {name: np.zeros_like(before) for name, before in found.faces.items()}
    owners = iter(manifest.owners)
    for instance, rank, owner in zip(exported.instances, ranks, owners, strict=False):
        found.objects[owner] = max(found.objects.get(owner, 0), int(np.max(rank, initial=0)))
        name = exported.objects[instance.object]
        if name in meshes:
            origin = origins.get(_key(name, exported.meshes[instance.mesh]))
            _note(name, origin, rank, found.notes)
            _spread(origin, rank, now[meshes[name]])
    for plane, owner in zip(exported.planes, owners, strict=True):
        found.objects[owner] = max(found.objects.get(owner, 0), _MAY_BE)
        name = exported.objects[plane.object]
        found.notes[f"'{name}' is an infinite plane: it has no faces"] = None
        if name in meshes:
            _spread(None, np.array([_MAY_BE], np.uint8), now[meshes[name]])
    for name, own in now.items():
        np.maximum(found.faces[name], own, out=found.faces[name])
        found.frames[name] += own == _RANKS[SEEN]


def _spread(origin: Index | None, rank: Bytes, faces: Bytes) -> None:
    """Give faces the ranks (n,) of the triangles that come from them.

    If a triangle of unknown origin may be seen, so may each face.
    """
    unknown = rank if origin is None else rank[origin == _MIXED]
    np.maximum(faces, min(_MAY_BE, int(np.max(unknown, initial=0))), out=faces)
    if origin is not None:
        np.maximum.at(faces, origin[origin >= 0], rank[origin >= 0])


def _note(name: str, origin: Index | None, rank: Bytes, notes: dict[str, None]) -> None:
    """Say of which triangles that may be seen it is not known which faces they come from."""
    if origin is None:
        if rank.any():
            why = "its modifiers keep no account, or it is simulated, or not finite"
            notes[f"'{name}': nobody knows what its faces come from: {why}"] = None
        return
    for number, where in ((_MIXED, "several faces"), (_MADE, "no face: a modifier made them")):
        if count := int(np.count_nonzero(rank[origin == number])):
            comes = count_of(count, "triangle comes", "triangles come")
            notes[f"'{name}': {comes} from {where}"] = None


def _origins(tmp: Any, objects: Sequence[Any]) -> _Origins:
    """Return which face each triangle of objects' meshes comes from, as a render has them.

    The temporary scene has copies of the objects then, and nothing else. An object whose copy has
    not the same mesh is not found: so nothing is taken for granted of what a copy has.
    """
    for collection in tmp.collection.children[:]:
        tmp.collection.children.unlink(collection)
    for obj in tmp.collection.objects[:]:
        tmp.collection.objects.unlink(obj)
    codes: dict[str, tuple[str, Floats]] = {}
    for obj in objects:
        copy = made_for(tmp, obj.copy())
        copy.data = made_for(tmp, obj.data.copy())
        copy.hide_render = False
        for modifier in copy.modifiers if obj.mode == "EDIT" else ():
            modifier.show_render = modifier.show_render and modifier.show_in_editmode
        code = np.random.default_rng(0).integers(1, _EXACT, (len(copy.data.polygons), 3))
        code[:, 0] = np.arange(len(code))
        attribute = copy.data.attributes.new(_CODE, "FLOAT_VECTOR", "FACE")
        attribute.data.foreach_set("vector", code.astype(np.float32).ravel())
        tmp.collection.objects.link(copy)
        codes[copy.name_full] = obj.name_full, code.astype(np.float32)
    return evaluated(tmp, tmp.view_layers[0].name, None, _read(codes))


def _read(codes: dict[str, tuple[str, Floats]]) -> Turns[_Origins]:
    """Read the meshes of copies, by their names; `codes` has the names of what they are copies of.

    It is None where the attribute is no more, or triangles were left out.
    """
    found: _Origins = {}
    for item in (yield False).object_instances:
        obj = item.object
        name, code = codes.get(obj.original.name_full, ("", None))
        if code is not None and obj.type == "MESH":
            read = read_mesh(obj, name, with_colors=False, hiding=False)
            if read:
                origin = _faces_of(obj.data, code)
                found[_key(name, read[0])] = None if read[1] else origin
    return found


def _key(name: str, mesh: Mesh) -> _Key:
    return name, mesh.vertices.tobytes(), mesh.triangles.tobytes()


def _faces_of(mesh: Any, code: Floats) -> Index | None:
    """Return the number of the face that each triangle comes from, (n,); None if it is lost."""
    attribute = mesh.attributes.get(_CODE)
    if not attribute or (attribute.domain, attribute.data_type) != ("FACE", "FLOAT_VECTOR"):
        return None
    values = np.empty((len(mesh.polygons), 3), np.float32)
    attribute.data.foreach_get("vector", values.ravel())
    number = np.clip(np.nan_to_num(values[:, 0]), 0, len(code) - 1).astype(np.intp)
    number[(code[number] != values).any(axis=1)] = _MIXED
    number[~values.any(axis=1)] = _MADE
    polygon = np.empty(len(mesh.loop_triangles), np.int32)
    mesh.loop_triangle_polygons.foreach_get("value", polygon)
    return number[polygon]

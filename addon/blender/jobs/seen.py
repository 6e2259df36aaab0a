"""Finds what the camera sees of the open file: objects, and the faces of some meshes.

Faces are decided as a render has them. An attribute says which face of the user's mesh each comes
from: it goes through the modifiers on a copy of the object. Of n faces, each has a code below 2^31
whose first part is its number and whose rest is random: what a modifier mixes of several faces is
taken for one of them with a chance of n / 2^31.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, TypeAlias

import bpy
import numpy as np

from ...arrays import Bytes, Integers
from ...scene import Mesh, SceneError
from ...tracer.progress import Work, scaled
from ...visible import steps
from ..evaluating import evaluated, export_for_render
from ..reading.camera import export_camera
from ..reading.meshes import read_mesh
from ..temporary import HIDDEN_FACES, everything, made_for, temporary_scene
from ..turns import Turns
from ..values import values_restored
from .stepping import stepped

# Of each state; of each rank, its state. Of what appears more than once, the highest rank counts.
RANKS = np.array([0, 2, 1], np.uint8)
_MAY_BE = 1  # the rank of what is undecided
_CODE = "reference_tracer_face"
_CODES = 2**31

# An object's name, and the triangles of a mesh that it shows; shape keys and simulations move them.
_Key: TypeAlias = tuple[str, bytes]


class CameraSees:
    """The ranks of what a scene's camera sees, over all frames that were looked at.

    `objects` has that of each object that shows faces, by its full name: an instance is of what
    instances it. `faces` has those of each face (n,) of the meshes that were asked for: it is seen
    if any that modifiers made of it is, in any object. `notes` name those that are not known.
    """

    def __init__(self, context: Any, meshes: Collection[Any]) -> None:
        self._scene = context.scene
        self._layer = context.view_layer.name
        objects: Any = bpy.data.objects
        own = [o for o in objects if o.type == "MESH" and o.data in meshes]
        for obj in own:
            obj.update_from_editmode()
        planes = {obj.data for obj in own if obj.reference_tracer.infinite_plane}  # have no faces
        self._own: dict[str, Any] = {obj.name_full: obj for obj in own}
        self.objects: dict[str, int] = {}
        self.faces = {m: np.full(len(m.polygons), m in planes, np.uint8) for m in meshes}
        self.notes: dict[str, None] = {}

    def look(self, frames: Sequence[int]) -> Work[CameraSees]:
        """Look at the scene as it is, or in some frames.

        Raises
        ------
        SceneError
            If it has no camera, or a panorama's, or shows no faces.
        """
        if not frames:
            yield from self._look()
        with values_restored():
            for number, frame in enumerate(stepped(self._scene, [*frames])):
                share = number / len(frames)
                yield from scaled(self._look(), share, 1 / len(frames), f"frame {frame}")
        if not self.objects:
            raise SceneError(f"Scene '{self._scene.name}' shows no faces")
        return self

    def _look(self) -> Work[None]:
        export_camera(self._scene)  # first: its errors name the user's scene
        with temporary_scene(self._scene, self._layer, (HIDDEN_FACES,)) as tmp:
            with everything(tmp):
                scene, manifest = export_for_render(tmp)
            codes = self._codes(tmp) if self._own else {}
        visible = yield from steps(scene)
        ranks = np.split(RANKS[visible.seen], visible.start[1:-1])
        for instance, rank, owner in zip(scene.instances, ranks, manifest.owners, strict=False):
            self.objects[owner] = max(self.objects.get(owner, 0), int(np.max(rank, initial=0)))
            name = scene.objects[instance.object]
            if name in self._own:
                code = codes.get(_key(name, scene.meshes[instance.mesh]))
                self._spread(name, np.zeros_like(rank) if code is None else code, rank)

    def _spread(self, name: str, code: Integers, rank: Bytes) -> None:
        """Give faces the ranks of the triangles (n,) that have their codes.

        If one may be seen that has no face's code, so may each face.
        """
        faces = self.faces[self._own[name].data]
        known = np.append(_codes_of(len(faces)), _CODES)  # the last one is nobody's
        number = np.searchsorted(known, code)
        found = known[number] == code
        np.maximum.at(faces, number[found], rank[found])
        if rank[~found].any():
            np.maximum(faces, _MAY_BE, out=faces)
            self.notes[
                f"'{name}' shows faces that modifiers or a simulation made or mixed: nobody knows "
                "which of its own they come from"
            ] = None

    def _codes(self, tmp: Any) -> dict[_Key, Integers]:
        """Return the codes of the triangles of the objects' meshes, as a render has them.

        The temporary scene has copies of the objects then, and nothing else. Where a copy has not
        the same triangles, it is not found.
        """
        for items in (tmp.collection.children, tmp.collection.objects):
            for item in items[:]:
                items.unlink(item)
        coded = {mesh: made_for(tmp, mesh.copy()) for mesh in self.faces}
        for mesh in coded.values():
            attribute = mesh.attributes.new(_CODE, "INT", "FACE")
            attribute.data.foreach_set("value", _codes_of(len(mesh.polygons)))
        names = {}
        for name, obj in self._own.items():
            copy = made_for(tmp, obj.copy())
            copy.data = coded[obj.data]
            copy.hide_render = False
            for modifier in copy.modifiers if obj.mode == "EDIT" else ():
                modifier.show_render = modifier.show_render and modifier.show_in_editmode
            tmp.collection.objects.link(copy)
            names[copy.name_full] = name
        return evaluated(tmp, None, _read(names))


def _codes_of(count: int) -> Integers:
    """Return the codes of so many faces, (n,) int32, the least first; 0 is none."""
    part = _CODES // (count + 1)
    codes = (1 + np.arange(count)) * part + np.random.default_rng(0).integers(0, part, count)
    return codes.astype(np.int32)


def _read(names: dict[str, str]) -> Turns[dict[_Key, Integers]]:
    """Return the codes of copies' triangles; `names` has those of what they are copies of."""
    found: dict[_Key, Integers] = {}
    for item in (yield False).object_instances:
        name = names.get(item.object.original.name_full, "")
        if name and item.object.type == "MESH":
            read = read_mesh(item.object, name, with_colors=False, hiding=False, slots=_CODE)
            if read:
                key = _key(name, read[0])
                code = read[0].slots
                found[key] = np.where(found.get(key, code) == code, code, 0)  # of any such mesh
    return found


def _key(name: str, mesh: Mesh) -> _Key:
    return name, mesh.triangles.tobytes()

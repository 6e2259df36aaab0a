"""Meshes in Edit Mode."""

from __future__ import annotations

from typing import Any

import bpy

from .stage import CYAN, ORANGE, colored, stage


def _edited(build: Any, *modifiers: str) -> Any:
    """A block of two materials by face, shown as its modifiers leave it, to be edited."""
    stage(build)
    obj = build.cube("Edited", 0.9, location=(0, -1.2, 0.3), rotation=(0.3, 0.2, 0.5))
    for name, rgb in (("Orange", ORANGE), ("Cyan", CYAN)):
        obj.data.materials.append(colored(build, name, rgb))
    for face in list(obj.data.polygons)[::2]:
        face.material_index = 1
    for kind in modifiers:
        obj.modifiers.new(kind, kind)
    bpy.context.view_layer.objects.active = obj
    return obj


def _edit() -> None:
    bpy.ops.object.mode_set(mode="EDIT")


def edited(build: Any) -> None:
    _edited(build)
    _edit()


def edited_with_mirror(build: Any) -> None:
    obj = _edited(build, "MIRROR")
    for vertex in obj.data.vertices:
        vertex.co.x += 0.6
    _edit()


def edited_with_subdivision(build: Any) -> None:
    modifier = _edited(build, "SUBSURF").modifiers[0]
    modifier.levels = modifier.render_levels = 2
    _edit()


def edited_without_its_modifier(build: Any) -> None:
    """The modifier is there, but not in Edit Mode."""
    modifier = _edited(build, "SUBSURF").modifiers[0]
    modifier.levels = modifier.render_levels = 2
    modifier.show_in_editmode = False
    _edit()


def edited_shared(build: Any) -> None:
    """One mesh of two objects and an instanced one; one of the objects has a modifier."""
    obj = _edited(build, "SUBSURF")
    obj.modifiers[0].levels = obj.modifiers[0].render_levels = 1
    other = build.object("Other", obj.data)
    other.location, other.scale = (1.1, -1.2, 0.4), (0.8, 0.8, 0.8)
    instanced = bpy.data.objects.new("Instanced", obj.data)
    build.instances(
        "Instances",
        build.collection("Kit", instanced),
        location=(-0.9, -1.2, -0.4),
        scale=(0.6, 0.6, 0.6),
    )
    _edit()


def edited_and_changed(build: Any) -> None:
    """An edit that has not left Edit Mode yet: what is drawn is no longer what is stored."""
    import bmesh

    obj = _edited(build)
    _edit()
    editing = bmesh.from_edit_mesh(obj.data)
    for vertex in editing.verts:
        if vertex.co.z > 0:
            vertex.co.z += 0.7
    bmesh.update_edit_mesh(obj.data)


def edited_and_hidden(build: Any) -> None:
    """Every third face is hidden there, and the mesh has another user."""
    obj = _edited(build)
    other = build.object("Other", obj.data)
    other.location = (1.1, -1.2, 0.4)
    _edit()
    hide_faces(obj.data, 3)


def edited_subdivided_and_hidden(build: Any) -> None:
    """What a modifier makes of hidden faces is shown by a render."""
    obj = _edited(build, "SUBSURF")
    other = build.object("Other", obj.data)
    other.location = (1.1, -1.2, 0.4)
    _edit()
    hide_faces(obj.data, 1)


def hide_faces(mesh: Any, step: int) -> None:
    """Hide every so many faces of a mesh in Edit Mode, as pressing H does."""
    import bmesh

    for face in bmesh.from_edit_mesh(mesh).faces:
        face.hide_set(face.index % step == 0)
    bmesh.update_edit_mesh(mesh)


EDIT_MODE = (
    edited,
    edited_with_mirror,
    edited_with_subdivision,
    edited_without_its_modifier,
    edited_shared,
    edited_and_changed,
    edited_and_hidden,
    edited_subdivided_and_hidden,
)

"""Names the libraries, data-blocks and files that a .blend needs for its picture and lacks.

Blender shows something in their place, or nothing. So the picture that is compared is not what the
file is meant to show: a warning, which explains no pixel.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator
from typing import Any

import bpy
from bpy.types import ID, Object, Scene, ViewLayer

from ...manifest import Effect, Unmodelled
from ...wording import listed
from .missing_files import Lost, exists, lost_files

MOST = 5  # things that one line names
# Uses that a data-block passes on, by the types of both (`ID.id_type`): the rest of it
# is not seen in surfaces that show one colour. One that is not here passes on everything.
_PASSES = {
    "SCENE": ("ACTION",),
    "MATERIAL": ("ACTION",),
    "CAMERA": ("ACTION",),
    "WORLD": (),
    "LIGHT": (),
    "LIGHT_PROBE": (),
    "SPEAKER": (),
}
_UNSEEN = ("LIGHT", "LIGHT_PROBE", "SPEAKER", "WORLD", "SOUND", "TEXT")  # types of data-blocks
_OF_MATERIALS = ("MATERIAL", "TEXTURE")  # types of colours


_Users = dict[Any, set[Any]]  # as `bpy.data.user_map` has it: of each data-block, what uses it


def missing(
    drawn: Scene, layer: ViewLayer, mode: str, shown: Collection[str]
) -> Iterator[Unmodelled]:
    """Yield what is missing of what a scene shows.

    Parameters
    ----------
    drawn : bpy.types.Scene
        The scene that is exported: the user's, or a temporary copy of it.
    layer : bpy.types.ViewLayer
    mode : str
        The evaluation, 'VIEWPORT' or 'RENDER'.
    shown : collection of str
        The full names of the objects that the depsgraph hands out.
    """
    named = [*lost_files(mode, drawn.frame_current), *_unknown_nodes()]
    if not (named or bpy.data.libraries or bpy.app.autoexec_fail):
        return  # it takes time to find out what uses what
    users = bpy.data.user_map()
    flag = "show_render" if mode == "RENDER" else "show_viewport"
    reached = _reached(users, _first(drawn, layer, mode, shown), flag)
    unseen = "" if drawn.display.shading.color_type in _OF_MATERIALS else "MATERIAL"
    every = (*_placeholders(users), *named)
    lost = [t for t in every if t.block in reached and t.block.id_type != unseen]
    yield from _told(lost, users, reached, flag)
    if bpy.app.autoexec_fail:
        yield from _drivers(reached)


def gone_objects() -> dict[str, str]:
    """Return why objects are placeholders, or show one, by their full names."""
    if not bpy.data.libraries:
        return {}
    return {obj.name_full: why for obj in bpy.data.objects if (why := why_gone(obj))}


def why_gone(obj: Object) -> str:
    """Return why an object is a placeholder, or shows one; empty if neither is so."""
    for block in (obj, obj.data, obj.instance_collection):
        if block and block.is_missing:
            lacks = "does not have it" if _is_there(block) else "is missing"
            whose = "its library" if block == obj else f"the library of its {_named(block)},"
            return f"{whose} '{_library(block)}' {lacks}"
    return ""


def _placeholders(blocks: Iterable[Any]) -> Iterator[Lost]:
    """Yield the placeholders of what libraries should have had."""
    for block in blocks:
        if block.is_missing and block.id_type not in _UNSEEN and block.id_type != "LIBRARY":
            kind = "data in library" if _is_there(block) else "library"
            yield Lost(block, kind, _library(block), _named(block))


def _unknown_nodes() -> Iterator[Lost]:
    """Yield the nodes in use that this Blender does not know: of another version, or an add-on."""
    for tree in bpy.data.node_groups:
        for node in tree.nodes:
            in_use = any(socket.is_linked for socket in node.outputs)
            if node.bl_idname == "NodeUndefined" and in_use:
                yield Lost(tree, "type of node", node.name, f"node group '{tree.name}'")


def _source(block: ID) -> Any:
    """Return the library of a placeholder, or of what an override overrides."""
    override = block.override_library
    return override.reference.library if override and override.reference else block.library


def _library(block: ID) -> str:
    source = _source(block)
    return source.filepath if source else "unknown"


def _is_there(block: ID) -> bool:
    """Return whether the library of a placeholder is a file."""
    source = _source(block)
    return bool(source) and exists(source, source.filepath)


def _named(block: Any) -> str:
    return f"{block.bl_rna.name.lower()} '{block.name}'"


def _first(drawn: Scene, layer: ViewLayer, mode: str, shown: Collection[str]) -> Iterator[Any]:
    """Yield the data-blocks that are seen without being used by anything else."""
    yield drawn
    yield drawn.camera
    yield from _gone_collections(layer.layer_collection, mode)
    there = set(layer.objects)
    for obj in bpy.data.objects:  # those of a background scene are shown, too
        is_shown = obj.name_full in shown and obj.type not in (*_UNSEEN, "CAMERA")
        if is_shown or (obj.is_missing and obj in there):
            yield obj


def _gone_collections(parent: Any, mode: str) -> Iterator[Any]:
    """Yield the placeholders of collections that a view layer, or a part of it, would show."""
    for child in parent.children:
        own = child.collection
        hidden = own.hide_render if mode == "RENDER" else own.hide_viewport or child.hide_viewport
        if not (child.exclude or hidden):
            if own.is_missing:
                yield own
            yield from _gone_collections(child, mode)


def _reached(users: _Users, first: Iterable[Any], flag: str) -> set[Any]:
    """Return the data-blocks that shape the picture, by modifiers with a flag."""
    uses: dict[Any, list[Any]] = defaultdict(list)
    for block, of_block in users.items():
        for user in of_block:
            if _passes(user, block, flag):
                uses[user].append(block)
    reached: set[Any] = set()
    left = list(first)
    while left:
        block = left.pop()
        if block not in reached:
            reached.add(block)
            left += uses[block]
    return reached


def _passes(user: Any, used: Any, flag: str) -> bool:
    """Return whether what a data-block uses can be seen in it, by modifiers with a flag.

    A property of an object's may name any tree of nodes, such as an add-on's.
    """
    if user.id_type == "NODETREE":
        return bool(user.type == "GEOMETRY")
    if user.id_type == "OBJECT":
        if user.type == "ARMATURE":  # bones are not drawn, whatever their shape
            return used == user.parent or used not in [b.custom_shape for b in user.pose.bones]
        if used.id_type == "NODETREE":
            nodes = (m for m in user.modifiers if m.type == "NODES" and getattr(m, flag))
            return any(m.node_group == used for m in nodes)
        return user.type != "EMPTY" or used.id_type != "IMAGE"
    return used.id_type in _PASSES.get(user.id_type, (used.id_type,))


def _told(
    lost: Iterable[Lost], users: _Users, reached: set[Any], flag: str
) -> Iterator[Unmodelled]:
    """Yield an entry for each library, file and folder that is missing."""
    found: dict[tuple[str, str], list[str]] = defaultdict(list)
    for thing in lost:
        names = sorted(_objects(thing.block, users, reached, flag))
        of = "" if thing.block.id_type == "OBJECT" or not names else f" of {listed(names, MOST)}"
        found[thing.kind, thing.name].append(thing.of + of)
    for (kind, name), things in found.items():
        yield Unmodelled(name, f"missing {kind}", listed(things, MOST), None, Effect.MISSING)


def _objects(block: ID, users: _Users, reached: set[Any], flag: str) -> set[str]:
    """Return the names of the objects by which a data-block is seen, in quotes."""
    found: set[str] = set()
    seen: set[Any] = set()
    left = [block]
    while left:
        user = left.pop()
        if user.id_type == "OBJECT":
            found.add(f"'{user.name}'")
        elif user not in seen:
            seen.add(user)
            left += [u for u in users.get(user, ()) if u in reached and _passes(u, user, flag)]
    return found


def _drivers(blocks: Iterable[Any]) -> Iterator[Unmodelled]:
    """Yield the drivers with Python that Blender has not run, as scripts are off."""
    for block in blocks:
        animation = getattr(block, "animation_data", None)
        drivers = animation.drivers if animation else ()
        names = [curve.data_path for curve in drivers if _was_not_run(curve)]
        if names:
            detail = f"scripts are off: {listed(list(dict.fromkeys(names)), MOST)}"
            yield Unmodelled(block.name, "driver that did not run", detail, None, Effect.MISSING)


def _was_not_run(curve: Any) -> bool:
    driver = curve.driver
    is_python = driver.type == "SCRIPTED" and not driver.is_simple_expression
    return is_python and not driver.is_valid and not curve.mute

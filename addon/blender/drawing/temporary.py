"""A copy of the user's scene, on which everything that a picture needs is set.

Its objects are the user's own; its settings, view layers and top collection are its own, and go
with it. Objects are left out of it: collections that hold such an object are replaced by copies.
The user's scene, view and Render Result stay as they are. What is to be set on an object itself is
`untold`, and put back.

A render evaluates the animation of the frame and writes the result into the user's own objects.
What he has moved but not keyed yet would be lost: `values_kept` puts it back.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..versions import curves

# Custom properties: of what the add-on itself draws in a scene; of the stand-in of an infinite
# plane, with the name of the object that is the plane.
DRAWN, STANDS_FOR = "reference_tracer_drawn", "reference_tracer_stands_for"

_NOT_DRAWN = ("ARMATURE", "CAMERA", "LATTICE", "LIGHT", "LIGHT_PROBE", "SPEAKER")

# By the name of a temporary scene: the user's, the judge, copies of collections that are in it.
_copies: dict[str, tuple[str, Any, list[Any]]] = {}


@contextmanager
def temporary_scene(scene: Any, layer: str | None = None, judge: Any = None) -> Iterator[Any]:
    """Give a copy of a scene that renders one view layer and nothing else; remove it in any case.

    Sequencer, compositor, multiview, stamps, freestyle and motion blur are off in it. The 'Render
    Result' that a render of it makes goes, too, if there was none before. The layer is the scene's
    first by default; the judge is whose picture it is for.
    """
    images = set(bpy.data.images)
    copy = scene.copy()
    own: list[Any] = []
    _copies[copy.name_full] = scene.name_full, judge, own
    try:
        _isolate(copy, layer or scene.view_layers[0].name)
        yield copy
    finally:
        del _copies[copy.name_full]
        # Under `blender --command` there is no window, and scenes.remove() would crash (4.3).
        bpy.data.batch_remove([copy, *own])
        for image in set(bpy.data.images) - images:
            if image.type == "RENDER_RESULT":
                bpy.data.images.remove(image)


def user_scene(scene: Any) -> Any:
    """Return the scene of the user's that a temporary one is a copy of; another is the user's."""
    name = _copies[scene.name_full][0] if is_temporary(scene) else scene.name_full
    return next(s for s in bpy.data.scenes if s.name_full == name)


def is_temporary(scene: Any) -> bool:
    """Return whether a scene is such a copy."""
    return scene.name_full in _copies


def judge_of(scene: Any) -> Any:
    """Return whose picture a temporary scene is for; None for a scene of the user's."""
    return _copies[scene.name_full][1] if is_temporary(scene) else None


def _isolate(scene: Any, layer: str) -> None:
    render = scene.render
    render.use_compositing = render.use_multiview = False
    render.use_stamp = render.use_freestyle = render.use_motion_blur = False
    # With `use_sequencer` off, handlers that add or remove data crash Blender (5.2).
    scene.sequence_editor_clear()
    _spare_bodies(scene, scene.frame_current)
    # Rendering another layer than the first by its name crashes Blender (5.2).
    for other in [v for v in scene.view_layers if v.name != layer]:
        scene.view_layers.remove(other)
    scene.view_layers[layer].use = True
    _leave_out_drawings(scene.view_layers[layer].layer_collection)


def go_to(scene: Any, frame: int) -> None:
    """Step a temporary scene to a frame."""
    _spare_bodies(scene, frame)
    scene.frame_set(frame)


def _spare_bodies(scene: Any, frame: int) -> None:
    # Bodies would be simulated in this scene, the user's own, and freed when it goes: Blender then
    # crashes. So it is, measured, with baked ones in the second frame of their cache.
    if bodies := scene.rigidbody_world:
        cache = bodies.point_cache
        if not cache.is_baked or frame == cache.frame_start + 1:
            bodies.enabled = False  # set only then: Blender takes any setting for a change


def _leave_out_drawings(parent: Any) -> None:
    """Exclude what the add-on has drawn about the scene, wherever the user has put it."""
    for child in parent.children:
        if child.collection.get(DRAWN):
            child.exclude = True
        else:
            _leave_out_drawings(child)


def leave_out(tmp: Any, layer: str, objects: Collection[Any]) -> None:
    """Take objects out of a temporary scene."""
    top = tmp.view_layers[layer].layer_collection
    _leave_out(tmp.collection, top, objects, _copies[tmp.name_full][2])


def _leave_out(collection: Any, layer: Any, objects: Collection[Any], copies: list[Any]) -> None:
    for child in list(collection.children):
        if not any(obj in objects for obj in child.all_objects):
            continue
        if child not in copies:
            old, child = child, child.copy()
            copies.append(child)
            collection.children.link(child)  # before the old one goes: hidden objects stay hidden
            _copy_flags(layer.children[old.name], layer.children[child.name])
            collection.children.unlink(old)
        _leave_out(child, layer.children[child.name], objects, copies)
    for obj in [o for o in collection.objects if o in objects]:
        collection.objects.unlink(obj)


def _copy_flags(source: Any, target: Any) -> None:
    for name in ("exclude", "hide_viewport", "holdout", "indirect_only"):
        setattr(target, name, getattr(source, name))
    for a, b in zip(source.children, target.children, strict=True):
        _copy_flags(a, b)


def drawn(tmp: Any, layer: str) -> list[Any]:
    """Return the objects of a view layer that may be drawn, or instance what is."""
    return [o for o in tmp.view_layers[layer].objects if o.type not in _NOT_DRAWN]


@contextmanager
def in_colors(objects: Sequence[Any], colors: NDArray[np.float32]) -> Iterator[None]:
    """Show objects in object colours (n, 3), for a while."""
    opaque = np.column_stack((colors, np.ones(len(colors)))).astype(np.float32)
    rows = dict(zip(objects, opaque, strict=True))
    with untold(bpy.data.objects, "color", rows):
        yield


@contextmanager
def untold(blocks: Any, name: str, values: Mapping[Any, Any]) -> Iterator[None]:
    """Give a property of some of the user's data-blocks other values, for a while.

    Blender is not told: as it is set for all at once, nothing is tagged. If it were, particles that
    are not baked would be reset, for good; and a copy of an object has no simulation at all. So it
    shows where a scene is evaluated for the first time: in a render, or in a new temporary scene.
    """
    before = _set(blocks, name, values) if values else {}
    try:
        yield
    finally:
        if before:
            _set(blocks, name, before)


def _set(blocks: Any, name: str, values: Mapping[Any, Any]) -> dict[Any, Any]:
    """Set a property of some data-blocks, and return what it was."""
    some = np.asarray(next(iter(values.values())))
    held = np.zeros((len(blocks), *some.shape), some.dtype)
    flat = held.reshape(-1)
    blocks.foreach_get(name, flat)
    before = {}
    for number, block in enumerate(blocks):
        if block in values:
            before[block] = held[number].copy()
            held[number] = values[block]
    blocks.foreach_set(name, flat)
    for block in before:
        if not block.is_editable:  # of a library: what sets all at once passes it over
            rna, value = block.bl_rna.properties[name], values[block].tolist()
            if rna.type == "ENUM":
                value = next(i.identifier for i in rna.enum_items if i.value == value)
            setattr(block, name, value)
    return before


@contextmanager
def values_kept() -> Iterator[None]:
    """Put animated values back to what they were."""
    before = [(block, path, _value(block, path)) for block, path in set(_animated())]
    try:
        yield
    finally:
        for block, path, value in before:
            if value is not None and _value(block, path) != value:
                _assign(block, path, value)


def _animated() -> Iterator[tuple[Any, str]]:
    """Yield every data-block and path that an action animates."""
    for prop in bpy.data.bl_rna.properties:
        if prop.type == "COLLECTION":
            for block in getattr(bpy.data, prop.identifier):
                for owner in (block, getattr(block, "node_tree", None)):
                    yield from ((owner, curve.data_path) for curve in _curves(owner))


def is_animated(obj: Any, *paths: str) -> bool:
    """Return whether an animation or a driver sets one of an object's properties."""
    drivers = obj.animation_data.drivers if obj.animation_data else ()
    return any(curve.data_path in paths for curve in (*_curves(obj), *drivers))


def _curves(owner: Any) -> Iterator[Any]:
    if data := getattr(owner, "animation_data", None):
        strips = (strip for track in data.nla_tracks for strip in track.strips)
        for action in filter(None, (data.action, *(strip.action for strip in strips))):
            yield from curves(action)


def _value(block: Any, path: str) -> Any:
    """Return a value that no longer belongs to Blender; None where the path leads nowhere."""
    try:
        value = block.path_resolve(path)
    except (ValueError, TypeError):
        return None
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _assign(block: Any, path: str, value: Any) -> None:
    if path.endswith("]"):  # a custom property: pose.bones["Arm"]["bend"]
        at = path.rindex("[")
        owner = block.path_resolve(path[:at]) if at else block
        owner[path[at + 2 : -2]] = value
    else:
        parent, _, name = path.rpartition(".")
        setattr(block.path_resolve(parent) if parent else block, name, value)

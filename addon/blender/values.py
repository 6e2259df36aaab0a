"""Puts other values on the user's data for a while, and puts the old ones back.

A render evaluates the animation of the frame and writes the result into the user's own objects.
What he has moved but not keyed yet would be lost: `values_restored` puts it back.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from bpy.types import Object

from .versions import curves


@contextmanager
def untold(blocks: Any, name: str, values: Mapping[Any, Any]) -> Iterator[None]:
    """Give a property of some of the user's data-blocks other values, for a while.

    Blender is not told: setting all of them at once tags nothing. If it were told, particles that
    are not baked would be reset for good; and a copy of an object has no simulation at all. So the
    change shows where a scene is evaluated for the first time: in a render, or in a new temporary
    scene.
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
    told = []  # what `foreach_set` passes over: a library's, and some overrides of such
    settable = np.ones(len(blocks), bool)
    for number, block in enumerate(blocks):
        settable[number] = not block.is_property_readonly(name)
        if block in values:
            before[block] = held[number].copy()
            held[number] = values[block]
            if not settable[number]:
                told.append(block)
    # It takes no value for what it passes over: the next block would get that.
    taken = np.concatenate((held[settable], held[~settable]))
    blocks.foreach_set(name, taken.reshape(-1))
    for block in told:
        rna = block.bl_rna.properties[name]
        value = values[block].tolist()
        if rna.type == "ENUM":
            value = next(i.identifier for i in rna.enum_items if i.value == value)
        setattr(block, name, value)
    return before


@contextmanager
def values_restored(paths: Iterable[tuple[Any, str]] | None = None) -> Iterator[None]:
    """Put values back to what they were: of data, by their paths, in order; else animated ones."""
    known = dict.fromkeys(_animated() if paths is None else paths)
    before = [(block, path, _value(block, path)) for block, path in known]
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


def is_animated(obj: Object, *paths: str) -> bool:
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

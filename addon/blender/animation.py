"""What the user has moved but not keyed, kept over a render.

A render evaluates the animation of the frame and writes the result into the user's own objects:
an animated value that was changed by hand, and not keyed yet, would be lost.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy


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
                    data = getattr(owner, "animation_data", None)
                    for action in _actions(data) if data else ():
                        yield from ((owner, curve.data_path) for curve in _curves(action))


def _actions(data: Any) -> Iterator[Any]:
    if data.action:
        yield data.action
    for track in data.nla_tracks:
        yield from (strip.action for strip in track.strips if strip.action)


def _curves(action: Any) -> Iterator[Any]:
    if not hasattr(action, "layers"):  # before 4.4
        yield from action.fcurves
        return
    for layer in action.layers:
        for strip in layer.strips:
            for bag in strip.channelbags:
                yield from bag.fcurves


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

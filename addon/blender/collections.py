"""Objects of a temporary scene replaced by others, or by nothing; the user's collections stay.

Collections that hold such an object are replaced by copies, in the temporary scene alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .temporary import collections_of


def replace_objects(tmp: Any, layer: str, objects: Mapping[Any, Any]) -> None:
    """Replace objects in a temporary scene; what was hidden in its view layer stays so.

    Parameters
    ----------
    tmp : bpy.types.Scene
    layer : str
        Name of its view layer.
    objects : mapping of bpy.types.Object
        To what comes in their place; None for nothing.
    """
    view_layer = tmp.view_layers[layer]
    hidden = [new for old, new in objects.items() if new and old.hide_get(view_layer=view_layer)]
    _replace(tmp.collection, view_layer.layer_collection, objects, collections_of(tmp))
    for obj in hidden:
        obj.hide_set(True, view_layer=view_layer)


def _replace(collection: Any, layer: Any, objects: Mapping[Any, Any], copies: list[Any]) -> None:
    for child in list(collection.children):
        if objects.keys().isdisjoint(child.all_objects):
            continue
        if child in copies:
            _replace(child, layer.children[child.name], objects, copies)
            continue
        copy = child.copy()
        copies.append(copy)
        old = layer.children[child.name]
        collection.children.link(copy)  # before the old one goes: hidden objects stay hidden
        new = layer.children[copy.name]
        _copy_flags(old, new)
        collection.children.unlink(child)
        _replace(copy, new, objects, copies)
    for obj in [o for o in collection.objects if o in objects]:
        if objects[obj] is not None:
            collection.objects.link(objects[obj])
        collection.objects.unlink(obj)


def _copy_flags(source: Any, target: Any) -> None:
    for name in ("exclude", "hide_viewport", "holdout", "indirect_only"):
        setattr(target, name, getattr(source, name))
    for a, b in zip(source.children, target.children, strict=True):
        _copy_flags(a, b)

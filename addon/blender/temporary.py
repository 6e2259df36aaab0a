"""A copy of the user's scene, on which everything that a picture needs is set.

Its objects are the user's own; its settings, view layers and top collection are its own, and go
with it. The user's scene, view and Render Result stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy

DRAWN = "reference_tracer_drawn"  # a custom property of what the add-on itself draws in a scene

_copies: dict[str, tuple[str, Any]] = {}  # name of a temporary scene: the user's, judge
_collections: dict[str, list[Any]] = {}  # name of a temporary scene: copies of collections in it


@contextmanager
def temporary_scene(scene: Any, layer: str | None = None, judge: Any = None) -> Iterator[Any]:
    """Give a copy of a scene that renders one view layer and nothing else; remove it in any case.

    Sequencer, compositor, multiview, stamps, freestyle and motion blur are off in it. The 'Render
    Result' that a render of it makes goes, too, if there was none before.

    Parameters
    ----------
    scene : bpy.types.Scene
    layer : str, optional
        Name of the view layer; the scene's first by default.
    judge : Judge, optional
        Whose picture it is for.
    """
    images = set(bpy.data.images)
    copy = scene.copy()
    _copies[copy.name_full] = scene.name_full, judge
    own = _collections[copy.name_full] = []
    try:
        _isolate(copy, layer or scene.view_layers[0].name)
        yield copy
    finally:
        del _copies[copy.name_full], _collections[copy.name_full]
        # Under `blender --command` there is no window, and scenes.remove() would crash (4.3).
        bpy.data.batch_remove([copy, *own])
        for image in set(bpy.data.images) - images:
            if image.type == "RENDER_RESULT":
                bpy.data.images.remove(image)


def user_scene(scene: Any) -> Any:
    """Return the scene of the user's that a temporary one is a copy of; another is the user's."""
    name, _ = _copies.get(scene.name_full, (scene.name_full, None))
    return next(s for s in bpy.data.scenes if s.name_full == name)


def collections_of(scene: Any) -> list[Any]:
    """Return the list of a temporary scene's own collections, which go with it; add to it."""
    return _collections[scene.name_full]


def is_temporary(scene: Any) -> bool:
    """Return whether a scene is such a copy."""
    return scene.name_full in _copies


def judge_of(scene: Any) -> Any:
    """Return whose picture a temporary scene is for; None for a scene of the user's."""
    return _copies.get(scene.name_full, (None, None))[1]


def _isolate(scene: Any, layer: str) -> None:
    render = scene.render
    render.use_sequencer = render.use_compositing = render.use_multiview = False
    render.use_stamp = render.use_freestyle = render.use_motion_blur = False
    # Rendering another layer than the first by its name crashes Blender (5.2).
    for other in [v for v in scene.view_layers if v.name != layer]:
        scene.view_layers.remove(other)
    scene.view_layers[layer].use = True
    _leave_out_drawings(scene.view_layers[layer].layer_collection)


def _leave_out_drawings(parent: Any) -> None:
    """Exclude what the add-on has drawn about the scene, wherever the user has put it."""
    for child in parent.children:
        if child.collection.get(DRAWN):
            child.exclude = True
        else:
            _leave_out_drawings(child)

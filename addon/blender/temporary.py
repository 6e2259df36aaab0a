"""Makes a temporary copy of the user's scene, on which everything that a picture needs is set.

The copy has settings, view layers and a top collection of its own, which go with it. Its objects
are the user's. To leave an object out, the collections that hold it are replaced by copies. The
user's scene, view and Render Result stay as they are. `values.py` changes an object itself, and
puts it back.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeVar

import bpy
from bpy.types import Depsgraph, LayerCollection, Scene

if TYPE_CHECKING:
    from ..pictures.palette import Palette

B = TypeVar("B", bound=Any)

# Custom properties. DRAWN marks what the add-on itself draws in a scene. The others mark a
# temporary scene: the name of the user's, and the features that its judge does not show. The first
# is also on what was made for a scene, with that scene's name.
DRAWN = "reference_tracer_drawn"
_COPY_OF = "reference_tracer_copy_of"
_IGNORED = "reference_tracer_ignored"
_WHOLE = "reference_tracer_whole"

HIDDEN_FACES = "hidden faces"  # a judge that ignores that Edit Mode hides them draws them

ENGINE = "REFERENCE_TRACER"  # Blender's name of our own, which draws nothing of a temporary scene

NOT_DRAWN = ("ARMATURE", "CAMERA", "LATTICE", "LIGHT", "LIGHT_PROBE", "SPEAKER")


@contextmanager
def temporary_scene(
    scene: Scene,
    layer: str | None = None,
    ignored: Collection[str] | None = None,
    palette: Palette | None = None,
) -> Iterator[Any]:
    """Give a copy of a scene that renders one view layer and nothing else; remove it in any case.

    Sequencer, compositor, multiview, stamps, freestyle and motion blur are off in the copy.

    Parameters
    ----------
    scene : bpy.types.Scene
    layer : str, optional
        The view layer; by default the scene's first.
    ignored : collection of str, optional
        The features that the judge does not show; None if the copy is for no judge.
    palette : Palette, optional
        The colours that it is exported and drawn in; by default those of the viewport.
    """
    copy = scene.copy()
    copy[_COPY_OF] = scene.name_full
    if ignored is not None:
        copy[_IGNORED] = "\n".join(ignored)
    try:
        _isolate(copy, layer or scene.view_layers[0].name)
        with in_palette(copy, palette):
            yield copy
    finally:
        remove(copy)


def made_for(scene: Scene, block: B) -> B:
    """Return a data-block that goes when the add-on removes its scene, and not before.

    While Blender renders, removing one may crash it (5.2).
    """
    block[_COPY_OF] = scene.name_full
    return block


def remove(scene: Scene) -> None:
    """Remove a scene of the add-on's, with what was made for it."""
    data = bpy.data
    kinds: tuple[Any, ...] = data.collections, data.objects, data.meshes, data.materials
    kinds += data.cameras, data.images
    own = [b for kind in kinds for b in kind if b.get(_COPY_OF) == scene.name_full]
    # Under `blender --command` there is no window, and scenes.remove() would crash (4.3).
    data.batch_remove([scene, *own])


def show_in(tmp: Scene, depsgraph: Depsgraph, colors: Mapping[str, Any]) -> None:
    """Show objects in colours, by their names, in one evaluation of a temporary scene.

    The user's objects stay as they are, and none is evaluated again.
    """
    for scene in (tmp, depsgraph.scene_eval):
        scene.display.shading.color_type = "OBJECT"
    block: Any
    for block in depsgraph.ids:
        color = colors.get(block.original.name_full) if block.id_type == "OBJECT" else None
        if color is not None:
            block.color = (*color, 1.0)


@contextmanager
def in_palette(scene: Any, palette: Palette | None) -> Iterator[None]:
    """Show a temporary scene, which is not evaluated yet, in other colours, for a while."""
    import numpy as np

    from ..pictures.palette import By
    from .values import untold

    if palette is None or palette.by == By.VIEWPORT:
        yield
        return
    of_objects = palette.by == By.OBJECT
    blocks: Any = bpy.data.objects if of_objects else bpy.data.materials
    scene.display.shading.color_type = palette.by.upper()
    known = ((block, palette.colors.get(block.name_full)) for block in blocks)
    rows = {b: np.array((*color, 1), np.float32) for b, color in known if color is not None}
    with untold(blocks, "color" if of_objects else "diffuse_color", rows):
        yield


def is_temporary(scene: Any) -> bool:
    """Return whether a scene is a temporary copy."""
    return _COPY_OF in scene


def user_scene(scene: Scene) -> Any:
    """Return the user's scene that a temporary one is a copy of; a scene of the user's is itself.

    An evaluated scene gives the original one.
    """
    name = scene.get(_COPY_OF, scene.name_full)
    return next(s for s in bpy.data.scenes if s.name_full == name)


def ignored_features(scene: Scene) -> tuple[str, ...] | None:
    """Return the features that a temporary scene's judge does not show; None without a judge."""
    ignored = scene.get(_IGNORED)
    return None if ignored is None else tuple(ignored.split("\n"))


def _isolate(scene: Scene, layer: str) -> None:
    render = scene.render
    render.use_compositing = False
    render.use_multiview = False
    render.use_stamp = False
    render.use_freestyle = False
    render.use_motion_blur = False
    # With `use_sequencer` off, handlers that add or remove data crash Blender (5.2).
    scene.sequence_editor_clear()
    _spare_bodies(scene, scene.frame_current)
    # Rendering another layer than the first by its name crashes Blender (5.2).
    for other in [v for v in scene.view_layers if v.name != layer]:
        scene.view_layers.remove(other)
    [only] = scene.view_layers
    only.use = True
    leave_out(scene, [o for o in scene.objects if o.get(DRAWN)])


@contextmanager
def everything(scene: Scene) -> Iterator[None]:
    """Have all of a temporary scene exported, for a while: also what its camera cannot see."""
    scene[_WHOLE] = True
    yield
    del scene[_WHOLE]


def is_whole(scene: Any) -> bool:
    """Return whether all of a scene is exported."""
    return _WHOLE in scene


def go_to(scene: Scene, frame: float) -> None:
    """Step a temporary scene to a frame, or between two, at which it is evaluated next."""
    whole = int(frame // 1)
    _spare_bodies(scene, whole)
    scene.frame_current = whole
    scene.frame_subframe = frame - whole


def _spare_bodies(scene: Scene, frame: int) -> None:
    # Blender would simulate the user's own rigid bodies in this scene, free them with it, and
    # crash. Measured: it also does so with baked ones in the second frame of their cache.
    if bodies := scene.rigidbody_world:
        cache = bodies.point_cache
        if not cache.is_baked or frame == cache.frame_start + 1:
            bodies.enabled = False  # set only then: Blender takes any setting for a change


def leave_out(tmp: Any, objects: Collection[Any]) -> None:
    """Take objects out of a temporary scene."""
    _leave_out(tmp.collection, tmp.view_layers[0].layer_collection, objects, tmp.name_full)


def _leave_out(
    collection: Any, layer: LayerCollection, objects: Collection[Any], copy_of: str
) -> None:
    for child in list(collection.children):
        if not any(obj in objects for obj in child.all_objects):
            continue
        own = child
        if child.get(_COPY_OF) != copy_of:
            own = child.copy()
            if own.override_library:  # no object can be taken out of one
                own.make_local()
            own[_COPY_OF] = copy_of
            collection.children.link(own)  # before the old one goes: hidden objects stay hidden
            _copy_flags(_child(layer, child), _child(layer, own))
            collection.children.unlink(child)
        _leave_out(own, _child(layer, own), objects, copy_of)
    for obj in [o for o in collection.objects if o in objects]:
        collection.objects.unlink(obj)


def _child(layer: LayerCollection, collection: bpy.types.Collection) -> LayerCollection:
    """Return a collection's place in a layer: by its name alone it may be a library's instead."""
    return next(c for c in layer.children if c.collection == collection)


def _copy_flags(source: Any, target: Any) -> None:
    for name in ("exclude", "hide_viewport", "holdout", "indirect_only"):
        setattr(target, name, getattr(source, name))
    for old, new in zip(source.children, target.children, strict=True):
        _copy_flags(old, new)


def drawn(tmp: Scene) -> list[Any]:
    """Return a temporary scene's objects that may be drawn, or that instance what is drawn."""
    return [o for o in tmp.view_layers[0].objects if o.type not in NOT_DRAWN]

"""Names what a Blender scene contains that the tracer does not model, by object.

Each is a `manifest.Unmodelled`, with what it does to the judge's picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from bpy.types import Object, ParticleSettings, Scene, View3DShading, ViewLayer
from mathutils import Matrix

from ...arrays import Floats
from ...manifest import Effect, Unmodelled
from ...tracer.vector import transform_points
from ..temporary import ignored_features, is_temporary
from ..versions import COMPOSITOR, STRIPS, radii
from .colors import slot_materials

_UNFILLED = ("WIRE", "BOUNDS")

TRANSPARENCY = "transparency"
HAIR = "hair"  # particles: the object that has it is also drawn without it

# Object types that Blender draws, but not as triangles.
_DRAWN_OTHERWISE = {
    "CURVES": "hair curves",
    "GPENCIL": "grease pencil",
    "GREASEPENCIL": "grease pencil",
    "POINTCLOUD": "point cloud",
    "VOLUME": "volume",
}


def is_hair(settings: ParticleSettings) -> bool:
    """Return whether particle settings draw hair."""
    return settings.type == "HAIR" and settings.render_type == "PATH"


def world_bounds(obj: Object, matrix: Matrix) -> Floats:
    """Return the box (2, 3) in world space, metres, around an evaluated object's own box."""
    corners = transform_points(np.array(matrix), np.array(obj.bound_box).T)
    reach = max(_reaches(obj), default=0.0)
    return np.stack((corners.min(axis=1) - reach, corners.max(axis=1) + reach))


def _reaches(obj: Object) -> Iterator[float]:
    """Yield how far beyond its own box an object is drawn, in metres."""
    for system in obj.particle_systems:
        if system.settings.type == "HAIR":
            yield system.settings.hair_length
    if obj.type in ("GREASEPENCIL", "GPENCIL"):
        for layer in obj.data.layers:
            for frame in layer.frames:
                yield from radii(obj, frame)


def unfilled(obj: Object, holder: Object) -> bool:
    """Return whether a viewport draws no surface of an object, or of an instance by its holder."""
    return obj.display_type in _UNFILLED or holder.display_type in _UNFILLED


@dataclass(frozen=True)
class Viewing:
    """The settings under which a depsgraph's objects are drawn."""

    shading: View3DShading
    layer: ViewLayer
    viewport: bool  # as the viewport draws them, else as a render does
    ignored: tuple[str, ...]  # features that the judge does not show


_Feature = tuple[str, Effect, str]  # its name, its effect, and what there is to say of it


def of_object(
    obj: Object, holder: Object, matrix: Matrix, viewing: Viewing
) -> Iterator[Unmodelled]:
    """Yield what is not modelled of an evaluated object as it appears with a world_from_object.

    Its holder is what instances it, else itself. What the judge does not show has no effect, and no
    bounds.
    """
    name = obj.original.name_full
    bounds = None
    for feature, effect, detail in _features(obj, holder, viewing):
        if feature in viewing.ignored:
            yield Unmodelled(name, feature, detail, None, Effect.NONE)
            continue
        bounds = world_bounds(obj, matrix) if bounds is None else bounds
        yield Unmodelled(name, feature, detail, bounds, effect)


def _features(obj: Object, holder: Object, viewing: Viewing) -> Iterator[_Feature]:
    if obj.type in _DRAWN_OTHERWISE:
        detail = "Blender draws it, but not as triangles"
        yield _DRAWN_OTHERWISE[obj.type], Effect.DRAWN, detail
    if obj.type != "MESH":
        return
    yield from _of_colors(obj, holder, viewing.shading.color_type)
    if obj.show_in_front:
        yield "in-front drawing", Effect.IN_FRONT, ""
    original = obj.original
    if obj.is_holdout or original.holdout_get(view_layer=viewing.layer):
        yield "holdout", Effect.HOLDOUT, ""
    if original.indirect_only_get(view_layer=viewing.layer):
        yield "indirect only", Effect.UNSEEN, "its collection is seen by indirect rays alone"
    if not original.visible_camera:
        yield "not visible to the camera", Effect.UNSEEN, ""
    if viewing.viewport and unfilled(obj, holder):
        detail = "wire or bounds: the viewport draws no surface"
        yield "display type", Effect.UNPLACED, detail
    for system in obj.particle_systems:
        if is_hair(system.settings):
            yield HAIR, Effect.DRAWN, f"particle system '{system.name}'"


def _of_colors(obj: Object, holder: Object, color_type: str) -> Iterator[_Feature]:
    """Yield what is not modelled of an object's colours, by `View3DShading.color_type`."""
    if color_type in ("OBJECT", "VERTEX") and holder.color[3] < 1:
        detail = f"the object's colour has alpha {holder.color[3]:.3g}"
        yield TRANSPARENCY, Effect.COLOR, detail
    if color_type in ("MATERIAL", "TEXTURE"):
        for material in {m.name: m for m in slot_materials(obj) if m}.values():
            name = f"material '{material.name}'"
            alpha = material.diffuse_color[3]
            if alpha < 1:
                detail = f"{name} has a viewport alpha of {alpha:.3g}"
                yield TRANSPARENCY, Effect.COLOR, detail
            nodes = material.node_tree.nodes if material.node_tree else ()
            if color_type == "TEXTURE" and any(node.type == "TEX_IMAGE" for node in nodes):
                yield "texture", Effect.COLOR, name
    attributes = obj.data.color_attributes
    if color_type == "VERTEX" and len(attributes) and attributes.active_color is None:
        yield "colour attribute", Effect.COLOR, "it has some, but none is the active one"


def of_scene(scene: Scene, drawn: Scene) -> Iterator[Unmodelled]:
    """Yield what is not modelled of the user's scene and its camera as a whole, without bounds.

    What is `drawn` is that scene or a temporary copy. In a copy for a judge, all of this is off.
    """
    effect = Effect.UNPLACED if ignored_features(drawn) is None else Effect.NONE
    camera = drawn.camera
    render = scene.render
    shading = scene.display.shading
    strips = getattr(scene.sequence_editor, STRIPS, ())
    aside = "not part of what is traced"
    colors = "surfaces show their material's viewport colour"
    sides = "both sides of a surface are traced"
    name = f"scene '{scene.name}'"
    for of, feature, detail, has in (
        (camera.name, "depth of field", "", camera.data.dof.use_dof),
        (name, "motion blur", "", render.use_motion_blur),
        (name, "multiview", aside, render.use_multiview),
        (name, "sequencer", aside, render.use_sequencer and strips),
        (name, "compositor", aside, render.use_compositing and getattr(scene, COMPOSITOR)),
        (name, "freestyle lines", "", render.use_freestyle),
        (name, "texture colours", colors, shading.color_type == "TEXTURE"),
        (name, "x-ray shading", "", shading.show_xray),
        (name, "backface culling", sides, shading.show_backface_culling),
        (name, "mist", "", scene.world and scene.world.mist_settings.use_mist),
    ):
        if has:
            yield Unmodelled(of, feature, detail, None, effect)
    bodies = scene.rigidbody_world
    if is_temporary(drawn) and bodies and bodies.enabled and not drawn.rigidbody_world.enabled:
        cache = bodies.point_cache
        detail = "what is compared has them as they begin"
        if scene.frame_current > cache.frame_start:
            detail += ", at the second frame alone" if cache.is_baked else ": bake them"
            yield Unmodelled(name, "rigid bodies", detail, None, Effect.UNPLACED)


def by_handlers(scene: Scene) -> Unmodelled:
    """Return that handlers changed which objects the scene has while Blender drew it."""
    detail = "a script's handlers added or removed objects while Blender drew"
    return Unmodelled(f"scene '{scene.name}'", "handlers", detail, None, Effect.PICTURE)

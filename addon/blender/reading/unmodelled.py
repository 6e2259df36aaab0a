"""What a Blender scene contains that the tracer does not model, by object and name.

In come an evaluated scene and its objects; out go `manifest.Unmodelled` entries, with what each
does to the picture of the judge.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...manifest import Effect, Unmodelled
from ..drawing.judges import Judge
from ..drawing.temporary import is_temporary, judge_of
from ..versions import COMPOSITOR, STRIPS, radii
from .colors import slot_materials

_UNFILLED = ("WIRE", "BOUNDS")

HAIR = "hair"  # of particles: the object that has it is drawn without it, too

# Object types that Blender draws, but not as triangles.
_DRAWN_OTHERWISE = {
    "CURVES": "hair curves",
    "GPENCIL": "grease pencil",
    "GREASEPENCIL": "grease pencil",
    "POINTCLOUD": "point cloud",
    "VOLUME": "volume",
}


def is_hair(settings: Any) -> bool:
    """Return whether particle settings draw hair."""
    return settings.type == "HAIR" and settings.render_type == "PATH"


def world_bounds(obj: Any, matrix: Any) -> NDArray[np.float64]:
    """Return the box (2, 3) in world space, metres, around an evaluated object's own box."""
    corners = np.array([(*c, 1.0) for c in obj.bound_box]) @ np.array(matrix, float).T
    reach = max(_reaches(obj), default=0.0)
    return np.stack((corners[:, :3].min(axis=0) - reach, corners[:, :3].max(axis=0) + reach))


def _reaches(obj: Any) -> Iterator[float]:
    """Yield how far beyond its own box an object is drawn, in metres."""
    for system in getattr(obj, "particle_systems", ()):
        if system.settings.type == "HAIR":
            yield system.settings.hair_length
    if obj.type in ("GREASEPENCIL", "GPENCIL"):
        for frame in (frame for layer in obj.data.layers for frame in layer.frames):
            yield from radii(obj, frame)


def unfilled(obj: Any, holder: Any) -> bool:
    """Return whether a viewport draws no surface of an object, or of an instance by its holder."""
    return obj.display_type in _UNFILLED or holder.display_type in _UNFILLED


def of_object(
    obj: Any,
    holder: Any,
    matrix: Any,
    shading: Any,
    layer: Any,
    viewport: bool,
    judge: Judge | None,
) -> Iterator[Unmodelled]:
    """Yield what is not modelled of an evaluated object as it appears with a world_from_object.

    Its holder is what instances it, else itself. What the judge does not draw has no effect, and no
    bounds.
    """
    bounds = None

    def found(feature: str, effect: Effect, detail: str = "") -> Unmodelled:
        nonlocal bounds
        if judge and feature in judge.ignores:
            return Unmodelled(obj.original.name_full, feature, detail, None, Effect.NONE)
        bounds = world_bounds(obj, matrix) if bounds is None else bounds
        return Unmodelled(obj.original.name_full, feature, detail, bounds, effect)

    if obj.type in _DRAWN_OTHERWISE:
        detail = "Blender draws it, but not as triangles"
        yield found(_DRAWN_OTHERWISE[obj.type], Effect.DRAWN, detail)
    if obj.type != "MESH":
        return
    color_type = shading.color_type
    if color_type in ("OBJECT", "VERTEX") and holder.color[3] < 1:
        detail = f"the object's colour has alpha {holder.color[3]:.3g}"
        yield found("transparency", Effect.COLOR, detail)
    if color_type in ("MATERIAL", "TEXTURE"):
        for material in {m.name: m for m in slot_materials(obj) if m}.values():
            name, alpha = f"material '{material.name}'", material.diffuse_color[3]
            if alpha < 1:
                detail = f"{name} has a viewport alpha of {alpha:.3g}"
                yield found("transparency", Effect.COLOR, detail)
            nodes = material.node_tree.nodes if material.node_tree else ()
            if color_type == "TEXTURE" and any(node.type == "TEX_IMAGE" for node in nodes):
                yield found("texture", Effect.COLOR, name)
    attributes = obj.data.color_attributes
    if color_type == "VERTEX" and len(attributes) and attributes.active_color is None:
        detail = "it has some, but none is the active one"
        yield found("colour attribute", Effect.COLOR, detail)
    if obj.show_in_front:
        yield found("in-front drawing", Effect.IN_FRONT)
    original = obj.original
    if obj.is_holdout or original.holdout_get(view_layer=layer):
        yield found("holdout", Effect.HOLDOUT)
    if original.indirect_only_get(view_layer=layer):
        detail = "its collection is seen by indirect rays alone"
        yield found("indirect only", Effect.UNSEEN, detail)
    if not original.visible_camera:
        yield found("not visible to the camera", Effect.UNSEEN)
    if viewport and unfilled(obj, holder):
        detail = "wire or bounds: the viewport draws no surface"
        yield found("display type", Effect.UNPLACED, detail)
    for system in obj.particle_systems:
        if is_hair(system.settings):
            yield found(HAIR, Effect.DRAWN, f"particle system '{system.name}'")


def of_scene(scene: Any, drawn: Any) -> Iterator[Unmodelled]:
    """Yield what is not modelled of the user's scene and its camera as a whole; it has no bounds.

    What is `drawn` is that, or a temporary copy: for a judge, all of it is switched off there.
    """
    effect = Effect.NONE if judge_of(drawn) else Effect.UNPLACED
    camera, render, shading = drawn.camera, scene.render, scene.display.shading
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
        cache, detail = bodies.point_cache, "what is compared has them as they begin"
        if scene.frame_current > cache.frame_start:
            detail += ", at the second frame alone" if cache.is_baked else ": bake them"
            yield Unmodelled(name, "rigid bodies", detail, None, Effect.UNPLACED)


def by_handlers(scene: Any) -> Unmodelled:
    """Return what it is when the scene's objects are others once Blender has drawn them."""
    detail = "a script's handlers added or removed objects while Blender drew"
    return Unmodelled(f"scene '{scene.name}'", "handlers", detail, None, Effect.PICTURE)


def of_shading(scene: Any, judge: Judge, anti_aliasing: str) -> Iterator[Unmodelled]:
    """Yield what a picture *as it is* shows that constant shading does not have, anywhere in it.

    Anti-aliasing alone can be checked: it mixes colours that the tracer sees.
    """
    shading, name = scene.display.shading, f"scene '{scene.name}'"
    if not judge.solid:
        yield Unmodelled(name, "materials and light", f"of {judge.label}", None, Effect.LIGHT)
        return
    detail, aa = "Blender's picture is made with it", Effect.NONE
    studio = shading.light == "STUDIO"
    for feature, shown, effect in (
        (f"{shading.light.lower()} light", shading.light != "FLAT", Effect.LIGHT),
        ("specular highlights", studio and shading.show_specular_highlight, Effect.LIGHT),
        ("shadows", shading.show_shadows, Effect.LIGHT),
        ("cavity", shading.show_cavity, Effect.LIGHT),
        ("object outline", shading.show_object_outline, Effect.LIGHT),
        ("x-ray", shading.show_xray, Effect.PICTURE),
        ("backface culling", shading.show_backface_culling, Effect.PICTURE),
        ("depth of field", shading.use_dof and scene.camera.data.dof.use_dof, Effect.PICTURE),
    ):
        if shown:
            aa = Effect.LIGHT
            yield Unmodelled(name, feature, detail, None, effect)
    if anti_aliasing != "OFF":
        yield Unmodelled(name, "anti-aliasing", detail, None, aa)

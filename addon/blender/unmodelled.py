"""What a Blender scene contains that the tracer does not model, by object and name.

In come an evaluated scene and its objects; out go `manifest.Unmodelled` entries. Those with bounds
can change the picture that Blender draws, and explain a pixel inside them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..manifest import Unmodelled
from .colors import slot_materials
from .judges import Judge

# Object types that Blender draws, but not as triangles.
_DRAWN_OTHERWISE = {
    "CURVES": "hair curves",
    "GPENCIL": "grease pencil",
    "GREASEPENCIL": "grease pencil",
    "POINTCLOUD": "point cloud",
    "VOLUME": "volume",
}


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
        for layer in obj.data.layers:
            for frame in layer.frames:
                if obj.type == "GPENCIL":  # up to 4.2: a width in thousandths
                    yield from (s.line_width * obj.data.pixel_factor / 1000 for s in frame.strokes)
                elif "radius" in frame.drawing.attributes:
                    yield from (v.value for v in frame.drawing.attributes["radius"].data)


def of_object(
    obj: Any, matrix: Any, shading: Any, layer: Any, mode: str, judge: Judge | None
) -> Iterator[Unmodelled]:
    """Yield what is not modelled of an evaluated object as it appears with a world_from_object.

    The mode is 'VIEWPORT' or 'RENDER'. Only what the judge draws has bounds; with None, all has.
    """
    bounds = None

    def found(feature: str, detail: str = "") -> Unmodelled:
        nonlocal bounds
        if judge and feature in judge.ignores:
            return Unmodelled(obj.original.name_full, feature, detail)
        bounds = world_bounds(obj, matrix) if bounds is None else bounds
        return Unmodelled(obj.original.name_full, feature, detail, bounds)

    if obj.type in _DRAWN_OTHERWISE:
        yield found(_DRAWN_OTHERWISE[obj.type], "Blender draws it, but not as triangles")
    if obj.type != "MESH":
        return
    color_type = shading.color_type
    if color_type in ("OBJECT", "VERTEX") and obj.color[3] < 1:
        yield found("transparency", f"the object's colour has alpha {obj.color[3]:.3g}")
    if color_type in ("MATERIAL", "TEXTURE"):
        for material in {m.name: m for m in slot_materials(obj) if m}.values():
            name, alpha = f"material '{material.name}'", material.diffuse_color[3]
            if alpha < 1:
                yield found("transparency", f"{name} has a viewport alpha of {alpha:.3g}")
            nodes = material.node_tree.nodes if material.node_tree else ()
            if color_type == "TEXTURE" and any(node.type == "TEX_IMAGE" for node in nodes):
                yield found("texture", name)
    attributes = obj.data.color_attributes
    if color_type == "VERTEX" and len(attributes) and attributes.active_color is None:
        yield found("colour attribute", "it has some, but none is the active one")
    if obj.show_in_front:
        yield found("in-front drawing")
    original = obj.original
    if obj.is_holdout or original.holdout_get(view_layer=layer):
        yield found("holdout")
    if original.indirect_only_get(view_layer=layer):
        yield found("indirect only", "its collection is seen by indirect rays alone")
    if not original.visible_camera:
        yield found("not visible to the camera")
    if mode == "VIEWPORT" and obj.display_type in ("WIRE", "BOUNDS"):
        yield found("display type", f"{obj.display_type.lower()}: the viewport draws no surface")
    for system in obj.particle_systems:
        if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
            yield found("hair", f"particle system '{system.name}'")


def of_scene(scene: Any) -> Iterator[Unmodelled]:
    """Yield what is not modelled of the scene and its camera as a whole; it has no bounds."""
    camera, render, shading = scene.camera, scene.render, scene.display.shading
    sequence = scene.sequence_editor
    strips = sequence and getattr(sequence, "strips_all", getattr(sequence, "sequences_all", ()))
    new = hasattr(scene, "compositing_node_group")  # from 5.0 on
    composited = scene.compositing_node_group if new else scene.use_nodes
    aside = "not part of what is traced"
    colors = "surfaces show their material's viewport colour"
    sides = "both sides of a surface are traced"
    name = f"scene '{scene.name}'"
    for of, feature, detail, has in (
        (camera.name, "depth of field", "", camera.data.dof.use_dof),
        (name, "motion blur", "", render.use_motion_blur),
        (name, "multiview", aside, render.use_multiview),
        (name, "sequencer", aside, render.use_sequencer and strips),
        (name, "compositor", aside, render.use_compositing and composited),
        (name, "freestyle lines", "", render.use_freestyle),
        (name, "texture colours", colors, shading.color_type == "TEXTURE"),
        (name, "x-ray shading", "", shading.show_xray),
        (name, "backface culling", sides, shading.show_backface_culling),
        (name, "mist", "", scene.world and scene.world.mist_settings.use_mist),
    ):
        if has:
            yield Unmodelled(of, feature, detail)


def of_shading(scene: Any, judge: Judge, anti_aliasing: str) -> Iterator[Unmodelled]:
    """Yield what a picture *as it is* shows that constant shading does not have, anywhere in it.

    Anti-aliasing alone can be checked: it mixes colours that the tracer sees.
    """
    shading, name = scene.display.shading, f"scene '{scene.name}'"
    if not judge.solid:
        yield Unmodelled(name, "materials and light", f"of {judge.label}", None, True, True)
        return
    detail, found = "Blender's picture is made with it", False
    studio = shading.light == "STUDIO"
    for feature, shown, recolours in (
        (f"{shading.light.lower()} light", shading.light != "FLAT", True),
        ("specular highlights", studio and shading.show_specular_highlight, True),
        ("shadows", shading.show_shadows, True),
        ("cavity", shading.show_cavity, True),
        ("object outline", shading.show_object_outline, True),
        ("x-ray", shading.show_xray, False),
        ("backface culling", shading.show_backface_culling, False),
        ("depth of field", shading.use_dof and scene.camera.data.dof.use_dof, False),
    ):
        if shown:
            found = True
            yield Unmodelled(name, feature, detail, None, True, recolours)
    if anti_aliasing != "OFF":
        yield Unmodelled(name, "anti-aliasing", detail, None, found, found)

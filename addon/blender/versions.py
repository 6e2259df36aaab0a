"""Knows where Blenders from 4.2 to 5.2 differ: no other module asks for the version."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.types import RenderSettings

_FROM_5 = bpy.app.version >= (5, 0, 0)
# What 'VERTEX' shows of a mesh without a colour attribute: checked in 4.2, 4.3, 4.5, 5.0 and 5.2.
WITHOUT_ATTRIBUTE = "MATERIAL" if _FROM_5 else "OBJECT"
# Whether the shading's own background colour is drawn where it is set: not in 4.2, 4.3, 4.5, 5.0.
OWN_BACKGROUND = bpy.app.version >= (5, 2, 0)
# Levels of 255 that a dither of 1 adds at most: 255 * 0.005 in the source of 4.2, 0.0033 in newer.
DITHER = 1.0 if bpy.app.version >= (4, 5, 0) else 1.275
# Of paths: // is beside the .blend, which later versions must be told.
RELATIVE = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set()
COMPOSITOR = "compositing_node_group" if _FROM_5 else "use_nodes"  # whether a scene has one
STRIPS = "strips_all" if _FROM_5 else "sequences_all"  # of a sequencer
LAYERS = "OPEN_EXR_MULTILAYER"  # the format of a file of all layers of a render
# Names of engines, where this Blender has another than 5.0 and later.
ENGINES = {} if _FROM_5 else {"BLENDER_EEVEE": "BLENDER_EEVEE_NEXT"}
# Names in a 3D view's filters of types; the old grease pencil is there up to 4.2.
FILTERS = {"SURFACE": "surf", "GREASEPENCIL": "grease_pencil", "GPENCIL": "grease_pencil"}


def lens(data: Any) -> Any:
    """Return what has the settings of a camera's type: of panoramas Cycles' own part up to 4.5."""
    if data.type != "PANO" or hasattr(data, "panorama_type"):
        return data
    return getattr(data, "cycles", data)


def curves(action: Any) -> list[Any]:
    """Return an action's F-curves: in layers from 4.4 on."""
    if not hasattr(action, "layers"):
        return list(action.fcurves)
    strips = (strip for layer in action.layers for strip in layer.strips)
    return [curve for strip in strips for bag in strip.channelbags for curve in bag.fcurves]


def bake_folder(modifier: Any, bake: Any) -> str:
    """Return where a bake of geometry nodes has its files; empty if it is in the .blend itself.

    It can be there from 4.3 on.
    """
    target = getattr(bake, "bake_target", "DISK")
    target = modifier.bake_target if target == "INHERIT" else target
    folder = bake.directory if bake.use_custom_path else modifier.bake_directory
    return "" if target == "PACKED" else folder


def radii(obj: Any, frame: Any) -> list[float]:
    """Return the radii of what a grease pencil's frame draws, in metres."""
    if obj.type == "GPENCIL":
        # Up to 4.2 widths are in thousandths.
        return [s.line_width * obj.data.pixel_factor / 1000 for s in frame.strokes]
    radius = frame.drawing.attributes.get("radius")
    return [point.value for point in radius.data] if radius else []


def set_format(render: RenderSettings, kind: str, mode: str, depth: str) -> None:
    """Set what files a `bpy.types.RenderSettings` writes."""
    settings: Any = render.image_settings
    if _FROM_5:
        settings.media_type = "MULTI_LAYER_IMAGE" if kind == LAYERS else "IMAGE"
    settings.file_format = kind
    settings.color_mode = mode
    settings.color_depth = depth

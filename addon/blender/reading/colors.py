"""Finds the constant colours that Blender's solid viewport shows, linear RGBA."""

from __future__ import annotations

from colorsys import hsv_to_rgb
from typing import Any

import numpy as np
from bpy.types import Object

from ...arrays import Colors
from ...scene import GREY
from ..versions import OWN_BACKGROUND, WITHOUT_ATTRIBUTE

# Of Blender's random colours.
_SATURATION = 0.5
_VALUE = 0.8


def instance_colors(obj: Object, holder: Object, shading: Any, materials: list[Any]) -> Colors:
    """Return the colour of each material slot, at least one: (k, 4) float32 linear RGBA.

    Parameters
    ----------
    obj : bpy.types.Object
        The evaluated object.
    holder : bpy.types.Object
        What instances it, else itself: its colour is shown.
    shading : bpy.types.View3DShading
        Its colour type 'TEXTURE' is not modelled, and shows the material's colour. 'VERTEX' here
        means a mesh without a colour attribute.
    materials : list of bpy.types.Material
        By slot, None where it is empty.
    """
    color_type = WITHOUT_ATTRIBUTE if shading.color_type == "VERTEX" else shading.color_type
    if color_type == "SINGLE":
        return np.array([(*shading.single_color, 1.0)], np.float32)
    if color_type == "RANDOM":
        return np.array([random_color(obj.original)], np.float32)
    if color_type == "OBJECT":
        return np.array([holder.color], np.float32)
    return np.array([m.diffuse_color if m else GREY for m in materials] or [GREY], np.float32)


def slot_materials(obj: Object) -> list[Any]:
    """Return the material of each slot, None where empty; a slot may be linked to the object."""
    slots = obj.material_slots
    return [
        slots[i].material if i < len(slots) and slots[i].link == "OBJECT" else material
        for i, material in enumerate(obj.data.materials)
    ]


def background(scene: Any) -> Colors:
    """Return what a pixel that sees nothing shows in a render of this scene, (4,) linear RGBA.

    This is Workbench's rule. With a transparent film or without a world, nothing is shown. Else it
    is the shading's own colour, if that is set and this Blender draws it; else the world's.
    """
    if scene.render.film_transparent:
        return np.zeros(4, np.float32)
    shading = scene.display.shading
    if shading.background_type == "VIEWPORT" and OWN_BACKGROUND:
        return np.array((*shading.background_color, 1.0), np.float32)
    if scene.world is None:
        return np.zeros(4, np.float32)
    return np.array((*scene.world.color, 1.0), np.float32)


def random_color(obj: Object) -> tuple[float, float, float, float]:
    """Return the colour that Blender draws an object with under 'RANDOM'.

    A hue from a hash of the object's name (MurmurHash2 over Blender's "OB" + name with its ending
    zero, then Bob Jenkins' final mix), checked against Blender's pictures.
    """
    mixed = _murmur2(b"OB" + obj.name.encode() + b"\0")
    if obj.library:
        mixed = (mixed * 13 & 0xFFFFFFFF) ^ _murmur2(obj.library.filepath.encode() + b"\0")
    hue = _jenkins(mixed) / 0xFFFFFFFF
    return *hsv_to_rgb(hue, _SATURATION, _VALUE), 1.0


def _murmur2(data: bytes) -> int:
    """MurmurHash2 by Austin Appleby, 32 bits, seed 0."""
    m = 0x5BD1E995
    mask = 0xFFFFFFFF
    h = len(data)
    tail = len(data) % 4
    for i in range(0, len(data) - tail, 4):
        k = int.from_bytes(data[i : i + 4], "little") * m & mask
        h = (h * m & mask) ^ ((k ^ k >> 24) * m & mask)
    if tail:
        h = (h ^ int.from_bytes(data[-tail:], "little")) * m & mask
    h = (h ^ h >> 13) * m & mask
    return h ^ h >> 15


def _jenkins(key: int) -> int:
    """Bob Jenkins' lookup3 final mix of one 32-bit key."""
    mask = 0xFFFFFFFF
    start = 0xDEADBEEF + (2 << 2) + 13 & mask
    words = [start + key & mask, start, start]  # a, b, c
    for n, bits in enumerate((14, 11, 25, 16, 4, 14, 24)):
        target = (n + 2) % 3
        value = words[(n + 1) % 3]
        rotated = (value << bits | value >> 32 - bits) & mask
        words[target] = (words[target] ^ value) - rotated & mask
    return words[2]

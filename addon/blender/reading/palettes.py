"""Chooses the colours that Blender draws a comparison in, and finds those of materials.

Blender is given them on temporary scenes: see `temporary.py`.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from bpy.types import Material

from ...arrays import Colors
from ...manifest import Manifest
from ...pictures.colors_file import recolored
from ...pictures.palette import (
    VIEWPORT,
    By,
    GivenColors,
    Palette,
    automatic_note,
    clear_palette,
    not_told_apart,
)
from ...scene import GREY, Scene, SceneError
from ...wording import listed
from ..temporary import NOT_DRAWN
from .colors import slot_materials

_NAMED = 3  # materials that are named in a line


def palette_by(scene: bpy.types.Scene, by: By | GivenColors) -> Palette:
    """Return the colours of a scene of the user's; for AUTOMATIC those that are tried first.

    Colours from a file are as :func:`palette_given` has them.

    Raises
    ------
    SceneError
        If there are more objects than colours.
    """
    if isinstance(by, GivenColors):
        return palette_given(by)
    if by == By.OBJECT:
        return clear_palette(_object_names(scene))
    return _of_materials(scene) if by == By.MATERIAL else VIEWPORT


def palette_given(given: GivenColors) -> Palette:
    """Return the colours of a file as Blender can draw them: one an object, or one a material.

    Raises
    ------
    SceneError
        If it cannot, or the file names an object that is not there.
    """
    there = {o.name_full: o for o in bpy.data.objects}
    given.check_known(there)
    of_owners: dict[str, list[Colors]] = {}
    for (_, owner), colors in given.slots.items():
        of_owners.setdefault(owner, []).extend(colors)
    if all((np.array(colors) == colors[0]).all() for colors in of_owners.values()):
        return Palette(By.OBJECT, {o: colors[0] for o, colors in of_owners.items()}, given=given)
    found: dict[str, Colors] = {}
    for (name, _), colors in given.slots.items():
        materials = slot_materials(there[name]) if there[name].data else []
        for slot, color in enumerate(colors):
            material = materials[slot] if slot < len(materials) else None
            where = f"'{given.file}': slot {slot} of '{name}'"
            if material is None:
                raise SceneError(f"{where} has no material: give all slots of it one colour")
            if not np.array_equal(found.setdefault(material.name_full, color), color):
                raise SceneError(
                    f"{where} gives material '{material.name}' a second colour: Blender shows a "
                    "material in one; give each object one colour, or each material"
                )
    return Palette(By.MATERIAL, found, given=given)


def automatic(scene: bpy.types.Scene, exported: Scene, manifest: Manifest) -> Palette:
    """Return the viewport's colours, in which a scene was exported, if they tell objects apart.

    Else a clear colour for each object.
    """
    pair = not_told_apart(exported, manifest.owners)
    if pair is None:
        return VIEWPORT
    try:
        return clear_palette(_object_names(scene), automatic_note("viewport", pair))
    except SceneError as error:
        return Palette(By.VIEWPORT, note=f"'{pair[0]}' and '{pair[1]}' share a colour: {error}")


def as_compared(scene: Any, exported: Scene, manifest: Manifest) -> tuple[Scene, Manifest]:
    """Return a render's export in the clear colours that a comparison would use.

    With other choices of colours it stays as it is, in those of the viewport.

    Raises
    ------
    SceneError
        If there are more objects than colours.
    """
    by = By(scene.reference_tracer.colors.lower())
    if by == By.AUTOMATIC:
        palette = automatic(scene, exported, manifest)
    else:
        palette = palette_by(scene, by) if by == By.OBJECT else VIEWPORT
    if palette.by == By.OBJECT:
        whose = zip(exported.instance_objects, manifest.owners, strict=False)
        grey = np.array(GREY[:3], np.float32)  # of instancers whose type has no colour
        slots = {(exported.objects[n], o): palette.colors.get(o, grey)[None] for n, o in whose}
        exported = recolored(exported, GivenColors("--colors", slots), manifest.owners)
    return exported, noted(palette, exported, manifest)


def noted(palette: Palette, exported: Scene, manifest: Manifest) -> Manifest:
    """Return the manifest with the palette's note; raises SceneError if a colour is missing."""
    palette.check(exported, manifest.owners)
    return replace(manifest, notes=(*manifest.notes, *filter(None, [palette.note])))


def _object_names(scene: bpy.types.Scene) -> list[str]:
    """Return all objects that have a colour, those of a scene first; hidden ones have theirs, too.

    So an object keeps its colour in every frame, view layer and engine.
    """
    own = {o.name_full for o in scene.objects if o.type not in NOT_DRAWN}
    every = {o.name_full for o in bpy.data.objects if o.type not in NOT_DRAWN}
    return [*sorted(own), *sorted(every - own)]


def _of_materials(scene: bpy.types.Scene) -> Palette:
    found = {m.name_full: _base_color(m) for m in bpy.data.materials}
    colors = {name: color for name, color in found.items() if color is not None}
    slots = (slot for o in scene.objects if o.type not in NOT_DRAWN for slot in o.material_slots)
    used = dict.fromkeys(slot.material.name_full for slot in slots if slot.material)
    others = [f"'{name}'" for name in used if name not in colors]
    note = ""
    if others:
        named = listed(others, _NAMED)
        note = f"materials without one base colour show that of the viewport: {named}"
    return Palette(By.MATERIAL, colors, note)


def _base_color(material: Material) -> Colors | None:
    """Return the base colour, (3,) linear RGB, of the Principled BSDF that a material shows.

    None where it shows something else, or nodes make its colour.
    """
    if not (material.use_nodes and material.node_tree):
        return None
    output = material.node_tree.get_output_node("ALL")
    links = output.inputs["Surface"].links if output else ()
    if not links or links[0].from_node.type != "BSDF_PRINCIPLED":
        return None
    socket: Any = links[0].from_node.inputs["Base Color"]
    return None if socket.is_linked else np.array(socket.default_value[:3], np.float32)

"""Variants with hidden objects shown, and those of other view layers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from bpy.types import Object

from ....causes.case import Variant
from ....scene import Instance, Scene
from ...evaluating import export_for_render
from ...reading.colors import instance_colors, slot_materials
from ...reading.meshes import read_mesh
from ...temporary import everything, temporary_scene
from .origin import Origin

MOST = 8  # objects, or view layers


def variants(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with what it hides."""
    yield from _hidden(origin)
    names = [v.name for v in origin.scene.view_layers if v.name != origin.layer]
    for name in names[:MOST]:
        with temporary_scene(origin.scene, name, palette=origin.palette) as tmp, everything(tmp):
            scene, _ = export_for_render(tmp)
        yield Variant("other_layer", scene, f"'{name}'")


def _hidden(origin: Origin) -> Iterator[Variant]:
    """Yield the scene with each object that is not exported, and with all of them."""
    there = set(origin.exported.objects)
    hidden = [o for o in origin.scene.objects if o.type == "MESH" and o.name_full not in there]
    whole = origin.exported
    for obj in hidden[:MOST]:
        whole = _with(whole, obj, origin)
        why = "it is hidden in renders" if obj.hide_render else "it is hidden, or excluded"
        yield Variant("hidden_shown", _with(origin.exported, obj, origin), why, obj.name_full)
    if len(hidden) > 1:
        names = ", ".join(o.name_full for o in hidden[:MOST])
        yield Variant("hidden_shown", whole, "all that is hidden", names)


def _with(scene: Scene, obj: Object, origin: Origin) -> Scene:
    """Return a scene with an object more, as it is without modifiers."""
    name = obj.name_full
    read = read_mesh(obj, name, False)
    if read is None:
        return scene
    colors = instance_colors(obj, obj, origin.tmp.display.shading, slot_materials(obj))
    matrix = np.array(obj.matrix_world, np.float64)
    instance = Instance(len(scene.meshes), len(scene.objects), matrix, colors)
    return replace(
        scene,
        meshes=(*scene.meshes, read[0]),
        instances=(*scene.instances, instance),
        objects=(*scene.objects, name),
    )

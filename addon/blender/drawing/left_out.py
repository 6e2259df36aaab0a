"""Leaves out of a temporary scene what draws itself, as hair does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from typing import Any

import bpy
import numpy as np
from bpy.types import ParticleSettings, Scene

from ...manifest import Effect, Manifest, Unmodelled
from ..reading.unmodelled import HAIR, is_hair
from ..temporary import leave_out
from ..values import is_animated, untold

_HIDING = ("hide_render", "hide_viewport")


@contextmanager
def left_out(tmp: Scene, features: Sequence[Unmodelled]) -> Iterator[None]:
    """Leave hair, and objects that draw what is no triangle, out of a temporary scene, for a while.

    Where an animation would show again what was hidden, the object leaves the scene.
    """
    growing = {u.object for u in features if u.feature == HAIR}
    others = {name for u in features if u.feature != HAIR for name in (u.object, *u.by)}
    objects = {o for o in bpy.data.objects if o.name_full in others}
    old: set[Any] = {o for o in objects if str(o.type) == "GPENCIL"}  # 4.2 would not show it again
    leave_out(tmp, old | {o for o in objects if is_animated(o, *_HIDING)})
    hidden = dict.fromkeys(objects - old, np.bool_(True))
    hair = _hair(growing)
    with ExitStack() as stack:
        for name in _HIDING:
            stack.enter_context(untold(bpy.data.objects, name, hidden))
        for name in ("render_type", "display_method"):
            items: Any = bpy.types.ParticleSettings.bl_rna.properties[name]
            none = np.int32(items.enum_items["NONE"].value)
            stack.enter_context(untold(bpy.data.particles, name, dict.fromkeys(hair, none)))
        yield


def _hair(objects: set[str]) -> set[ParticleSettings]:
    """Return the settings of all hair of some objects, by their names."""
    return {
        system.settings
        for obj in bpy.data.objects
        if obj.name_full in objects
        for system in obj.particle_systems
        if is_hair(system.settings)
    }


def separable(manifest: Manifest) -> list[Unmodelled]:
    """Return what draws itself and can be left out without leaving out what is traced."""
    traced = {e.name for e in manifest.objects if e.exported} | set(manifest.owners)
    drawn_itself = (u for u in manifest.unmodelled if u.effect is Effect.DRAWN)
    return [u for u in drawn_itself if u.feature == HAIR or traced.isdisjoint((u.object, *u.by))]

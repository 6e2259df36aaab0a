"""Finds what Blender's own shading does to a picture *as it is*.

Such a picture has the light, effects and anti-aliasing that the user has set.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

import bpy
from bpy.types import Context, Scene, View3DShading

from ...manifest import Effect, Unmodelled
from ..temporary import user_scene
from .judge import Judge


def anti_aliasing(scene: Scene, judge: Judge, like_for_like: bool) -> str:
    """Return what smooths the edges of the picture; 'OFF' for nothing.

    In a window that is the user's preference, whatever the scene says.
    """
    if like_for_like:
        return "OFF"
    if judge.needs_window:
        preferences = bpy.context.preferences
        return preferences.system.viewport_aa
    return scene.display.render_aa


def solid_shading(context: Context) -> View3DShading:
    """Return the solid shading of the 3D view the user is in, else of the window's first one."""
    areas = [context.area, *(context.window.screen.areas if context.window else ())]
    found = (a.spaces.active.shading for a in areas if a and a.type == "VIEW_3D")
    return next((shading for shading in found if shading.type == "SOLID"), None)


def use_view_shading(scene: Scene, shading: View3DShading) -> None:
    """Copy a 3D view's own solid shading to a scene, for a picture *as it is*."""
    own = scene.display.shading
    for prop in own.bl_rna.properties:
        if not prop.is_readonly and prop.identifier not in ("type", "rna_type"):
            with suppress(TypeError):  # an enum whose items depend on the others: theirs come first
                setattr(own, prop.identifier, getattr(shading, prop.identifier))


def of_shading(scene: Scene, judge: Judge, anti_aliasing: str) -> Iterator[Unmodelled]:
    """Yield what a picture *as it is* may show anywhere, and constant shading does not have.

    Only anti-aliasing can be checked: it mixes colours that the tracer sees.
    """
    shading = scene.display.shading
    name = f"scene '{user_scene(scene).name}'"
    if not judge.solid:
        yield Unmodelled(name, "materials and light", f"of {judge.label}", None, Effect.LIGHT)
        return
    detail = "Blender's picture is made with it"
    smoothing = Effect.NONE
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
            smoothing = Effect.LIGHT
            yield Unmodelled(name, feature, detail, None, effect)
    if anti_aliasing != "OFF":
        yield Unmodelled(name, "anti-aliasing", detail, None, smoothing)

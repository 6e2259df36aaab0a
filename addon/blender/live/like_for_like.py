"""Has Blender draw what a 3D view shows, like for like, and returns the case to be compared.

Blender draws it as a camera's picture in a temporary scene. It could also draw the view itself
off-screen; but for that the view's shading would have to be switched, which frees its engine, and
the user's preference for anti-aliasing would draw everything eight times.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
from bpy.types import Depsgraph, SpaceView3D, ViewLayer

from ...causes.case import Case
from ...pictures.colors_file import owners_of
from ...pictures.picture import Picture
from ...pictures.sampling import Sampling
from ...pictures.source import Source
from ...scene import Camera, Scene, SceneError
from ...tracer.settings import Settings
from ..drawing.camera_object import add_camera
from ..drawing.drawings import Drawing, Plan, turns
from ..drawing.rasteriser import snapping_of
from ..drawing.viewport import VIEWPORT
from ..evaluating import evaluated
from ..reading.camera import certify_camera
from ..reading.export import NO_SURFACE, export
from ..reading.visible import in_view, types_left_out
from ..temporary import drawn, leave_out, made_for

AWAY = 1e-3  # of the clip range: how far before all that it shows a camera is placed


def is_busy() -> bool:
    """Return whether the user, or a render, is in the middle of something."""
    manager = bpy.context.window_manager
    busy = any(w.modal_operators or w.screen.is_animation_playing for w in manager.windows)
    return busy or bpy.app.is_job_running("RENDER")


def case_of(space: int, scene: Scene, settings: Settings) -> Case:
    """Have Blender draw the scene that a 3D view shows, by its space's address.

    Raises
    ------
    SceneError
        If Blender makes no picture of it.
    """
    window, shown = _view_of(space)
    layer = window.view_layer
    snapping = snapping_of(VIEWPORT)  # its drawing is the first, which may differ from the others
    plan = Plan(window.scene, layer.name, VIEWPORT)

    def export_view(_: Any, used: dict[str, Any], depsgraph: Depsgraph) -> Drawing:
        exported, manifest = export(depsgraph)
        traced = replace(scene, background=exported.background)
        manifest = replace(manifest, owners=owners_of(scene))
        return Drawing(plan, traced, manifest, used, certify_camera(depsgraph, scene.camera))

    with plan.prepared() as (tmp, used):
        _leave_out_unseen(tmp, layer, shown)
        tmp.render.use_border = False  # it is of the camera's picture, not of this one
        looking = made_for(tmp, add_camera(tmp, _from_before(scene.camera)))
        made_for(tmp, looking.data)
        drawing, pixels, _ = evaluated(tmp, VIEWPORT, turns(tmp, used, export_view))
    certificate = drawing.certificate
    drawn_picture = Picture(
        pixels,
        Source(VIEWPORT.name, bpy.app.version_string),
        # Blender stores the view's own camera rounded again: its samples lie so far off.
        sampling=Sampling(certificate.largest if certificate else 0.0, snapping=snapping),
    )
    return Case(drawing.exported, drawing.manifest, settings, drawn_picture, certificate)


def _view_of(space: int) -> tuple[Any, Any]:
    """Return the window and the `SpaceView3D` of a space's address."""
    manager = bpy.context.window_manager
    spaces = ((w, a.spaces.active) for w in manager.windows for a in w.screen.areas)
    return next((w, s) for w, s in spaces if s.as_pointer() == space)


def _leave_out_unseen(tmp: bpy.types.Scene, layer: ViewLayer, space: SpaceView3D) -> None:
    """Leave out of a temporary scene what a 3D view does not show of a view layer."""
    unshown = types_left_out(space)
    if unshown.difference(NO_SURFACE):  # a camera's picture has them
        raise SceneError("This view leaves out types of objects that have surfaces: show them all.")
    evaluated = ((o, o.evaluated_get(layer.depsgraph)) for o in drawn(tmp))
    leave_out(tmp, [o for o, e in evaluated if not in_view(space, unshown, e, layer)])


def _from_before(camera: Camera) -> Camera:
    """Return a camera that does not look behind itself, moved back to before all that it shows.

    An orthographic view looks behind itself, but no camera of Blender's does. Parallel rays stay
    the same.
    """
    if camera.clip_start > 0:
        return camera
    back = camera.clip_start - AWAY * (camera.clip_end - camera.clip_start)
    matrix = camera.world_from_camera.copy()
    matrix[:3, 3] += back * camera.forward
    return replace(
        camera,
        world_from_camera=matrix,
        clip_start=camera.clip_start - back,
        clip_end=camera.clip_end - back,
    )

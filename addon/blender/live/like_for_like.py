"""Blender's own drawing of what a 3D view shows, like for like, and the case to be compared.

It is drawn as a camera's picture in a temporary scene. Of the view itself an off-screen drawing
could be made; but its shading would have to be switched for it, which frees its engine; and it
would be anti-aliased by the user's preference, which draws everything eight times.
"""

from __future__ import annotations

from dataclasses import replace

import bpy

from ...compare.case import Case
from ...compare.picture import Picture, Source
from ...scene import Camera, Scene, SceneError
from ...tracer.settings import Settings
from ..drawing.camera_object import add_camera
from ..drawing.judges import JUDGES
from ..drawing.rasteriser import snapping_of
from ..drawing.temporary import drawn, leave_out, temporary_scene
from ..drawing.viewport import picture, prepare_scene
from ..reading.camera import certify_camera
from ..reading.export import NO_SURFACE, export
from ..reading.planes import stand_ins
from ..reading.visible import in_view, types_left_out

AWAY = 1e-3  # of the clip range: how far before all that it shows a camera is placed
_VIEWPORT = JUDGES["viewport"]


def is_busy() -> bool:
    """Return whether the user, or a render, is in the middle of something."""
    windows = bpy.context.window_manager.windows
    busy = any(w.modal_operators or w.screen.is_animation_playing for w in windows)
    return busy or bpy.app.is_job_running("RENDER")


def case_of(space: int, scene: Scene, settings: Settings) -> Case:
    """Have Blender draw the scene that a 3D view shows, by its space's address.

    Raises
    ------
    SceneError
        If Blender makes no picture of it.
    """
    windows = bpy.context.window_manager.windows
    spaces = ((w, a.spaces.active) for w in windows for a in w.screen.areas)
    window, shown = next((w, s) for w, s in spaces if s.as_pointer() == space)
    layer, own, unshown = window.view_layer.name, window.view_layer, types_left_out(shown)
    if unshown.difference(NO_SURFACE):  # a camera's picture has them
        raise SceneError("This view leaves out types of objects that have surfaces: show them all.")
    with temporary_scene(window.scene, layer, _VIEWPORT) as tmp:
        every = ((o, o.evaluated_get(own.depsgraph)) for o in drawn(tmp, layer))
        leave_out(tmp, layer, [o for o, e in every if not in_view(shown, unshown, e, own)])
        prepare_scene(tmp, True)
        tmp.render.use_border = False  # it is of the camera's picture, not of this one
        looking = add_camera(tmp, _from_before(scene.camera)).data
        try:
            with bpy.context.temp_override(scene=tmp, view_layer=tmp.view_layers[layer]):
                depsgraph = bpy.context.evaluated_depsgraph_get()
                exported, manifest = export(depsgraph)
                certificate = certify_camera(depsgraph.scene_eval, depsgraph, scene.camera)
            snapping = snapping_of(_VIEWPORT)
            planes = [scene.objects[p.object] for p in scene.planes]
            with stand_ins(tmp, layer, scene, planes) as traced:
                pixels = picture(tmp, layer, _VIEWPORT, scene.camera, True)
        finally:
            bpy.data.cameras.remove(looking)  # and the object with it
    traced = replace(traced, background=exported.background)
    # The view's own camera is rounded again, where Blender stores it: its samples lie so far off.
    drawn_as = {"snapping": snapping, "sample_radius": certificate.largest}
    shown_by = Source(_VIEWPORT.name, bpy.app.version_string)
    return Case(traced, manifest, settings, Picture(pixels, shown_by, **drawn_as))


def _from_before(camera: Camera) -> Camera:
    """Return a camera, moved to before all that it shows if it looks behind itself, too.

    So does an orthographic view, but no camera of Blender's. Parallel rays stay the same.
    """
    if camera.clip_start > 0:
        return camera
    back = camera.clip_start - AWAY * (camera.clip_end - camera.clip_start)
    matrix = camera.world_from_camera.copy()
    matrix[:3, 3] += back * camera.forward
    clip = {"clip_start": camera.clip_start - back, "clip_end": camera.clip_end - back}
    return replace(camera, world_from_camera=matrix, **clip)

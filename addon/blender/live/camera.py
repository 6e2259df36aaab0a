"""Makes a `scene.Camera` from the matrices with which Blender draws a 3D view.

A point v of the world is at c = view_matrix v before the view, and appears, from -1 to 1 over the
region, at (P00 cx + P02 cz + P03) / w and (P11 cy + P12 cz + P13) / w, where P is the window_matrix
and w the depth -cz in perspective, else 1. The matrices are float32, and taken as they are.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from bpy.types import RegionView3D, Scene, SpaceView3D

from ...arrays import Floats
from ...projections import ORTHOGRAPHIC, PERSPECTIVE
from ...scene import Camera, Region, SceneError, ViewWindow
from ...tracer.camera import film_of
from ..reading.camera import border_region, projection_of


def camera_of(
    region: bpy.types.Region, region_3d: RegionView3D, space: SpaceView3D, scene: Scene
) -> Camera:
    """Return the camera of a 3D view; its picture is as large as the region.

    Clip range and render border are the view's own or the camera's, as Blender has it.

    Parameters
    ----------
    region : bpy.types.Region
    region_3d : bpy.types.RegionView3D
    space : bpy.types.SpaceView3D
    scene : bpy.types.Scene
        What the view shows.

    Raises
    ------
    SceneError
        If the view looks through an object that the tracer does not model, or shows nothing.
    """
    through = None
    if region_3d.view_perspective == "CAMERA":
        through = space.camera if space.use_local_camera else scene.camera
    if through and not projection_of(through, scene).is_linear:
        raise SceneError(
            f"Camera '{through.name}' is a panorama, which a 3D view does not show: leave the "
            "camera's view, or render (F12)."
        )
    own = through.data if through else space
    start = own.clip_start
    end = own.clip_end
    p = np.array(region_3d.window_matrix, np.float64)
    projection = ORTHOGRAPHIC if p[3, 3] else PERSPECTIVE
    if projection.sees_behind and not through:  # Blender looks both ways
        start = -end / 2
        end = end / 2
    # Where -1 and 1 are: P00 u - P02 = -1 or 1 at u = cx / w in perspective, as cz / w = -1 there;
    # P00 u + P03 else.
    middle = -p[:2, 3] if projection.shares_direction else p[:2, 2]
    scale = p[[0, 1], [0, 1]]
    left, bottom = ((middle - 1) / scale).tolist()
    right, top = ((middle + 1) / scale).tolist()
    camera = Camera(
        world_from_camera=np.linalg.inv(np.array(region_3d.view_matrix, np.float64)),
        window=ViewWindow(left, right, bottom, top),
        width=region.width,
        height=region.height,
        projection=projection,
        clip_start=start,
        clip_end=end,
        name=through.name if through else "3D view",
    )
    return _within_border(camera, through, space, scene)


def coarser(camera: Camera, factor: int) -> Camera:
    """Return a camera with pixels `factor` times as wide and high, from the same corner on.

    The last ones may reach beyond the picture.
    """
    width = -(-camera.width // factor)
    height = -(-camera.height // factor)
    w = camera.window
    r = camera.region
    across = (w.right - w.left) * (width * factor / camera.width)
    up = (w.top - w.bottom) * (height * factor / camera.height)
    return replace(
        camera,
        window=replace(w, right=w.left + across, top=w.bottom + up),
        width=width,
        height=height,
        region=Region(r.x0 // factor, r.y0 // factor, -(-r.x1 // factor), -(-r.y1 // factor)),
    )


def frame_in_view(camera: Camera, through: Any, scene: Scene) -> tuple[Floats, Floats]:
    """Return two corners of a Blender camera's frame in the view through it, (2,) in pixels.

    The lower left one, and the upper right one; `camera` is the view's own.
    """
    corners = np.array(through.data.view_frame(scene=scene), np.float64).T
    axes = camera.world_from_camera
    film = np.array(film_of(camera, axes[:3, :3] @ corners + axes[:3, 3:])[:2])
    return film.min(axis=1), film.max(axis=1)


def _within_border(camera: Camera, through: Any, space: SpaceView3D, scene: Scene) -> Camera:
    """Return the camera with the part of its picture that a render border leaves."""
    owner, name = (scene.render, "border") if through else (space, "render_border")
    if not getattr(owner, f"use_{name}"):
        return camera
    ends = [[getattr(owner, f"{name}_{end}_{axis}") for axis in "xy"] for end in ("min", "max")]
    if through:  # it is that of the camera's frame
        low, high = frame_in_view(camera, through, scene)
        ends = (low + ends * (high - low)) / (camera.width, camera.height)
    (x0, y0), (x1, y1) = np.clip(ends, 0, 1)
    return replace(camera, region=border_region(camera.width, camera.height, x0, x1, y0, y1))

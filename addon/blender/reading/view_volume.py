"""The camera's view volume: finds what lies outside it, and where an infinite plane cuts it."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from ...arrays import Bools, Floats
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Plane, Region, ViewWindow
from ...tracer.camera import pixel_size
from ...tracer.candidates import pixel_bounds
from ...tracer.world import box_corners

BEYOND = 2  # pixels beyond the picture: a comparison looks half a pixel beside a pixel's centre
MARGIN = 0.01  # of the clip range's ends, so that Blender's own clipping decides, in float32


def volume_corners(camera: Camera) -> Floats:
    """Return the eight corners of the view volume, (8, 3) world space; bits: x, y, depth."""
    camera = _linear(camera)
    w = _window(camera)
    out = []
    for depth, y, x in product(_depths(camera), (w.bottom, w.top), (w.left, w.right)):
        across = camera.projection.scale(depth) * (x * camera.right + y * camera.up)
        out.append(camera.origin + across + depth * camera.forward)
    return np.array(out)


def outside(camera: Camera, bounds: Floats, world_from_object: Floats) -> Bools:
    """Return which of k boxes no ray near a pixel of the camera's whole picture meets, (k,).

    What has a box that is not finite is never outside. What is, is so for rays in float32, too.

    Parameters
    ----------
    bounds : (2, 3, k)
        The lowest and the highest corner of each box, in its object's space.
    world_from_object : (4, 4, k) float64
    """
    start, end = _depths(camera)
    whole = Region(0, 0, camera.width, camera.height)
    looking = replace(camera, clip_start=start, clip_end=end, region=whole)
    with np.errstate(over="ignore"):
        corners = box_corners(bounds, world_from_object).astype(np.float32)
    x0, x1, y0, y1 = pixel_bounds(looking, corners, BEYOND + 0.5)
    return (x0 >= x1) | (y0 >= y1)


def _linear(camera: Camera) -> Camera:
    """Return a camera with a flat-sided view volume that holds this one's: of a panorama a box."""
    if camera.projection.is_linear:
        return camera
    end = camera.clip_end
    window = ViewWindow(-end, end, -end, end)
    return replace(camera, projection=ORTHOGRAPHIC, window=window, clip_start=-end)


def _window(camera: Camera) -> ViewWindow:
    w = camera.window
    x, y = pixel_size(camera)
    return ViewWindow(
        w.left - BEYOND * x, w.right + BEYOND * x, w.bottom - BEYOND * y, w.top + BEYOND * y
    )


def _depths(camera: Camera) -> tuple[float, float]:
    start = camera.clip_start
    end = camera.clip_end
    return start - MARGIN * abs(start), end + MARGIN * abs(end)


def polygon(camera: Camera, plane: Plane) -> Floats:
    """Return the polygon in which a plane cuts the view volume: its corners in order, (k, 3) world.

    k is at most 6, and 0 where the plane misses the volume. The volume is somewhat larger than what
    is seen, so that the polygon's rim never is.
    """
    corners = volume_corners(camera)
    height = ((corners - plane.point) * plane.normal).sum(axis=1)
    points = []
    for a in range(8):
        for bit in (1, 2, 4):  # corners whose numbers differ in one bit share an edge
            b = a | bit
            if a != b and (height[a] < 0) != (height[b] < 0):
                share = height[a] / (height[a] - height[b])
                points.append(corners[a] + share * (corners[b] - corners[a]))
    if len(points) < 3:
        return np.zeros((0, 3))
    found = np.array(points)
    centered = found - found.mean(axis=0)
    across = centered[0]
    along = np.cross(plane.normal, across)
    y, x = (centered @ axis / np.linalg.norm(axis) for axis in (along, across))
    return found[np.argsort(np.arctan2(y, x))]

"""The camera's view volume: finds what lies outside it, and where an infinite plane cuts it."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from ...arrays import Bools, Floats
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Plane, Region, ViewWindow
from ...tracer.camera import camera_rays
from ...tracer.candidates import pixel_bounds
from ...tracer.world import box_corners

BEYOND = 2  # pixels beyond the picture: a comparison looks half a pixel beside a pixel's centre
MARGIN = 0.01  # of the clip range's ends, so that Blender's own clipping decides, in float32


def _corners(camera: Camera) -> Floats:
    """Return the eight corners of the view volume, (8, 3) world space; bits: x, y, depth."""
    if not camera.projection.is_linear:  # of a panorama a box that holds what it sees
        end = camera.clip_end
        window = ViewWindow(-end, end, -end, end)
        camera = replace(camera, projection=ORTHOGRAPHIC, window=window, clip_start=-end)
    across, up = ((-BEYOND, size + BEYOND) for size in (camera.width, camera.height))
    y, x = np.array([*product(up, across)], np.float64).T
    rays = camera_rays(camera, x, y)
    return np.concatenate([rays.at(depth).T for depth in _depths(camera)])


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


def _depths(camera: Camera) -> Floats:
    """Return where the view volume begins and ends, (2,) metres."""
    ends = np.array((camera.clip_start, camera.clip_end))
    return ends + (-MARGIN, MARGIN) * np.abs(ends)


def polygon(camera: Camera, plane: Plane) -> Floats:
    """Return the polygon in which a plane cuts the view volume: its corners in order, (k, 3) world.

    k is at most 6, and 0 where the plane misses the volume. The volume is somewhat larger than what
    is seen, so that the polygon's rim never is.
    """
    corners = _corners(camera)
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

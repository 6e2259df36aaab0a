"""The camera's view volume: finds what lies outside it, and where an infinite plane cuts it."""

from __future__ import annotations

from dataclasses import replace
from itertools import product

import numpy as np

from ...arrays import Bools, Floats
from ...projections import ORTHOGRAPHIC
from ...scene import Camera, Plane, ViewWindow
from ...tracer.camera import dual_axes, pixel_size

BEYOND = 2  # pixels beyond the picture: a comparison looks half a pixel beside a pixel's centre
MARGIN = 0.01  # of the clip range's ends, so that Blender's own clipping decides, in float32

# Of the sum of a distance's terms: 16 roundings of float32, in which a scene may be traced.
_SLACK = 2.0**-20


def volume_corners(camera: Camera) -> Floats:
    """Return the eight corners of the view volume, (8, 3) world space; bits: x, y, depth."""
    camera = _linear(camera)
    w = _window(camera)
    out = []
    for depth, y, x in product(_depths(camera), (w.bottom, w.top), (w.left, w.right)):
        across = camera.projection.scale(depth) * (x * camera.right + y * camera.up)
        out.append(camera.origin + across + depth * camera.forward)
    return np.array(out)


def outside(
    camera: Camera,
    low: Floats,
    high: Floats,
    world_from_object: Floats,
) -> Bools:
    """Return which of k boxes lie wholly beyond one of the view volume's six sides, (k,).

    A box that lies beyond an edge or a corner of the volume, but beyond no side, is not found. A
    box that is not finite is never outside.

    Parameters
    ----------
    low, high : (k, 3)
        Corners of each box in its object's space.
    world_from_object : (k, 4, 4) float64
    """
    found = np.zeros(len(low), bool)
    with np.errstate(over="ignore", invalid="ignore"):  # then nothing is outside
        low = np.asarray(low, np.float64)
        high = np.asarray(high, np.float64)
        center = low / 2 + high / 2
        half = high / 2 - low / 2
        farthest = np.abs(center) + half
        for normal, offset in zip(*_sides(camera), strict=True):
            # The side in each object's space: its height over a point, and the sum of its terms.
            terms = normal * camera.origin
            side = np.append(normal, offset - terms.sum()) @ world_from_object
            size_of_side = np.append(np.abs(normal), abs(offset) + np.abs(terms).sum())
            size = size_of_side @ np.abs(world_from_object)
            most = (side[:, :3] * center + np.abs(side[:, :3]) * half).sum(axis=1) + side[:, 3]
            most_size = (size[:, :3] * farthest).sum(axis=1) + size[:, 3]
            found |= most < -_SLACK * most_size
    return found


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


def _sides(camera: Camera) -> tuple[Floats, Floats]:
    """Return normals (6, 3) and offsets (6,): n . (p - origin) + offset >= 0 within a side."""
    camera = _linear(camera)
    # The axes need not be orthonormal: a point's coordinates are its products with their dual.
    x, y, depth = dual_axes(camera)
    w = _window(camera)
    edges = np.array((w.left, -w.right, w.bottom, -w.top))
    across = np.stack((x, -x, y, -y))
    start, end = _depths(camera)
    if camera.projection.shares_direction:
        offsets = -edges
    else:
        across, offsets = across - edges[:, None] * depth, np.zeros(4)
    return np.stack((*across, depth, -depth)), np.array((*offsets, -start, end))


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

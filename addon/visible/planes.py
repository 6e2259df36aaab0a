"""What infinite planes hide."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..certified.bounds import Fractions, plane_fractions
from ..certified.rounding import rounding
from ..certified.sweep.depth_buffer import ROUNDING, nearness
from ..scene import Plane, Scene
from ..tracer.camera import camera_rays
from ..tracer.vector import dot
from .faces import Faces
from .polygons import cut

# Of a corner's distance to a plane, relative to the terms of the face's farthest corners. Each cut
# before moved it by twice that at most.
_ROUNDING = 2.0**-50
_HUGE = 2.0**900  # nothing over- or underflows for a distance whose terms are smaller


def behind_plane(scene: Scene, faces: Faces, plane: Plane, low: Floats, high: Floats) -> Floats:
    """Return the nearness that an infinite plane has at least in n boxes, (n,); else -inf.

    There is room for the rounding of the rays at the corners, and of those between.
    """
    camera = scene.camera
    parallel = camera.projection.shares_direction
    x, y = np.stack((low, high), axis=1)
    rays = camera_rays(camera, np.concatenate((*x, *x)), np.concatenate((*y, *y[::-1])))
    found = plane_fractions(rays, plane.point[:, None], plane.normal[:, None])
    off = 2 * rounding(scene).ray * np.abs(plane.normal).max()
    moved = Fractions(
        found.numerator,
        found.numerator_error + (off if parallel else 0.0),
        found.denominator,
        found.denominator_error + (0.0 if parallel else off),
    )
    first, last = (np.broadcast_to(end, rays.count) for end in moved.interval())
    least, most = nearness(camera, first, last, ROUNDING)
    sure = np.isfinite(last) & faces.clip.inside(least, most)
    return np.where(sure, least, -np.inf).reshape(4, -1).min(axis=0)


def before_planes(
    scene: Scene, faces: Faces, polygons: Floats, low: Floats, high: Floats
) -> Floats:
    """Return the parts of polygons (l, 3, n) that planes may leave in boxes, in world space.

    A plane that is met by all of a box's rays leaves what may be on the eye's side of it. The
    polygons are faces, cut once at most.
    """
    camera = scene.camera
    largest = np.abs(polygons).max(axis=0)[:, None]
    for number, plane in enumerate(scene.planes, start=1):
        parallel = camera.projection.shares_direction
        away = camera.forward if parallel else plane.point - camera.origin
        normal = -np.sign(away @ plane.normal) * plane.normal[:, None, None]
        corners = polygons.swapaxes(0, 1)
        point = plane.point[:, None, None]
        size = dot(np.abs(normal), largest + np.abs(point))
        value = dot(normal, corners - point) + (1 + 2 * number) * _ROUNDING * size
        met = behind_plane(scene, faces, plane, low, high) > -np.inf
        met = met & (size > 1 / _HUGE) & (size < _HUGE)
        polygons = cut(polygons, np.where(met, value, 1.0))
    return polygons

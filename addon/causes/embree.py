"""Bounds what Embree, which Cycles traces with, does to very large triangles.

It computes in float32. A triangle with a corner beyond a limit it takes for invalid: none of it is
drawn. Of the others it lets a little more be hit than there is, so that no ray falls between two:
a share of the triangle's own size, which may be pixels if a corner is a thousand kilometres away.
What Cycles shows there proves nothing.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..arrays import Array, Bools, Floats
from ..pictures.bounds import SNAPPING, U32
from ..scene import Camera, Instance, Mesh, Scene
from ..tracer import plane
from ..tracer.camera import Rays, camera_rays, film_positions, pixel_size
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.vector import dot, transform_points
from ..tracer.world import box_corners, planes_of, reaches, world_corners

# A ray passes a triangle if no weight is below minus this: it is float32's epsilon times |U+V+W|.
TOLERANCE = 2 * U32
# The roundings on the longest path of U = ((v2 - v0) x (v2 + v0)) . d: a difference or a sum, three
# for the cross product, three for the scalar product, one for the tolerance itself.
ROUNDINGS = 8
# Square metres, of twice the area, the length of the normal: Cycles shows no triangle where the
# square of that is beyond float32 (measured in 5.2: 1.8444e19 is shown, 1.8449e19 is not).
LARGEST = float(np.sqrt(np.finfo(np.float32).max)) * (1 - 2.0**-12)
GROSS = 2.0**-10  # of a weight; of a ground plane of 10 km it is some 2^-19
MOST = 64  # triangles that are tested in every pixel, the largest


def not_decidable(scene: Scene, frame: Frame, farthest: float) -> Bools:
    """Return the pixels (h, w) in which Embree may not show what the nearest triangle is.

    `farthest` is the limit of a corner's coordinates, metres: in the world, or in the object's own
    space, as triangles may be kept in either.
    """
    out = np.zeros(frame.shape, bool)
    least = min(farthest, np.sqrt(LARGEST) / 4)  # of a coordinate: those of smaller areas are less
    far = (reaches(scene) >= least).any(axis=0)
    for number, instance in enumerate(scene.instances):
        mesh = scene.meshes[instance.mesh]
        if far[number] or np.abs(mesh.bounds).max() >= least:
            own = frame.instance_index == number
            out[own] = _beyond(mesh, instance, farthest)[frame.triangle_index[own]]
    return out | _unsure(scene, frame)


def _beyond(mesh: Mesh, instance: Instance, farthest: float) -> Bools:
    """Return which triangles of an instance have a corner or an area beyond the limits, (n,)."""
    own = mesh.vertices.T.astype(np.float64)
    with np.errstate(over="ignore", invalid="ignore"):
        world = transform_points(instance.world_from_object, own)
        corner = ~(np.maximum(np.abs(own), np.abs(world)).max(axis=0) < farthest)
        out = corner[mesh.triangles].any(axis=1)
        for points in (own, world):
            a, b, c = points.T[mesh.triangles].transpose(1, 2, 0)
            area = np.linalg.norm(np.cross(b - a, c - a, axis=0), axis=0)
            # What float32 may add to it, where most of the products cancels.
            off = 8 * U32 * np.linalg.norm(b - a, axis=0) * np.linalg.norm(c - a, axis=0)
            out |= ~(area + off < LARGEST)
    return out


@np.errstate(all="ignore")
def _unsure(scene: Scene, frame: Frame) -> Bools:
    """Return the pixels (h, w) in which a large triangle may be hit, or missed, by rounding alone.

    One of another instance than the pixel shows may be hit before that, by a ray that passes it by.
    One that the pixel shows may be missed if rounding moves its weights by more than GROSS; by
    less, a neighbour is hit in its place, as they share the edge.
    """
    out = np.zeros(frame.shape, bool)
    found = _large(scene)
    if not found:
        return out
    rays = camera_rays(scene.camera, *film_positions(scene.camera.region))
    t = np.where(frame.instance_index == NOTHING, scene.camera.clip_end, frame.t).ravel()
    for large in sorted(found, key=lambda one: -one.size)[:MOST]:
        terms, off = _weights(rays, large.corners)
        own = frame.instance_index == large.instance
        own &= frame.triangle_index == large.triangle
        seen = np.flatnonzero(own)
        whole = terms[:, seen].sum(axis=0)
        missed = ((terms[:, seen] < off) & (off > GROSS * whole)).any(axis=0)
        out.flat[seen[missed]] = True
        beside = np.flatnonzero(terms.min(axis=0) < 0)
        beside = beside[frame.instance_index.flat[beside] != large.instance]
        terms = terms[:, beside]
        beside = beside[(terms + off >= -TOLERANCE * terms.sum(axis=0)).all(axis=0)]
        surface = np.array([large.instance]), np.array([large.triangle])
        depth = plane.intersect(rays.take(beside), *planes_of(scene, *surface))
        out.flat[beside[(depth >= scene.camera.clip_start) & (depth < t[beside])]] = True
    return out


class _Large(NamedTuple):
    """A triangle that Embree may enlarge by more than a rasteriser's rounding."""

    size: float  # of the longest edge, in pixels where the triangle is nearest
    instance: int
    triangle: int
    corners: Floats  # (3, 3) world space


def _large(scene: Scene) -> list[_Large]:
    """Return the triangles of a scene that Embree may enlarge so."""
    boxes = box_corners(scene.instance_bounds, scene.instance_matrices)
    size = _size(scene.camera, boxes, np.ptp(boxes, axis=0).sum(axis=0))
    out = []
    for number in np.flatnonzero(size * TOLERANCE > SNAPPING).tolist():
        every = np.arange(len(scene.meshes[scene.instances[number].mesh].triangles))
        corners = world_corners(scene, np.full_like(every, number), every)
        edges = np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).max(axis=0)
        size = _size(scene.camera, corners, edges)
        large = np.flatnonzero((size * TOLERANCE > SNAPPING) & np.isfinite(size))
        out += [_Large(float(size[n]), number, int(n), corners[..., n]) for n in large]
    return out


def _size(camera: Camera, points: Array, length: Array) -> Array:
    """Return lengths (n,) in pixels, at the nearest of the points (k, 3, n) that is seen."""
    depth = dot((points - camera.origin[:, None]).swapaxes(0, 1), camera.forward).min(axis=0)
    scale = camera.projection.scale(np.maximum(depth, camera.clip_start))
    return length / (scale * min(pixel_size(camera)))


def _weights(rays: Rays, corners: Array) -> tuple[Floats, Floats]:
    """Return the weights U, V, W of a triangle's corners (3, 3) along n rays, and their errors.

    They are (3, n) and (3, 1), not yet divided by their sum, which is positive. (vi x vj) . d is
    linear in d if the rays share their origin o. If they share d, and o is w away from that of the
    first, it is linear in w: vi and vj are corners from o.
    """
    o, d = rays.origins, rays.directions
    v = corners - o[:, 0]
    i, j = np.roll(v, -1, axis=0), np.roll(v, -2, axis=0)
    if rays.one_origin:
        terms = np.cross(i, j) @ d
    else:
        terms = np.cross(i - j, d[:, 0]) @ (o - o[:, :1]) + (np.cross(i, j) @ d)
    terms *= np.sign(terms.sum(axis=0))
    # The products of (vj - vi) x (vj + vi), each taken to be positive: what cancels has its error.
    e, s = np.abs(j - i), np.abs(j + i) + 2 * np.ptp(o, axis=1)
    products = np.roll(e, -1, axis=1) * np.roll(s, -2, axis=1)
    products += np.roll(e, -2, axis=1) * np.roll(s, -1, axis=1)
    off: Floats = ROUNDINGS * U32 / 2 * (products @ np.abs(d).max(axis=1))
    return terms, off[:, None]

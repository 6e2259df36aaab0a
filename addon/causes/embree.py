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
from ..tracer.camera import Rays, camera_rays, film_positions, pixel_size
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.vector import transform_points
from ..tracer.world import reaches

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


def _unsure(scene: Scene, frame: Frame) -> Bools:
    """Return the pixels (h, w) in which a large triangle may be hit, or missed, by rounding alone.

    One of another instance than the pixel shows may be hit before that, by a ray that passes it by.
    One that the pixel shows may be missed if rounding moves its weights by more than GROSS; by
    less, a neighbour is hit in its place, as they share the edge.
    """
    out = np.zeros(frame.shape, bool)
    found = [
        (large, number)
        for number, instance in enumerate(scene.instances)
        for large in _large(scene.camera, scene.meshes[instance.mesh], instance)
    ]
    if not found:
        return out
    rays = camera_rays(scene.camera, *film_positions(scene.camera.region))
    t = np.where(frame.instance_index == NOTHING, scene.camera.clip_end, frame.t).ravel()
    for large, number in sorted(found, key=lambda one: -one[0].size)[:MOST]:
        terms, off = _weights(rays, large.corners)
        own = (frame.instance_index == number) & (frame.triangle_index == large.triangle)
        seen = np.flatnonzero(own)
        whole = terms[:, seen].sum(axis=0)
        missed = ((terms[:, seen] < off) & (off > GROSS * whole)).any(axis=0)
        out.flat[seen[missed]] = True
        beside = np.flatnonzero(terms.min(axis=0) < 0)
        beside = beside[frame.instance_index.flat[beside] != number]
        terms = terms[:, beside]
        beside = beside[(terms + off >= -TOLERANCE * terms.sum(axis=0)).all(axis=0)]
        depth = _depths(rays.take(beside), large.corners)
        out.flat[beside[(depth >= scene.camera.clip_start) & (depth < t[beside])]] = True
    return out


class _Large(NamedTuple):
    """A triangle that Embree may enlarge by more than a rasteriser's rounding."""

    size: float  # of the longest edge, in pixels where the triangle is nearest
    triangle: int
    corners: Floats  # (3, 3) world space


def _large(camera: Camera, mesh: Mesh, instance: Instance) -> list[_Large]:
    """Return the triangles of an instance that Embree may enlarge so."""
    with np.errstate(over="ignore", invalid="ignore"):
        corners = np.array(np.meshgrid(*mesh.bounds.T)).reshape(3, -1)
        box = transform_points(instance.world_from_object, corners)
        if not _size(camera, box.T, np.asarray(np.ptp(box, axis=1).sum())) * TOLERANCE > SNAPPING:
            return []  # all of the mesh is smaller than that
        world = transform_points(instance.world_from_object, mesh.vertices.T.astype(np.float64))
        corners = world.T[mesh.triangles]  # (n, corner, component)
        edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        size = _size(camera, corners, edges)
        large = np.flatnonzero((size * TOLERANCE > SNAPPING) & np.isfinite(size))
    return [_Large(float(size[n]), int(n), corners[n]) for n in large]


def _size(camera: Camera, points: Array, length: Array) -> Array:
    """Return lengths (...) in pixels, at the nearest of the points (..., k, 3) that is seen."""
    depth = ((points - camera.origin) @ camera.forward).min(axis=-1)
    scale = camera.projection.scale(np.maximum(depth, camera.clip_start))
    return length / (scale * min(pixel_size(camera)))


@np.errstate(all="ignore")
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


@np.errstate(all="ignore")
def _depths(rays: Rays, corners: Array) -> Floats:
    """Return at which t rays meet the plane of a triangle (3, 3), (n,)."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    return (normal @ (corners[0][:, None] - rays.origins)) / (normal @ rays.directions)

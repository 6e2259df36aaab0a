"""Computes triangles in world space: batch by batch, or those with given names.

A vertex is world_from_object . v in float64, and has the same bits however many are computed
together. These vertices *are* the scene: every claim of exactness is about them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Array, Bools, Floats, Index, Integers, Places
from .camera import dual_axes, project
from .vector import Arrays, Vectors, cross, gather, transform_points

if TYPE_CHECKING:
    from ..scene import Mesh, Scene

BATCH = 1 << 14  # triangles in a batch, about: a few milliseconds of work, some MiB


@dataclass(frozen=True, eq=False)
class Batch:
    """The triangles first <= i < last of a mesh, in each of several instances."""

    mesh: int
    instances: Integers
    first: int
    last: int


@dataclass(frozen=True, eq=False)
class WorldTriangles(Arrays):
    """m triangles in world space: `corners` (corner, component, m), instance and triangle, (m,)."""

    corners: Vectors
    instance: Integers
    triangle: Integers

    @property
    def finite(self) -> Bools:
        """Whether all corners are finite, (m,)."""
        return np.isfinite(self.corners).all(axis=(0, 1))

    @staticmethod
    def none() -> WorldTriangles:
        """Return no triangles."""
        return WorldTriangles(np.zeros((3, 3, 0)), np.zeros(0, np.int32), np.zeros(0, np.int32))


@dataclass(frozen=True, eq=False)
class Pairs:
    """p pairs of a pixel and a triangle that may cover it.

    `pixel` (p,) indexes the rays; `row` (p,) the batch's `triangles`.
    """

    pixel: Index
    row: Index
    triangles: WorldTriangles

    @cached_property
    def corners(self) -> Vectors:
        """Corner, component, pair: (3, 3, p), world space."""
        return gather(self.triangles.corners, self.row)

    @property
    def instance(self) -> Integers:
        """The instance of each triangle, (p,)."""
        return self.triangles.instance[self.row]

    @property
    def triangle(self) -> Integers:
        """The number of each triangle in its mesh, (p,)."""
        return self.triangles.triangle[self.row]

    def take(self, index: Index) -> Pairs:
        """Return the pairs at `index`."""
        return Pairs(self.pixel[index], self.row[index], self.triangles)


def batches(scene: Scene) -> Iterator[Batch]:
    """Split the scene's instanced triangles into batches of about BATCH at most.

    Instances come from the bottom of the picture to its top, so that a batch of small instances
    covers few rows.
    """
    groups: dict[int, list[int]] = {}
    for index, instance in enumerate(scene.instances):
        groups.setdefault(instance.mesh, []).append(index)
    for mesh, members in groups.items():
        count = len(scene.meshes[mesh].triangles)
        if not count:
            continue
        positions = np.stack([scene.instances[i].world_from_object[:3, 3] for i in members], axis=1)
        (_, y, depth), _ = project(scene.camera, positions)
        row = y / scene.camera.projection.scale(np.maximum(depth, scene.camera.clip_start))
        ordered = np.array(members, np.int32)[np.argsort(row, kind="stable")]
        together = max(1, BATCH // count)
        for start in range(0, len(ordered), together):
            for first in range(0, count, BATCH):
                some = ordered[start : start + together]
                yield Batch(mesh, some, first, min(first + BATCH, count))


@dataclass(frozen=True, eq=False)
class WorldVertices:
    """The v vertices of a batch in world space, (3, v), and which of them each corner is, (3, m).

    The m triangles are those of the first instance, then of the second, and so on.
    """

    points: Vectors
    corners: Index

    def of_corners(self, values: Array) -> Array:
        """Return for each corner, (3, ..., m), what is known of its vertex, (..., v)."""
        return np.stack([gather(values, corner) for corner in self.corners])


def world_vertices(
    scene: Scene, batch: Batch, dtype: np.dtype[np.floating] | type[float]
) -> WorldVertices:
    """Return a batch's vertices in world space, computed in float64 and then made `dtype`.

    Triangles share vertices: each is computed once, if those of the batch lie together in the mesh.
    """
    mesh = scene.meshes[batch.mesh]
    names = mesh.triangles[batch.first : batch.last].T
    low, end = (np.min(names), np.max(names) + 1) if names.size else (0, 0)
    local = mesh.vertices[low:end]
    corner: Index = names - low
    if len(local) > names.size:
        local = mesh.vertices[names.ravel()]
        corner = np.arange(names.size).reshape(3, -1)
    matrices = scene.instance_matrices[..., batch.instances]
    with np.errstate(over="ignore", invalid="ignore"):  # `refused` tells of what is not finite
        world = transform_points(matrices[..., None], local.T.astype(np.float64)[:, None, :])
        points = world.reshape(3, -1).astype(dtype)
    before = len(local) * np.arange(len(batch.instances))
    return WorldVertices(points, (corner[:, None, :] + before[:, None]).reshape(3, -1))


def world_triangles(
    scene: Scene,
    batch: Batch,
    dtype: np.dtype[np.floating] | type[float],
    vertices: WorldVertices | None = None,
) -> WorldTriangles:
    """Return a batch's triangles in world space, of its `vertices` where they are known already."""
    vertices = vertices or world_vertices(scene, batch, dtype)
    each, copies = batch.last - batch.first, len(batch.instances)
    triangle = np.tile(np.arange(batch.first, batch.last, dtype=np.int32), copies)
    corners = vertices.of_corners(vertices.points)
    return WorldTriangles(corners, np.repeat(batch.instances, each), triangle)


def finite_triangles(scene: Scene) -> WorldTriangles:
    """Return all triangles of a scene that are finite in world space, in float64."""
    every = [world_triangles(scene, batch, np.float64) for batch in batches(scene)]
    found = WorldTriangles.joined([WorldTriangles.none(), *every])
    return found.take(np.flatnonzero(found.finite))


def world_corners(scene: Scene, instance: Index, triangle: Index) -> Floats:
    """Return the corners of named triangles in world space, (corner, component, m) float64."""
    out = np.empty((3, 3, len(instance)))
    with np.errstate(over="ignore", invalid="ignore"):
        for mesh, rows in by_mesh(scene, instance):
            matrices = scene.instance_matrices[..., instance[rows]]
            corners = mesh.triangles.take(triangle[rows], axis=0)
            for corner in range(3):
                local = mesh.vertices.take(corners[:, corner], axis=0).T
                out[corner][:, rows] = transform_points(matrices, local)
    return out


@np.errstate(over="ignore", invalid="ignore")
def planes_of(scene: Scene, instance: Index, triangle: Index) -> tuple[Vectors, Vectors]:
    """Return a point and the textbook's normal of each named surface's plane, (3, n) each."""
    points, normals = np.zeros((2, 3, len(instance)))
    on_mesh = np.flatnonzero(instance < len(scene.instances))
    p1, p2, p3 = world_corners(scene, instance[on_mesh], triangle[on_mesh])
    points[:, on_mesh], normals[:, on_mesh] = p1, cross(p3 - p1, p2 - p1)
    for index, infinite in enumerate(scene.planes, start=len(scene.instances)):
        which = instance == index
        points[:, which], normals[:, which] = infinite.point[:, None], infinite.normal[:, None]
    return points, normals


def by_mesh(scene: Scene, instance: Index) -> Iterator[tuple[Mesh, Places]]:
    """Yield each mesh among instances (n,), which are no planes, with its rows of them."""
    of = scene.instance_meshes[instance]
    for mesh in np.unique(of):
        yield scene.meshes[mesh], np.flatnonzero(of == mesh)


def box_corners(bounds: Floats, world_from_object: Floats) -> Vectors:
    """Return the corners of k boxes in world space, (8, 3, k).

    `bounds` (2, 3, k) has the lowest and the highest corner of each, in its object's space;
    `world_from_object` is (4, 4, k).
    """
    with np.errstate(over="ignore", invalid="ignore"):  # what overflows may be anywhere
        ends = product((0, 1), repeat=3)
        return np.stack([transform_points(world_from_object, bounds[k, range(3)]) for k in ends])


def reaches(scene: Scene) -> Floats:
    """Bound the sums of |terms| of world_from_object . vertex, metres, (3, instances)."""
    reach = np.abs(scene.instance_bounds).max(axis=0)
    m = scene.instance_matrices
    return (np.abs(m[:3, :3]) * reach).sum(axis=1) + np.abs(m[:3, 3])


def depth_ranges(scene: Scene) -> Floats:
    """Return the least and the greatest depth of each instance's box, metres, (2, instances).

    No vertex lies beyond, whatever has been rounded; NaN where a number overflows.
    """
    m, camera = scene.instance_matrices, scene.camera
    low, high = scene.instance_bounds
    axis = dual_axes(camera)[2][:, None]
    with np.errstate(over="ignore", invalid="ignore"):
        row = (axis[..., None] * m[:3, :3]).sum(axis=0)  # of an axis of the object, by its length
        middle = (row * (low + high)).sum(axis=0) / 2
        middle += (axis * (m[:3, 3] - camera.origin[:, None])).sum(axis=0)
        size = (np.abs(row) * (high - low)).sum(axis=0) / 2
        size += 2.0**-40 * (np.abs(axis) * (reaches(scene) + np.abs(camera.origin)[:, None])).sum(
            axis=0
        )
    return np.stack((middle - size, middle + size))


def refused(scene: Scene) -> int:
    """Count the triangles that have a corner which is not finite in world space."""
    m = scene.instance_matrices
    count = 0
    with np.errstate(over="ignore", invalid="ignore"):
        for k in np.flatnonzero(~np.isfinite(reaches(scene)).all(axis=0)).tolist():
            mesh = scene.meshes[scene.instances[k].mesh]
            finite = np.isfinite(transform_points(m[..., k], mesh.vertices.T)).all(axis=0)
            count += int((~finite[mesh.triangles]).any(axis=1).sum())
    return count

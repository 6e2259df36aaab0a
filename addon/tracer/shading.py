"""Constant shading, and the other outputs of a hit: colour, position, normal.

In come `Hits`, for the position with their rays; out go arrays, a row a ray. All of it is float64
whatever the precision of the intersection: it says where the hit was found to be.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..runs import by_runs
from ..scene import Mesh, Scene
from .camera import Rays
from .hits import NOTHING, Hits
from .vector import Index, Vectors, cross, dot, largest
from .world import world_corners


def colors(scene: Scene, hits: Hits) -> NDArray[np.float32]:
    """Return what each ray sees, (n, 4) linear RGBA; alpha is 1 on every surface.

    The colour of a triangle is that of its material slot; where the mesh has corner colours, the
    barycentrics weigh them.
    """
    first, last = scene.color_rows
    row = first[hits.instance]
    if (first != last).any():
        for mesh, pixels in by_mesh(scene, hits.instance):
            slots = mesh.slots.take(hits.triangle[pixels])
            row[pixels] = np.minimum(row[pixels] + slots, last[hits.instance[pixels]])
    out = scene.color_table.take(row, axis=0)
    if any(mesh.corner_colors is not None for mesh in scene.meshes):
        for mesh, pixels in by_mesh(scene, hits.instance):
            if mesh.corner_colors is not None:
                corners = mesh.corner_colors[hits.triangle[pixels]]
                out[pixels] = (corners * hits.s[:, pixels].T[..., None]).sum(axis=1)
                out[pixels, 3] = 1
    return out


def interpolated(scene: Scene, instance: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Return of which instances, planes and NOTHING (...) the colour is one between corners."""
    of = [scene.meshes[i].corner_colors is not None for i in scene.instance_meshes]
    return np.array([*of, *(False for _ in scene.planes), False])[instance]


def normals(scene: Scene, hits: Hits) -> NDArray[np.float64]:
    """Return the geometric unit normal in world space, (n, 3); zero where nothing is hit.

    It is the side that the winding (p2 - p1) x (p3 - p1) names in *object* space: a mirrored
    instance keeps its outside outside. (The textbook's own n is its opposite.)
    """
    return by_runs(partial(_normals, scene), hits.instance, hits.triangle)


def _normals(scene: Scene, instance: Index, triangle: Index) -> NDArray[np.float64]:
    n = np.zeros((3, len(instance)))
    for index, infinite in enumerate(scene.planes, start=len(scene.instances)):
        n[:, instance == index] = infinite.normal[:, None]
    rows = np.flatnonzero((instance != NOTHING) & (instance < len(scene.instances)))
    instance, triangle = instance[rows], triangle[rows]
    p1, p2, p3 = world_corners(scene, instance, triangle) * 2.0**-2  # their differences are finite
    x, y, z = map(near_1, scene.instance_matrices[:3, :3].swapaxes(0, 1))  # where the axes go
    mirrored = (dot(cross(x, y), z) < 0)[instance]
    n[:, rows] = cross(near_1(p2 - p1), near_1(p3 - p1)) * np.where(mirrored, -1, 1)
    n = near_1(n)
    length = np.sqrt(dot(n, n))
    return (n / np.where(length > 0, length, 1)).T


def near_1(v: Vectors) -> Vectors:
    """Return vectors as they are or scaled, so that products neither overflow nor underflow."""
    size = largest(*np.abs(v))
    if (((size > 2.0**-100) & (size < 2.0**100)) | (size == 0)).all():
        return v
    return np.ldexp(v, -np.frexp(size)[1])


def positions(rays: Rays, hits: Hits) -> NDArray[np.float64]:
    """Return where each ray ends in world space, (n, 3) metres; zero where nothing is hit."""
    hit = hits.instance != NOTHING
    points = rays.at(np.where(hit, hits.t, 0.0))
    points[:, ~hit] = 0
    return points.T


def by_mesh(scene: Scene, instance: Index) -> Iterator[tuple[Mesh, NDArray[np.intp]]]:
    """Yield each mesh that instances, planes and NOTHING (n,) show, with its rows of them."""
    on_mesh = np.flatnonzero((instance != NOTHING) & (instance < len(scene.instances)))
    meshes = scene.instance_meshes[instance[on_mesh]]
    if len(meshes) and (meshes == meshes[0]).all():
        yield scene.meshes[meshes[0]], on_mesh
        return
    for index in np.unique(meshes):
        yield scene.meshes[index], on_mesh[meshes == index]

"""Finds the colour, the normal and the position of hits: constant shading.

Everything is computed in float64, also where the intersection was computed in float32.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from ..arrays import Bools, Colors, Floats, Index, Places, by_runs
from ..scene import Mesh, Scene
from . import world
from .camera import Rays
from .hits import NOTHING, Hits
from .vector import Vectors, cross, dot, largest


def colors(scene: Scene, hits: Hits) -> Colors:
    """Return the colour that each of n rays sees, (n, 4) linear RGBA; surfaces have an alpha of 1.

    A triangle has the colour of its material slot. Where its mesh has corner colours, the colour is
    interpolated between them by the barycentrics.
    """
    first, last = scene.color_rows
    row = first.take(hits.instance)
    several = np.flatnonzero((first != last).take(hits.instance))
    for mesh, some in by_mesh(scene, hits.instance[several]):
        pixels = several[some]
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


def interpolated(scene: Scene, instance: Index) -> Bools:
    """Return whether the colour of instances (...) is interpolated; not that of planes, NOTHING."""
    of = [scene.meshes[i].corner_colors is not None for i in scene.instance_meshes]
    return np.array([*of, *(False for _ in scene.planes), False])[instance]


def normals(scene: Scene, hits: Hits) -> Floats:
    """Return the geometric unit normals of n hits, (n, 3), world space; zero for NOTHING.

    A normal points to the side of (p2 - p1) x (p3 - p1) in *object* space, so that mirroring an
    instance does not turn it inside out. (The textbook's own n points the other way.)
    """
    return by_runs(partial(_normals, scene), hits.instance, hits.triangle)


def _normals(scene: Scene, instance: Index, triangle: Index) -> Vectors:
    """Return the unit normals of named triangles, planes and NOTHING, (n, 3)."""
    n = np.zeros((3, len(instance)))
    for index, infinite in enumerate(scene.planes, start=len(scene.instances)):
        n[:, instance == index] = infinite.normal[:, None]
    rows = np.flatnonzero((instance != NOTHING) & (instance < len(scene.instances)))
    of_mesh = instance[rows]
    corners = world.world_corners(scene, of_mesh, triangle[rows])
    p1, p2, p3 = corners * 2.0**-2  # so that their differences are finite
    x, y, z = map(near_1, scene.instance_matrices[:3, :3].swapaxes(0, 1))  # images of the axes
    mirrored = (dot(cross(x, y), z) < 0)[of_mesh]
    n[:, rows] = cross(near_1(p2 - p1), near_1(p3 - p1)) * np.where(mirrored, -1, 1)
    scaled = near_1(n)
    length = np.sqrt(dot(scaled, scaled))
    return (scaled / np.where(length > 0, length, 1)).T


def near_1(v: Vectors) -> Vectors:
    """Return vectors (3, n), scaled by powers of 2: their products neither over- nor underflow."""
    return np.ldexp(v, -np.frexp(largest(*np.abs(v)))[1])


def positions(rays: Rays, hits: Hits) -> Vectors:
    """Return the positions of n hits in world space, (n, 3) metres; zero where nothing is hit."""
    hit = hits.instance != NOTHING
    points = rays.at(np.where(hit, hits.t, 0.0))
    np.copyto(points, 0, where=~hit)
    return points.T


def by_mesh(scene: Scene, instance: Index) -> Iterator[tuple[Mesh, Places]]:
    """Yield each mesh among instances (n,) with its rows of them; no planes, and not NOTHING."""
    on_mesh = np.flatnonzero((instance != NOTHING) & (instance < len(scene.instances)))
    for mesh, rows in world.by_mesh(scene, instance[on_mesh]):
        yield mesh, on_mesh[rows]

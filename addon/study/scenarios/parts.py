"""Builds the parts of the scenarios: cameras, and meshes around or in front of them.

A mesh that rays are to meet at its corners and edges is built from the camera's own rays, as the
tracer stores them (`sheet`).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Index
from ...camera_files.frame import pose
from ...scene import Camera, Instance, Mesh, Scene, ViewWindow
from ...tracer.camera import camera_rays

SEED = 20240611
ORIGIN = np.zeros(3)
UNMOVED = np.eye(4)
Corners = NDArray[np.int32]  # (n, 3): the numbers of n triangles' corners

# An ordinary view: none of its axes is one of the world, so that all numbers have to be rounded.
# Columns are right, up, backward. Times 39 they are integers: what lies in one plane across
# this view can do so exactly.
TURNED_39 = np.array([[13.0, -34.0, -14.0], [26.0, 19.0, -22.0], [26.0, -2.0, 29.0]])
TURNED = TURNED_39 / 39

COLORS = ((0.85, 0.45, 0.15, 1.0), (0.2, 0.5, 0.8, 1.0), (0.5, 0.75, 0.3, 1.0))
NEAR = 4.0  # where a sheet begins, in depth
MARGIN = 2  # lattice cells that a sheet reaches beyond the picture
# Of a pixel: a lattice that is moved by this has no corner, edge or diagonal on a pixel's ray.
BESIDE = (0.37, 0.19)


def generator() -> np.random.Generator:
    """Return random numbers, the same for every scene."""
    return np.random.default_rng(SEED)


def camera(
    width: int,
    height: int,
    half: float = 0.4,
    eye: Floats = ORIGIN,
    axes: Floats = TURNED,
    unit: float = 1.0,
) -> Camera:
    """Return a camera of square pixels, which sees depths from 0.001 to 1000 units.

    Its picture is 2 `half` wide: at depth 1, or in metres once it is orthographic.
    """
    tall = half * height / width
    window = ViewWindow(-half, half, -tall, tall)
    return Camera(
        pose(axes, eye), window, width, height, clip_start=1e-3 * unit, clip_end=1e3 * unit
    )


def sheet(
    view: Camera,
    step: int = 2,
    far: float = 5.0,
    beside: tuple[float, float] = (0.0, 0.0),
    around: bool = True,
) -> Mesh:
    """Return a rough surface before a camera, with a corner on the ray of every `step`-th pixel.

    The corners are fl(o + t d), with t at random between NEAR and `far`. As a straight line is
    straight in a picture, the pixels between meet the edges; with a step of 2, all of them do.
    `beside` is how far the corners are from the rays, in pixels. The surface reaches beyond the
    picture. A fan behind a perspective camera closes it (`around`), so that a ray crosses it once.
    """
    columns, rows = (n // step + 2 * MARGIN for n in (view.width, view.height))
    px, py = (
        0.5 + by + step * (np.arange(n + 1.0) - MARGIN)
        for n, by in zip((columns, rows), beside, strict=True)
    )
    x, y = (v.ravel() for v in np.meshgrid(px, py))
    rays = camera_rays(view, x, y)
    rng = generator()
    t = NEAR * (far / NEAR) ** rng.random(len(x))
    points = rays.at(t).T
    triangles = lattice(columns, rows, rng.integers(0, 2, columns * rows))
    behind = view.origin - 2 * NEAR * view.forward if around else None
    return closed(points, triangles, lattice_rim(columns, rows), behind)


def closed(points: Floats, triangles: Index, rim: Index, apex: Floats | None) -> Mesh:
    """Return a mesh with a fan from its rim, corners in order, to the apex, if there is one."""
    if apex is not None:
        fan = np.stack((rim, np.roll(rim, -1), np.full(len(rim), len(points))), axis=1)
        points = np.concatenate((points, apex[None]))
        triangles = np.concatenate((triangles, fan))
    return Mesh(points, triangles.astype(np.int32), name="Sheet")


def lattice(columns: int, rows: int, split: Index | int = 0) -> Corners:
    """Return triangles of a lattice of cells, each split along one diagonal or the other.

    Its (columns + 1) x (rows + 1) corners are numbered row by row.
    """
    j, i = (v.ravel() for v in np.meshgrid(np.arange(columns), np.arange(rows)))
    a = i * (columns + 1) + j
    b, c, d = a + 1, a + columns + 2, a + columns + 1
    first = np.where(split, (a, b, d), (a, b, c))
    second = np.where(split, (b, c, d), (a, c, d))
    return np.stack((first.T, second.T), axis=1).reshape(-1, 3).astype(np.int32)


def lattice_rim(columns: int, rows: int) -> Index:
    """Return the corners around a lattice, in order."""
    index = np.arange((columns + 1) * (rows + 1)).reshape(rows + 1, columns + 1)
    return np.concatenate((index[0, :-1], index[:-1, -1], index[-1, :0:-1], index[:0:-1, 0]))


def sphere(radius: float = 2.0, rings: int = 12) -> Mesh:
    """Return a closed sphere about the origin, 4 rings (rings - 1) triangles, as Embree's test."""
    theta = np.pi * np.arange(1, rings) / rings
    phi = np.pi * np.arange(2 * rings) / rings
    ring = np.stack((np.cos(phi), np.sin(phi)), axis=-1)
    points = [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
    points += [(*(np.sin(a) * xy), np.cos(a)) for a in theta for xy in ring]
    k = np.arange(2 * rings, dtype=np.int32)
    after = np.roll(k, -1)
    first = range(2, len(points), len(k))  # of each ring
    triangles = [(0 * k, 2 + k, 2 + after)]
    for a, b in pairwise(first):
        triangles += (a + k, b + k, b + after), (a + k, b + after, a + after)
    triangles.append((first[-1] + k, 0 * k + 1, first[-1] + after))
    return Mesh(radius * np.array(points), np.hstack(triangles).T, name="Sphere")


def grid(
    columns: int, rows: int, corner: Floats, across: Floats, along: Floats, split: Index | int = 0
) -> Mesh:
    """Return a flat lattice of cells: its first corner, and what spans the whole of it."""
    v, u = (w.ravel()[:, None] for w in np.mgrid[: rows + 1, : columns + 1])
    points = corner + (u / columns) * across + (v / rows) * along
    return Mesh(points, lattice(columns, rows, split), name="Sheet")


def scene(view: Camera, *meshes: Mesh, matrix: Floats = UNMOVED) -> Scene:
    """Return a scene with an object for each mesh, the first of them moved by a matrix."""
    instances = tuple(
        Instance(k, k, UNMOVED if k else matrix, np.array([COLORS[k % len(COLORS)]], np.float32))
        for k in range(len(meshes))
    )
    background = np.array((0.0, 0.0, 0.0, 1.0), np.float32)
    names = tuple(mesh.name for mesh in meshes)
    return Scene(view, meshes, instances, background=background, objects=names)

"""Meshes for the sample scenes: in come sizes in metres, out come meshes that nothing uses yet."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from math import cos, pi, sin

import bmesh
import bpy
from mathutils import Matrix

from .parts import material


def polygons(
    points: Iterable[Sequence[float]], faces: Iterable[Sequence[int]], colours: Sequence[str] = ()
) -> bpy.types.Mesh:
    """Return a mesh of these faces, each in its own of `colours` where they are given."""
    mesh = bpy.data.meshes.new("Polygons")
    mesh.from_pydata(list(points), [], list(faces))
    used = sorted(set(colours))
    for css in used:
        mesh.materials.append(material(css))
    if colours:
        mesh.polygons.foreach_set("material_index", [used.index(css) for css in colours])
    return mesh


def box(x: float, y: float, z: float) -> bpy.types.Mesh:
    """Return a box of these edge lengths, standing on its origin."""
    corners = [(i * x / 2, j * y / 2, k * z) for k in (0, 1) for j in (-1, 1) for i in (-1, 1)]
    return polygons(
        corners,
        [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)],
    )


def cone(radius: float, top: float, height: float, sides: int = 32) -> bpy.types.Mesh:
    """Return a cone or, with `top` above zero, a frustum or cylinder, standing on its origin."""
    return _from_bmesh(
        lambda bm: bmesh.ops.create_cone(
            bm,
            cap_ends=True,
            segments=sides,
            radius1=radius,
            radius2=top,
            depth=height,
            matrix=Matrix.Translation((0, 0, height / 2)),
        )
    )


def sphere(radius: float, segments: int = 32, rings: int = 16) -> bpy.types.Mesh:
    """Return a sphere of quads about its origin.

    Not by bmesh.ops.create_uvsphere: it merges doubles in an order that changes from run to run.
    """
    points = [(0.0, 0.0, radius)]
    for i in range(1, rings):
        across, z = radius * sin(pi * i / rings), radius * cos(pi * i / rings)
        turns = (2 * pi * k / segments for k in range(segments))
        points += [(across * cos(turn), across * sin(turn), z) for turn in turns]
    points.append((0.0, 0.0, -radius))
    faces = []
    for k in range(segments):
        m = (k + 1) % segments
        faces.append((0, 1 + k, 1 + m))
        for row in range(1, (rings - 2) * segments, segments):
            faces.append((row + k, row + segments + k, row + segments + m, row + m))
        faces.append(
            (len(points) - 1, len(points) - 1 - segments + m, len(points) - 1 - segments + k)
        )
    return polygons(points, faces)


def icosphere(radius: float, subdivisions: int = 1) -> bpy.types.Mesh:
    """Return an icosahedron (1) or a sphere of triangles (2 and more) about its origin."""
    return _from_bmesh(
        lambda bm: bmesh.ops.create_icosphere(bm, subdivisions=subdivisions, radius=radius)
    )


def monkey() -> bpy.types.Mesh:
    """Return Suzanne, who looks along -Y."""
    return _from_bmesh(lambda bm: bmesh.ops.create_monkey(bm))


def torus(radius: float, tube: float, around: int = 48, across: int = 16) -> bpy.types.Mesh:
    """Return a torus about its local Z."""
    points, faces = [], []
    for i in range(around):
        u = 2 * pi * i / around
        for j in range(across):
            v = 2 * pi * j / across
            far = radius + tube * cos(v)
            points.append((far * cos(u), far * sin(u), tube * sin(v)))
            k, m = (i + 1) % around, (j + 1) % across
            faces.append((i * across + j, k * across + j, k * across + m, i * across + m))
    return polygons(points, faces)


def tiles(count: int, size: float, light: str, dark: str) -> bpy.types.Mesh:
    """Return a chessboard of `count` × `count` tiles in two colours about its origin."""
    points = [
        ((i - count / 2) * size, (j - count / 2) * size, 0)
        for j in range(count + 1)
        for i in range(count + 1)
    ]
    cells = [(i, j) for j in range(count) for i in range(count)]
    corner = [j * (count + 1) + i for i, j in cells]
    faces = [(c, c + 1, c + count + 2, c + count + 1) for c in corner]
    return polygons(points, faces, [light if (i + j) % 2 else dark for i, j in cells])


def shifted(mesh: bpy.types.Mesh, by: Sequence[float]) -> bpy.types.Mesh:
    """Return the mesh after moving its vertices."""
    mesh.transform(Matrix.Translation(by))
    return mesh


def lying(mesh: bpy.types.Mesh, at: Sequence[float]) -> bpy.types.Mesh:
    """Return the mesh with its Z laid along -Y and its origin moved to `at`, without rounding."""
    for vertex in mesh.vertices:
        x, y, z = vertex.co
        vertex.co = (at[0] + x, at[1] - z, at[2] + y)
    return mesh


def _from_bmesh(build: Callable[[bmesh.types.BMesh], object]) -> bpy.types.Mesh:
    mesh = bpy.data.meshes.new("Solid")
    bm = bmesh.new()
    build(bm)
    bm.normal_update()
    bm.to_mesh(mesh)
    bm.free()
    return mesh

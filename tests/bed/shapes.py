"""Shapes for the scenes: solids, quads that are not flat, and Catmull-Clark's subdivision."""

from __future__ import annotations

import numpy as np
import trimesh

from .description import Shape

CUBE = np.array(
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
)


def shape(vertices: np.ndarray, faces: np.ndarray) -> Shape:
    """Return a shape, its vertices as Blender stores them."""
    return Shape(np.asarray(vertices, np.float32), np.asarray(faces))


def box(x: float = 1.0, y: float = 1.0, z: float = 1.0) -> Shape:
    """Return a box around the origin of six quads."""
    low = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2
    corners = [np.column_stack((low, np.full(4, height))) for height in (-0.5, 0.5)]
    return shape(np.concatenate(corners) * (x, y, z), CUBE)


def ball(radius: float = 1.0, level: int = 3) -> Shape:
    """Return an icosphere."""
    mesh = trimesh.creation.icosphere(level, radius)
    return shape(mesh.vertices, mesh.faces)


def floor(size: float) -> Shape:
    """Return a square at z = 0."""
    s = size / 2
    return shape(np.array([[-s, -s, 0], [s, -s, 0], [s, s, 0], [-s, s, 0]]), [[0, 1, 2, 3]])


def wrapped(points: np.ndarray) -> Shape:
    """Return quads over points (n, m, 3) of a surface that closes on itself both ways."""
    n, m = points.shape[:2]
    i, j = (a.ravel() for a in np.mgrid[:n, :m])
    corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
    faces = np.stack([(a % n) * m + b % m for a, b in corners], axis=1)
    return shape(points.reshape(-1, 3), faces)


def torus(major: float = 1.0, minor: float = 0.35, n: int = 24, m: int = 12) -> Shape:
    """Return a torus of n x m quads around Z."""
    a, b = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    r = major + minor * np.cos(b)
    return wrapped(np.stack((r * np.cos(a), r * np.sin(a), minor * np.sin(b)), -1))


def saddle(size: float, height: float, n: int = 5, seed: int = 0) -> Shape:
    """Return n x n quads none of which is flat: heights alternate, and vary."""
    steps = np.linspace(-size / 2, size / 2, n + 1)
    x, y = np.meshgrid(steps, steps, indexing="ij")
    sign = (-1.0) ** np.add.outer(np.arange(n + 1), np.arange(n + 1))
    z = height * sign * np.random.default_rng(seed).uniform(0.5, 1.0, sign.shape)
    i, j = (a.ravel() for a in np.mgrid[:n, :n])
    faces = np.stack([i * (n + 1) + j, (i + 1) * (n + 1) + j], axis=1)
    faces = np.concatenate((faces, faces[:, ::-1] + 1), axis=1)
    return shape(np.stack((x, y, z), -1).reshape(-1, 3), faces)


def tower(width: float, heights: int, size: float = 0.5, twist: float = 0.0) -> Shape:
    """Return boxes above one another, as an array modifier makes them."""
    parts, faces = [], []
    one = box(width, width, 0.8 * size)
    for n in range(heights):
        c, s = np.cos(twist * n), np.sin(twist * n)
        turned = one.vertices @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        parts.append(turned + np.array([0, 0, size * (n + 0.5)]))
        faces.append(one.faces + 8 * n)
    return shape(np.concatenate(parts), np.concatenate(faces))


def bent(straight: Shape, angle: float) -> Shape:
    """Return a shape bent about Y: what an armature does to what stands along Z."""
    x, y, z = straight.vertices.astype(np.float64).T
    turn = angle * z
    moved = np.stack((x * np.cos(turn) + z * np.sin(turn), y, z * np.cos(turn) - x * np.sin(turn)))
    return shape(moved.T, straight.faces)


def subdivided(coarse: Shape) -> Shape:
    """Return Catmull and Clark's subdivision of closed quads, once.

    A face's point is its mean; an edge's the mean of its ends and of both faces' points; a corner
    goes to (F + 2 E + (n - 3) P) / n, with the means F of face points and E of edges' middles.
    """
    points, faces = coarse.vertices.astype(np.float64), coarse.faces
    count = len(points)
    middle = points[faces].mean(axis=1)
    ends = np.stack((faces, np.roll(faces, -1, axis=1)), axis=-1)  # (n, 4, 2)
    edges, number = np.unique(np.sort(ends.reshape(-1, 2), axis=1), axis=0, return_inverse=True)
    number = number.reshape(-1, 4)
    beside = np.zeros((len(edges), 3))
    np.add.at(beside, number.ravel(), np.repeat(middle, 4, axis=0))
    of_edges = (points[edges].sum(axis=1) + beside) / 4
    valence = np.bincount(faces.ravel(), minlength=count)[:, None]
    f, e = np.zeros((count, 3)), np.zeros((count, 3))
    np.add.at(f, faces.ravel(), np.repeat(middle, 4, axis=0))
    for side in (0, 1):
        np.add.at(e, edges[:, side], points[edges].mean(axis=1))
    moved = (f / valence + 2 * e / valence + (valence - 3) * points) / valence
    face = count + np.arange(len(faces))[:, None]
    edge = count + len(faces) + number
    quads = np.stack([faces, edge, np.broadcast_to(face, faces.shape), np.roll(edge, 1, 1)], -1)
    return shape(np.concatenate((moved, middle, of_edges)), quads.reshape(-1, 4))


def levels(coarse: Shape, count: int) -> tuple[Shape, ...]:
    """Return a shape at the levels 0 to count - 1 of subdivision."""
    out = [coarse]
    while len(out) < count:
        out.append(subdivided(out[-1]))
    return tuple(out)

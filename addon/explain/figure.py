"""A derivation as shapes in space: the ray, what it was tested with, the hit, the three weights.

In comes a `Derivation`; out go meshes, which Blender draws. Float64 and world space, metres: these
are pictures of the numbers, not the numbers.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .derivation import Derivation, Test
from .textbook import Arithmetic

Rgba = tuple[float, float, float, float]

RAY: Rgba = (1.0, 0.55, 0.0, 1.0)
HIT: Rgba = (1.0, 1.0, 1.0, 1.0)
WEIGHTS: tuple[Rgba, ...] = ((0.9, 0.1, 0.1, 1.0), (0.1, 0.7, 0.15, 1.0), (0.1, 0.25, 0.95, 1.0))
ACCEPTED: Rgba = (0.05, 0.75, 0.85, 1.0)
GLASS: Rgba = (0.05, 0.75, 0.85, 0.25)
REJECTED: Rgba = (0.6, 0.6, 0.6, 1.0)

# Radii as seen from the eye, in lengths at depth 1: a ray is a cone that begins there, so that it
# is equally thin wherever it goes, some pixels wide. And at most so much of the triangle that is
# seen, which they must not hide.
_THIN, _DOT, _SMALL_DOT = 0.0012, 0.004, 0.0025
_OF_TRIANGLE = 0.05
_LIFT = 5e-4  # how far the weights lie before their triangle, for both to be seen
_MARGIN = 0.15  # around what a piece of a plane has to hold
_SIDES = 8
_LENGTH = 20.0  # metres at most, of a ray that meets nothing


class Shape(NamedTuple):
    """A mesh by itself; without faces it is drawn by its edges."""

    name: str
    vertices: NDArray[np.float64]  # (n, 3)
    edges: list[tuple[int, int]]
    faces: list[tuple[int, ...]]
    color: Rgba
    in_front: bool = False  # seen through what is before it


def shapes(derivation: Derivation) -> list[Shape]:
    """Return everything that there is to draw, the ray first."""
    pixel = derivation.pixel
    o, d = pixel.origin, pixel.direction
    end = _end(derivation)
    size = max(abs(end), 1e-30)
    seen = derivation.seen
    extent = np.ptp(seen.points, axis=0).max() if seen and not seen.is_plane else np.inf
    largest = _OF_TRIANGLE * float(extent)
    out = [_cone("Ray", o, d, end, min(_THIN * size, largest / 2), RAY)]
    for number, test in enumerate(derivation.tests, 1):
        t = _t(test)
        is_seen = test.candidate is seen
        near = t is not None and abs(t) <= 3 * size
        if near and is_seen:
            out.append(_dot("Hit", o + t * d, min(_DOT * abs(t), largest), HIT))
            out += _weights(derivation, test, t)
        elif near:
            out.append(_dot(f"2.{number} x", o + t * d, _SMALL_DOT * abs(t), _color(test)))
        x = o + t * d if near else None
        out += _surface(test, f"2.{number}", x, 0.25 * size, -_LIFT / 2 * d if is_seen else None)
    return out


def _end(derivation: Derivation) -> float:
    """Return the t at which the ray's drawing ends: the hit, else a little behind all planes."""
    if derivation.seen:
        return derivation.certified.t
    clip_end = derivation.pixel.camera.clip_end
    found = [t for t in map(_t, derivation.tests) if t is not None and 0 < t <= clip_end]
    return min(clip_end, 1.2 * max(found) if found else _LENGTH)


def _t(test: Test) -> float | None:
    """Return t, None where there is none that float64 holds."""
    t = float(test.number("t", Arithmetic.FLOAT64))
    return t if np.isfinite(t) and any(_normal(test)) else None


def _normal(test: Test) -> tuple[float, ...]:
    n = next(q for q in test.quantities if q.key == "n")
    return tuple(map(float, n.values[Arithmetic.FLOAT64]))


def _color(test: Test) -> Rgba:
    return ACCEPTED if test.verdicts[Arithmetic.EXACT].accepted else REJECTED


def _weights(derivation: Derivation, test: Test, t: float) -> list[Shape]:
    """Return the triangles that x makes with each edge: sᵢ is the share of the one beyond pᵢ."""
    if test.candidate.is_plane:
        return []
    d = derivation.pixel.direction
    corners = test.candidate.points - _LIFT * t * d
    x = derivation.pixel.origin + (1 - _LIFT) * t * d
    out = []
    for k, (color, s) in enumerate(zip(WEIGHTS, derivation.certified.s, strict=True)):
        points = np.stack((x, corners[(k + 1) % 3], corners[(k + 2) % 3]))
        out.append(Shape(f"s{k + 1} = {s:.6g}", points, [], [(0, 1, 2)], color))
    return out


def _surface(
    test: Test, name: str, x: NDArray | None, size: float, lift: NDArray | None
) -> list[Shape]:
    """Return a triangle's outline, and a piece of its plane that holds it and x.

    That of what is seen, which has a lift, is a pane of glass; all others are their edges.
    """
    candidate, color = test.candidate, _color(test)
    points = candidate.points[:1] if candidate.is_plane else candidate.points
    out = []
    if not candidate.is_plane:
        edges = [(0, 1), (1, 2), (2, 0)]
        out.append(Shape(f"{name} {candidate.object}", points, edges, [], color, True))
    if x is not None:
        around = x[None] if candidate.is_plane else np.concatenate((points, x[None]))
        least = size if candidate.is_plane else 0.0
        corners = _piece(np.array(_normal(test)), around, least)
        edges = [(0, 1), (1, 2), (2, 3), (3, 0)]
        title = f"{name} plane of {candidate.object}"
        if lift is None:
            out.append(Shape(title, corners, edges, [], color))
        else:
            out.append(Shape(title, corners + (_t(test) or 0) * lift, [], [(0, 1, 2, 3)], GLASS))
    return out


def _piece(normal: NDArray, points: NDArray, least: float) -> NDArray[np.float64]:
    """Return the corners (4, 3) of a rectangle in a plane around points (n, 3) that lie in it."""
    u, v = _across(normal)
    center = points.mean(axis=0)
    a, b = (points - center) @ u, (points - center) @ v
    pad = max(_MARGIN * max(np.ptp(a), np.ptp(b)), least)
    low, high = (a.min() - pad, b.min() - pad), (a.max() + pad, b.max() + pad)
    return np.array(
        [center + i * u + j * v for i, j in (low, (high[0], low[1]), high, (low[0], high[1]))]
    )


def _across(direction: NDArray) -> tuple[NDArray, NDArray]:
    """Return two unit vectors at right angles to a direction and to one another."""
    direction = direction / np.abs(direction).max()
    least = np.eye(3)[np.abs(direction).argmin()]
    u = np.cross(direction, least)
    v = np.cross(direction, u)
    return u / np.linalg.norm(u), v / np.linalg.norm(v)


def _cone(
    name: str, start: NDArray, along: NDArray, length: float, radius: float, color: Rgba
) -> Shape:
    u, v = _across(along)  # not end - start: at t = 0, or far away, that is zero
    end = start + length * along
    angles = 2 * np.pi * np.arange(_SIDES) / _SIDES
    ring = [end + radius * (np.cos(a) * u + np.sin(a) * v) for a in angles]
    middle = _SIDES + 1  # a line by itself is drawn however thin the cone is
    faces: list[tuple[int, ...]] = [(0, 1 + k, 1 + (k + 1) % _SIDES) for k in range(_SIDES)]
    faces.append(tuple(range(_SIDES, 0, -1)))
    return Shape(name, np.array([start, *ring, end]), [(0, middle)], faces, color, True)


def _dot(name: str, center: NDArray, radius: float, color: Rgba) -> Shape:
    """Return an octahedron."""
    points = center + radius * np.concatenate((np.eye(3), -np.eye(3)))
    faces = [
        (i, j, k) if (i < 3) ^ (j < 3) ^ (k < 3) else (i, k, j)
        for i in (0, 3)
        for j in (1, 4)
        for k in (2, 5)
    ]
    return Shape(name, points, [], faces, color, True)

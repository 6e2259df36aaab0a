"""Shows a derivation as shapes in space: film, ray, what it was tested with, hit, weights.

Blender draws these meshes. They are in float64, world space and metres: pictures of the numbers,
not the numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..arrays import Floats
from ..tracer.camera import pixel_size
from .derivation import Derivation, Test
from .pixel import Pixel
from .textbook import Arithmetic

Rgba = tuple[float, float, float, float]

RAY: Rgba = (1.0, 0.55, 0.0, 1.0)
HIT: Rgba = (1.0, 1.0, 1.0, 1.0)
WEIGHTS: tuple[Rgba, ...] = ((0.9, 0.1, 0.1, 1.0), (0.1, 0.7, 0.15, 1.0), (0.1, 0.25, 0.95, 1.0))
ACCEPTED: Rgba = (0.05, 0.75, 0.85, 1.0)
GLASS: Rgba = (0.05, 0.75, 0.85, 0.25)
REJECTED: Rgba = (0.6, 0.6, 0.6, 1.0)
FILM: Rgba = (0.95, 0.85, 0.3, 1.0)

# Radii as seen from the eye, in lengths at depth 1: a ray is a cone that begins there, so that it
# is equally thin wherever it goes, some pixels wide. And at most so much of the triangle that is
# seen, which they must not hide.
_THIN, _DOT, _SMALL_DOT = 0.0012, 0.004, 0.0025
_OF_TRIANGLE = 0.05
_LIFT = 5e-4  # how far the weights lie before their triangle, for both to be seen
_MARGIN = 0.15  # of a pane, around what it has to hold, in shares of its size
_SIDES = 8  # of the ray's cone
_OUTLINE = [(0, 1), (1, 2), (2, 0)]  # of a triangle
_FRAME = [(0, 1), (1, 2), (2, 3), (3, 0)]  # of a rectangle
_LENGTH = 20.0  # metres at most, of a ray that meets nothing


class Shape(NamedTuple):
    """A mesh by itself; without faces it is drawn by its edges."""

    name: str
    vertices: Floats  # (n, 3)
    edges: Sequence[tuple[int, int]]
    faces: Sequence[tuple[int, ...]]
    color: Rgba
    in_front: bool = False  # seen through what is before it


def shapes(derivation: Derivation) -> list[Shape]:
    """Return everything that there is to draw, the ray first."""
    pixel, seen = derivation.pixel, derivation.seen
    end = _end(derivation)
    size = max(abs(end), 1e-30)
    extent = np.max(np.ptp(seen.points, axis=0)) if seen and not seen.is_plane else np.inf
    largest = _OF_TRIANGLE * float(extent)
    radius = min(_THIN * size, largest / 2)
    out = [_cone(pixel.origin, pixel.direction, end, radius), *_film(pixel)]
    for number, test in enumerate(derivation.tests, 1):
        name, candidate, color = f"2.{number}", test.candidate, _color(test)
        if not candidate.is_plane:
            title = f"{name} {candidate.object}"
            out.append(Shape(title, candidate.points, _OUTLINE, [], color, True))
        t = _t(test)
        if t is None or abs(t) > 3 * size:
            continue
        x = pixel.origin + t * pixel.direction
        pane, title = _pane(test, x, 0.25 * size), f"{name} plane of {candidate.object}"
        if candidate is seen:
            out.append(_dot("Hit", x, min(_DOT * abs(t), largest), HIT))
            out += _weights(derivation, test, t)
            lifted = pane - _LIFT / 2 * t * pixel.direction
            out.append(Shape(title, lifted, [], [(0, 1, 2, 3)], GLASS))
        else:
            out.append(_dot(f"{name} x", x, _SMALL_DOT * abs(t), color))
            out.append(Shape(title, pane, _FRAME, [], color))
    return out


def _film(pixel: Pixel) -> list[Shape]:
    """Return the film, one unit before the eye or where parallel rays begin, and the pixel on it.

    A panorama's film is no plane, and is not drawn.
    """
    camera = pixel.camera
    if not camera.projection.is_linear:
        return []
    depth = 0.0 if camera.projection.shares_direction else 1.0
    middle = camera.origin + depth * camera.forward
    w, (width, height) = camera.window, pixel_size(camera)
    x, y = w.left + pixel.column * width, w.bottom + pixel.row * height
    corners = {
        "Film": ((w.left, w.bottom), (w.right, w.top)),
        "Pixel": ((x, y), (x + width, y + height)),
    }
    out = []
    for name, ((left, bottom), (right, top)) in corners.items():
        at = np.array([(left, bottom), (right, bottom), (right, top), (left, top)])
        points = middle + at @ np.stack((camera.right, camera.up))
        out.append(Shape(name, points, _FRAME, [], FILM, name == "Pixel"))
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
    return t if np.isfinite(t) and _normal(test).any() else None


def _normal(test: Test) -> Floats:
    n = next(q for q in test.quantities if q.key == "n")
    return np.array(n.values[Arithmetic.FLOAT64], np.float64)


def _color(test: Test) -> Rgba:
    return ACCEPTED if test.judgements[Arithmetic.EXACT].accepted else REJECTED


def _weights(derivation: Derivation, test: Test, t: float) -> list[Shape]:
    """Return the triangles that x makes with each edge: sᵢ is the share of the one beyond pᵢ."""
    if test.candidate.is_plane:
        return []
    direction = derivation.pixel.direction
    corners = test.candidate.points - _LIFT * t * direction
    x = derivation.pixel.origin + (1 - _LIFT) * t * direction
    out = []
    for k, (color, s) in enumerate(zip(WEIGHTS, derivation.certified.s, strict=True)):
        points = np.stack((x, corners[(k + 1) % 3], corners[(k + 2) % 3]))
        out.append(Shape(f"s{k + 1} = {s:.6g}", points, [], [(0, 1, 2)], color))
    return out


def _pane(test: Test, x: Floats, least: float) -> Floats:
    """Return the corners (4, 3) of a rectangle in a candidate's plane that holds it and x."""
    points = x[None]
    if not test.candidate.is_plane:
        points, least = np.concatenate((test.candidate.points, points)), 0.0
    center = points.mean(axis=0)
    axes = np.stack(_across(_normal(test)))
    places = (points - center) @ axes.T
    low, high = places.min(axis=0), places.max(axis=0)
    pad = max(_MARGIN * np.max(high - low), least)
    (left, bottom), (right, top) = low - pad, high + pad
    rectangle = [(left, bottom), (right, bottom), (right, top), (left, top)]
    return np.asarray(center + np.array(rectangle) @ axes)


def _across(direction: Floats) -> tuple[Floats, Floats]:
    """Return two unit vectors at right angles to a direction and to one another."""
    direction = direction / np.max(np.abs(direction))
    least = np.eye(3)[np.argmin(np.abs(direction))]
    u = np.cross(direction, least)
    v = np.cross(direction, u)
    return u / np.linalg.norm(u), v / np.linalg.norm(v)


def _cone(start: Floats, along: Floats, length: float, radius: float) -> Shape:
    u, v = _across(along)  # not end - start: at t = 0, or far away, that is zero
    end = start + length * along
    angles = 2 * np.pi * np.arange(_SIDES) / _SIDES
    ring = [end + radius * (np.cos(a) * u + np.sin(a) * v) for a in angles]
    middle = _SIDES + 1  # a line by itself is drawn however thin the cone is
    faces: list[tuple[int, ...]] = [(0, 1 + k, 1 + (k + 1) % _SIDES) for k in range(_SIDES)]
    faces.append(tuple(range(_SIDES, 0, -1)))
    return Shape("Ray", np.array([start, *ring, end]), [(0, middle)], faces, RAY, True)


def _dot(name: str, center: Floats, radius: float, color: Rgba) -> Shape:
    """Return an octahedron."""
    points = center + radius * np.concatenate((np.eye(3), -np.eye(3)))
    faces = [
        (i, j, k) if (i < 3) ^ (j < 3) ^ (k < 3) else (i, k, j)
        for i in (0, 3)
        for j in (1, 4)
        for k in (2, 5)
    ]
    return Shape(name, points, [], faces, color, True)

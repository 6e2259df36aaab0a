"""Shows a derivation as shapes in space: film, ray, what it was tested with, hit, weights.

Blender draws these meshes. They are in float64, world space and metres: pictures of the numbers,
not the numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Floats
from ..tracer.camera import camera_rays
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
        name, candidate = f"2.{number}", test.candidate
        color = ACCEPTED if test.judgements[Arithmetic.EXACT].accepted else REJECTED
        if not candidate.is_plane:
            title = f"{name} {candidate.object}"
            out.append(Shape(title, candidate.points, _OUTLINE, [], color, True))
        t = _t(test)
        if t is None or abs(t) > 3 * size:
            continue
        x = pixel.origin + t * pixel.direction
        pane, title = _pane(test, x, 0.25 * size), f"{name} plane of {candidate.object}"
        if candidate is seen:
            lift = -_LIFT * t * pixel.direction
            out.append(_dot("Hit", x, min(_DOT * abs(t), largest), HIT))
            if not candidate.is_plane:
                out += _weights(candidate.points + lift, x + lift, derivation.certified.s)
            out.append(Shape(title, pane + lift / 2, [], [(0, 1, 2, 3)], GLASS))
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
    depth = np.array(0.0 if camera.projection.shares_direction else 1.0)

    def frame(x: int, y: int, width: int, height: int) -> Floats:
        corners = np.add((x, y), [(0, 0), (width, 0), (width, height), (0, height)])
        return camera_rays(camera, *corners.T).at(depth).T

    film = frame(0, 0, camera.width, camera.height)
    own = frame(pixel.column, pixel.row, 1, 1)
    return [Shape("Film", film, _FRAME, [], FILM), Shape("Pixel", own, _FRAME, [], FILM, True)]


def _rectangle(origin: Floats, axes: Floats, low: ArrayLike, high: ArrayLike) -> Floats:
    """Return the corners (4, 3) of a rectangle along two axes (2, 3), between (2,) low and high."""
    (left, bottom), (right, top) = np.asarray(low), np.asarray(high)
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    return origin + np.array(corners) @ axes


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


def _weights(corners: Floats, x: Floats, s: Floats) -> list[Shape]:
    """Return the triangles that x makes with each edge: sᵢ is the share of the one beyond pᵢ."""
    out = []
    for k, color in enumerate(WEIGHTS):
        points = np.stack((x, corners[k - 2], corners[k - 1]))
        out.append(Shape(f"s{k + 1} = {s[k]:.6g}", points, [], [(0, 1, 2)], color))
    return out


def _pane(test: Test, x: Floats, least: float) -> Floats:
    """Return the corners (4, 3) of a rectangle in a candidate's plane that holds it and x."""
    points = np.array([x] if test.candidate.is_plane else [*test.candidate.points, x])
    center = points.mean(axis=0)
    axes = _across(_normal(test))
    places = (points - center) @ axes.T
    low, high = places.min(axis=0), places.max(axis=0)
    pad = _MARGIN * np.max(high - low) or least
    return _rectangle(center, axes, low - pad, high + pad)


def _across(direction: Floats) -> Floats:
    """Return two unit vectors (2, 3) at right angles to a direction and to one another."""
    direction = direction / np.max(np.abs(direction))
    least = np.eye(3)[np.argmin(np.abs(direction))]
    u = np.cross(direction, least)
    axes = np.stack((u, np.cross(direction, u)))
    return axes / np.linalg.norm(axes, axis=1, keepdims=True)


def _cone(start: Floats, along: Floats, length: float, radius: float) -> Shape:
    axes = _across(along)  # not end - start: at t = 0, or far away, that is zero
    end = start + length * along
    angles = 2 * np.pi * np.arange(_SIDES) / _SIDES
    ring = end + radius * np.stack((np.cos(angles), np.sin(angles)), axis=1) @ axes
    middle = _SIDES + 1  # a line by itself is drawn however thin the cone is
    faces: list[tuple[int, ...]] = [(0, 1 + k, 1 + (k + 1) % _SIDES) for k in range(_SIDES)]
    faces.append(tuple(range(_SIDES, 0, -1)))
    return Shape("Ray", np.array([start, *ring, end]), [(0, middle)], faces, RAY, True)


def _dot(name: str, center: Floats, radius: float, color: Rgba) -> Shape:
    """Return an octahedron."""
    points = center + radius * np.concatenate((np.eye(3), -np.eye(3)))
    return Shape(name, points, [], [*product((0, 3), (1, 4), (2, 5))], color, True)

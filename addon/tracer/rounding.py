"""t = T / D, rounded to the nearest float64.

With twice the digits (`double_double.py`) the same bound as in `bounds.py` holds, with that
arithmetic's error in place of 2^-53: in almost every case it leaves a single float64 to round to.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import double_double as dd
from .bounds import BOUND, SLACK, U, cross_magnitude
from .camera import Rays
from .vector import Vectors, dot

_BOUND = BOUND / U * dd.ERROR
_LOOSE = 1 + 2.0**-48  # the bound's own few roundings
_CHUNK = 1 << 13  # rays at a time: their temporaries stay in a core's cache

Floats = NDArray[np.float64]
Doubles = tuple[Vectors, Vectors]  # high and low, (3, m) each


def triangle_normals(corners: NDArray[np.float64]) -> tuple[Doubles, Vectors]:
    """Return n = (b - a) x (c - a) of triangles (3, 3, m), and the magnitude of its terms."""
    a, b, c = corners
    u, v = dd.two_sum(b, -a), dd.two_sum(c, -a)
    n = [
        dd.add(
            dd.multiply(_component(u, i), _component(v, j)),
            dd.negative(dd.multiply(_component(u, j), _component(v, i))),
        )
        for i, j in ((1, 2), (2, 0), (0, 1))
    ]
    high, low = (np.stack(part) for part in zip(*n, strict=True))
    return (high, low), cross_magnitude(np.abs(u[0]), np.abs(v[0]))


def round_t(
    rays: Rays, surface: NDArray[np.intp], point: Vectors, normal: Doubles, size: Vectors
) -> tuple[Floats, NDArray[np.bool_]]:
    """Return t of p rays with the planes of surfaces, and whether it surely is the nearest float64.

    Parameters
    ----------
    rays : Rays
        p rays.
    surface : (p,) int
        Which of the m surfaces each ray meets.
    point : (3, m) float64
        A point of each surface's plane.
    normal, size
        As :func:`triangle_normals` returns them.
    """
    t, sure = np.empty(len(surface)), np.empty(len(surface), bool)
    shared = None
    with np.errstate(all="ignore"):  # what overflows is not sure
        if rays.origins.shape[1] == 1:
            shared = np.stack(_depth(rays.origins, point, normal, size))
        for start in range(0, len(surface), _CHUNK):
            part = slice(start, start + _CHUNK)
            rows = surface[part]
            some = rays.take(np.arange(len(surface))[part])
            n = normal[0].take(rows, axis=1), normal[1].take(rows, axis=1)
            magnitude = size.take(rows, axis=1)
            if shared is None:
                depth = _depth(some.origins, point.take(rows, axis=1), n, magnitude)
            else:
                depth = shared.take(rows, axis=1)
            t[part], sure[part] = _quotient(depth, _towards(some.directions, n, magnitude))
    return t, sure


def _depth(origins: Vectors, point: Vectors, normal: Doubles, size: Vectors) -> tuple[Floats, ...]:
    """Return T = (p - o) . n as high, low and error."""
    arm = dd.two_sum(point, -origins)
    terms = [dd.multiply(_component(arm, k), _component(normal, k)) for k in range(3)]
    return (*_sum(terms), _error(np.abs(arm[0]), size))


def _towards(directions: Vectors, normal: Doubles, size: Vectors) -> tuple[Floats, ...]:
    """Return D = d . n as high, low and error."""
    terms = [dd.scale(_component(normal, k), directions[k]) for k in range(3)]
    return (*_sum(terms), _error(np.abs(directions), size))


def _quotient(depth, towards) -> tuple[Floats, NDArray[np.bool_]]:
    """Return T / D as a float64, and whether no other is as near (Ziv's test)."""
    *over, depth_error = depth
    *under, towards_error = towards
    t, rest = dd.divide(tuple(over), tuple(under))
    size = np.abs(under[0]) * (1 - 2 * U)
    error = (np.abs(t) * towards_error + depth_error) / (size - towards_error)
    error = (error + 2 * dd.ERROR * np.abs(t)) * _LOOSE + SLACK
    sure = (size > towards_error) & (t + (rest + error) == t) & (t + (rest - error) == t)
    return t, sure


def _error(w: Vectors, size: Vectors) -> Floats:
    return _BOUND * dot(w, size) + SLACK * (1 + w[0] + w[1] + w[2])


def _sum(terms: list[dd.Pair]) -> dd.Pair:
    return dd.add(dd.add(terms[0], terms[1]), terms[2])


def _component(x: Doubles, k: int) -> dd.Pair:
    return x[0][k], x[1][k]

"""Triangle set-up: triangles as linear functions of the pixel, with their rounding errors.

With the corners a, b, c on the film in homogeneous pixels (`film.py`), and for the ray of a pixel

    e_bc = det[b, c, ray],  e_ca = det[c, a, ray],  e_ab = det[a, b, ray],   T = det[a, b, c],

the ray meets the triangle in front of the eye where each e has the sign of T; and

    1 / t = (e_bc + e_ca + e_ab) / T                                   perspective
        t = (e_bc t_a + e_ca t_b + e_ab t_c) / T                       orthographic.

All are linear in the pixel: a + b y + c x. The nearness, 1 / t or -t, grows towards the eye. Every
function has a bound on its rounding error. The stored ray of a pixel that is inside all edges by
more than that surely meets the triangle.

The bounds. A corner is off by place = c0 + c1 size in p and q, and by weight in w. L and W are the
largest of |p|, |q| and of |w| plus those errors, relative to the pixel in which the triangle's box
begins. R is the largest distance from there to a pixel of the box.

    e: 4 R (place W + L weight) + 4 place L      from the errors of the corners
       + 8 u (4 R L W + 2 L L)                   at most five roundings of each term
    T: 6 L (2 place W + L weight) + 50 u L L W   likewise: 6 terms, at most six roundings

All floats depend on the triangle, the pixel and the whole picture alone, and so not on how the
picture is divided.

References: Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", Graphics
Hardware 1997, for the functions. Theorems: `EdgeFunctions.edge_bound`, `SweepCode`, `SweepDoubt`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Index
from ...tracer.vector import Arrays, gather, largest
from ..bounds import U
from .film import Film
from .vertices import Vertices

_MORE = 1.01  # covers the roundings of the bounds themselves
# Far above what gradual underflow may lose, and far below where it matters: values as small as this
# are decided elsewhere.
_TINY = 2.0**-1000
_HUGE = 2.0**1000  # a smaller value has not overflown

Orientation = tuple[Floats, Floats, Floats]  # |T|, the bound on its error, that of the edges


@dataclass(frozen=True, eq=False)
class EdgeFunctions(Arrays):
    """m triangles as functions of the pixel.

    `coefficients` (3, 4, m) are those of 1, y and x, relative to the pixel `origin` (2, m), of the
    edges bc, ca, ab and of the nearness. `edge_error` (m,) bounds the error of an edge function.
    `nearness_error` (m,) bounds the error of the nearness beyond the clip start, and `nearest` (m,)
    bounds the nearness itself from above.
    `row` (m,) is the number of the triangle. `sure` (m,) is False where the sign of T is not known.
    Such a triangle comes twice, once for each sign: its functions tell misses, but no hits.
    """

    row: Index
    origin: Index
    coefficients: Floats
    edge_error: Floats
    nearness_error: Floats
    nearest: Floats
    sure: Bools


def set_up(
    film: Film, vertices: Vertices, corners: Index, nearest: Floats, origin: Index, reach: Floats
) -> EdgeFunctions:
    """Compute the functions of m triangles, and bound their errors.

    Parameters
    ----------
    film : Film
    vertices : Vertices
    corners : (3, m) int
        The triangles' vertices.
    nearest : (m,) float64
        Bounds each triangle's nearness from above.
    origin : (2, m) int
        The pixel, x and y, that each triangle's functions are relative to.
    reach : (m,) float64
        How far from there they are evaluated, in pixels along either axis.
    """
    corners = corners.astype(np.intp)  # once, not for every array
    p, q, w = _relative(vertices, corners, origin)
    size = largest(*(gather(vertices.size, corner) for corner in corners))
    coefficients = np.empty((3, 4, len(size)))
    of_1, of_y, of_x = coefficients
    for k, (a, b) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(q[a] * w[b], w[a] * q[b], out=of_x[k])
        np.subtract(w[a] * p[b], p[a] * w[b], out=of_y[k])
        np.subtract(p[a] * q[b], q[a] * p[b], out=of_1[k])
    volume = p[0] * of_x[0] + q[0] * of_y[0] + w[0] * of_1[0]  # T
    edge_error, error, terms = _errors(film, (*p, *q), w, size, reach)

    amount = np.abs(volume)
    sure = (amount > error) & np.isfinite(amount)
    coefficients[:, :3] *= np.where(volume < 0, -1.0, 1.0)
    orientation = amount, error, edge_error
    if film.camera.projection.shares_direction:
        depths = [gather(vertices.depth, corner) for corner in corners]
        nearness_error, largest_depth = _parallel(film, coefficients, orientation, depths, size)
        terms = terms * largest_depth
    else:
        nearness_error = _perspective(film, coefficients, orientation, nearest)
    nearness_error *= _MORE
    lost = ~(terms < _HUGE)
    if lost.any():  # any pixel may be covered
        coefficients[:, :, lost] = 0
        edge_error[lost] = np.inf
        sure[lost] = False
    every = np.arange(len(size))
    out = EdgeFunctions(every, origin, coefficients, edge_error, nearness_error, nearest, sure)
    unsure = np.flatnonzero(~sure)
    return _with_both_signs(out, unsure) if len(unsure) else out


def _relative(
    vertices: Vertices, corners: Index, origin: Index
) -> tuple[list[Floats], list[Floats], list[Floats]]:
    """Return p, q and w of the corners of triangles, relative to their pixels `origin`."""
    x0, y0 = origin + 0.5
    p = []
    q = []
    w = []
    for corner in corners:
        weight = gather(vertices.w, corner)
        p.append(gather(vertices.p, corner) - x0 * weight)
        q.append(gather(vertices.q, corner) - y0 * weight)
        w.append(weight)
    return p, q, w


def _errors(
    film: Film, across: Sequence[Floats], w: Sequence[Floats], size: Floats, reach: Floats
) -> tuple[Floats, Floats, Floats]:
    """Bound the errors of edge functions and T, and the terms of edges; `across` is p and q."""
    constant, slope = film.place
    place = constant + slope * size
    weight = film.weight * size
    far = largest(*map(np.abs, across)) + place  # L
    high = largest(*map(np.abs, w)) + weight  # W
    edge_error = 4 * reach * (place * high + far * weight) + 4 * far * place
    terms = far * (4 * reach * high + 2 * far)
    edge_error += 8 * U * terms
    edge_error = _MORE * edge_error + _TINY
    error = 6 * far * (2 * place * high + far * weight) + 50 * U * far * far * high
    error = _MORE * error + _TINY
    return edge_error, error, terms


def _perspective(
    film: Film, coefficients: Floats, orientation: Orientation, nearest: Floats
) -> Floats:
    """Fill in the nearness 1 / t of triangles; returns the bound on its error."""
    amount, error, edge_error = orientation
    for function in coefficients:
        np.divide(function[0] + function[1] + function[2], amount, out=function[3])
    least = amount - error
    relative = error / least + (2 * film.ray_error + 16 * U)
    return 6 * edge_error / least + relative * nearest


def _parallel(
    film: Film, coefficients: Floats, orientation: Orientation, depths: list[Floats], size: Floats
) -> tuple[Floats, Floats]:
    """Fill in the nearness -t of triangles; returns the bound on its error.

    And the largest of what the nearness is computed from, and 1.
    """
    amount, error, edge_error = orientation
    base = depths[0]
    b = depths[1] - base
    c = depths[2] - base
    for function in coefficients:
        np.divide(function[1] * b + function[2] * c, -amount, out=function[3])
    coefficients[0, 3] -= base
    constant, slope = film.depth_error
    own = constant + slope * size
    apart = largest(np.abs(b), np.abs(c))
    nearness_error = 6 * (edge_error + error) / (amount - error) * (apart + 2 * own)
    nearness_error += 4 * own
    return nearness_error, np.maximum(largest(*map(np.abs, (*depths, b, c))), 1.0)


def _with_both_signs(found: EdgeFunctions, unsure: Index) -> EdgeFunctions:
    """Duplicate the triangles of uncertain orientation, once for each sign of T.

    Nothing is known of their nearness.
    """
    found.coefficients[:, 3, unsure] = 0
    found.nearness_error[unsure] = np.inf
    out = found.take(np.r_[found.row, unsure])
    out.coefficients[:, :3, len(found) :] *= -1
    return out

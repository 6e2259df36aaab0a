"""Triangles as functions of the pixel, which decide most of what a camera's rays meet.

With the corners a, b, c on the film in homogeneous pixels (`film.py`), and for the ray of a pixel

    e_bc = det[b, c, ray],  e_ca = det[c, a, ray],  e_ab = det[a, b, ray],   T = det[a, b, c],

the ray meets the triangle before the eye where each e has the sign of T; and

    1 / t = (e_bc + e_ca + e_ab) / T                                   perspective
        t = (e_bc t_a + e_ca t_b + e_ab t_c) / T                       orthographic.

All are linear in the pixel: a + b y + c x. `nearness`, 1 / t or -t, grows towards the eye. With
every function comes the bound on what rounding has done to it, so that a pixel which is inside all
edges by more than that is hit by the ray itself, as it is stored.

The bounds. A corner is off by place = c0 + c1 size in p and q, by weight in w, and L, W are the
largest of |p|, |q| and of |w|, with those errors, relative to the pixel in which the triangle's box
begins; R is the largest distance from there to a pixel of the box.

    e: 4 R (place W + L weight) + 4 place L      what the errors of the corners move
       + 8 u (4 R L W + 2 L L)                   at most five roundings of each term
    T: 6 L (2 place W + L weight) + 50 u L L W   likewise: 6 terms, at most six roundings

The same floats come out however a picture is divided, as they depend on the triangle, the pixel and
the whole picture alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...tracer.vector import Arrays, Floats, Index, gather, largest
from ..bounds import U
from .film import Film, Vertices

_MORE = 1.01  # for the roundings of the bounds themselves
# Far above what gradual underflow may lose, far below where it matters: what is as small as this is
# decided elsewhere.
_TINY = 2.0**-1000
_HUGE = 2.0**1000  # nothing that is smaller than this has overflown


@dataclass(frozen=True, eq=False)
class EdgeFunctions(Arrays):
    """m triangles as functions of the pixel.

    `coefficients` (3, 4, m): of 1, y and x, from the pixel `origin` (2, m) on, for the three edges,
    opposite of the corners a, b, c, and for the nearness. `edge_error` (m,) bounds the error of an
    edge, `nearness_error` (m,) that of the nearness of what lies beyond the clip start; that is
    at most `nearest` (m,).
    `row` (m,) says whose each is; `sure` (m,) is False where the sign of T is not known: then
    there are two, one for each sign, which tell what is missed, but not what is hit.
    """

    row: Index
    origin: Index
    coefficients: NDArray[np.float64]
    edge_error: Floats
    nearness_error: Floats
    nearest: Floats
    sure: NDArray[np.bool_]


def set_up(
    film: Film, vertices: Vertices, corners: Index, nearest: Floats, origin: Index, reach: Floats
) -> EdgeFunctions:
    """Return the functions of triangles.

    Parameters
    ----------
    corners : (3, m) int
        Their vertices.
    nearest : (m,) float64
        The most that the nearness of each can be.
    origin : (2, m) int
        Pixels, x and y, from which the functions count.
    reach : (m,) int
        How far from there they are asked for, in pixels, along either axis.
    """
    x0, y0 = origin + 0.5
    p, q, w = [], [], []
    corners = corners.astype(np.intp)  # once, not for every array
    for corner in corners:
        weight = gather(vertices.w, corner)
        p.append(gather(vertices.p, corner) - x0 * weight)
        q.append(gather(vertices.q, corner) - y0 * weight)
        w.append(weight)
    size = largest(*(gather(vertices.size, corner) for corner in corners))
    of_1, of_y, of_x = coefficients = np.empty((3, 4, len(size)))
    for k, (a, b) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(q[a] * w[b], w[a] * q[b], out=of_x[k])
        np.subtract(w[a] * p[b], p[a] * w[b], out=of_y[k])
        np.subtract(p[a] * q[b], q[a] * p[b], out=of_1[k])
    volume = p[0] * of_x[0] + q[0] * of_y[0] + w[0] * of_1[0]

    constant, slope = film.place
    place, weight = constant + slope * size, film.weight * size
    far = largest(*map(np.abs, (*p, *q))) + place
    high = largest(*map(np.abs, w)) + weight
    edge_error = 4 * reach * (place * high + far * weight) + 4 * far * place
    terms = far * (4 * reach * high + 2 * far)
    edge_error += 8 * U * terms
    edge_error = _MORE * edge_error + _TINY
    error = 6 * far * (2 * place * high + far * weight) + 50 * U * far * far * high
    error = _MORE * error + _TINY

    amount = np.abs(volume)
    sure = (amount > error) & np.isfinite(amount)
    coefficients[:, :3] *= np.where(volume < 0, -1.0, 1.0)
    least = amount - error
    if film.camera.projection.shares_direction:
        depths = [gather(vertices.depth, corner) for corner in corners]
        base, *rest = depths
        b, c = (d - base for d in rest)
        terms = terms * largest(*map(np.abs, (*depths, b, c)), 1.0)  # what the nearness is made of
        for function in coefficients:
            np.divide(function[1] * b + function[2] * c, -amount, out=function[3])
        of_1[3] -= base
        constant, slope = film.depth_error
        own = constant + slope * size
        nearness_error = (
            6 * (edge_error + error) / least * (largest(np.abs(b), np.abs(c)) + 2 * own)
        )
        nearness_error += 4 * own
    else:
        for function in coefficients:
            np.divide(function[0] + function[1] + function[2], amount, out=function[3])
        relative = error / least + (2 * film.ray_error + 16 * U)
        nearness_error = 6 * edge_error / least + relative * nearest
    nearness_error *= _MORE
    lost = ~(terms < _HUGE)
    if lost.any():  # any pixel may be covered
        coefficients[:, :, lost], edge_error[lost], sure[lost] = 0, np.inf, False
    every = np.arange(len(size))
    out = EdgeFunctions(every, origin, coefficients, edge_error, nearness_error, nearest, sure)
    unsure = np.flatnonzero(~sure)
    if len(unsure):  # they come twice, once for each sign of T
        coefficients[:, 3, unsure], nearness_error[unsure] = 0, np.inf
        out = out.take(np.r_[every, unsure])
        out.coefficients[:, :3, len(every) :] *= -1
    return out

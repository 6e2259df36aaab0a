"""Intersects many pairs of a ray and a surface in integers: those that miss, all at once.

Most pairs that floats leave open miss their triangle: two of the edge functions `e` of `exact.py`
have opposite signs. Where rays share their origin, or their direction, e is linear in what they do
not share, with integers as coefficients that belong to the triangle alone:

    e_ab = d . m_ab                                        one origin
    e_ab = A . w - o . w,  w = (B - A) x d                 one direction; A, B are not relative to o

Theorems: `IntegersCode.many_from_point_is`, `.many_parallel_is`, `.many_hits_are`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..arrays import Array, Bools, Index
from ..tracer.vector import cross, dot
from .exact import Hit, IntegerBatch


def hits(batch: IntegerBatch, ray: Index, surface: Index) -> list[Hit | None]:
    """Return what `batch.hit` says of c pairs, (c,) each, in less time."""
    found: list[Hit | None] = [None] * len(ray)
    for k in np.flatnonzero(~_miss(batch, ray, surface)).tolist():
        found[k] = batch.hit(ray.item(k), surface.item(k))
    return found


def _miss(batch: IntegerBatch, ray: Index, surface: Index) -> Bools:
    """Return which of c pairs certainly miss: False for planes, and rays that share nothing."""
    out = np.zeros(len(ray), bool)
    planes = len(batch.planes)
    some = np.flatnonzero(surface >= planes)
    o, d = _columns(batch.origins), _columns(batch.directions)
    corners = [_columns(each) for each in batch.corners]
    number, of_ray = surface[some] - planes, ray[some]
    if o.shape[1] == 1:
        v, corners = d.take(of_ray, axis=1), [each - o for each in corners]
        forms = [(np.zeros(a.shape[1], object), cross(a, b)) for a, b in _edges(corners)]
    elif d.shape[1] == 1:
        v, normals = -o.take(of_ray, axis=1), [(a, cross(b - a, d)) for a, b in _edges(corners)]
        forms = [(dot(a, w), w) for a, w in normals]
    else:
        return out
    low, high = np.zeros((2, len(some)), bool)
    for base, w in forms:
        e = base.take(number) + dot(v, w.take(number, axis=1))
        low |= e < 0
        high |= e > 0
    out[some] = low & high
    return out


def _edges(corners: list[Array]) -> list[tuple[Array, Array]]:
    """Return the ends of the edges ab, bc and ca."""
    a, b, c = corners
    return [(a, b), (b, c), (c, a)]


def _columns(triples: Sequence[object]) -> Array:
    """Return n triples of integers as (3, n), dtype object."""
    return np.array(triples, object).reshape(-1, 3).T

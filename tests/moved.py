"""What the oracle leaves open: what rays see that are moved infinitesimally, to whichever side."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import combinations, product

from reference_tracer.tracer.hits import NOWHERE
from reference_tracer.tracer.ties import Name

from .moved_rays import (
    Surface,
    Vector,
    cross,
    dot,
    in_integers,
    move,
    nearest_of_moved,
    sub,
)
from .oracle import Sight


def touched(sight: Sight) -> frozenset[Name]:
    """Return the names of `front`, and NOWHERE if the ray may pass all of it."""
    return frozenset(s.name for s in sight.front) | (set() if sight.covered else {NOWHERE})


@lru_cache
def may(sight: Sight) -> frozenset[Name]:
    """Return what any ray sees that is infinitesimally moved, to whichever side."""
    if len(touched(sight)) == 1:
        return touched(sight)
    o, d, surfaces = in_integers(sight.origin, sight.direction, sight.front)
    found = {sight.seen}
    for normal in turning_planes(o, d, surfaces):
        along = cross(normal, d)  # d moved along it stays on the boundary; `normal` leaves it
        for s, r in product((1, -1), repeat=2):
            beside = [s * x for x in along], [r * x for x in normal]
            by = (move([0, 0, 0], beside, beside),)  # one way: o, if it moves, goes with d
            found.add(nearest_of_moved(o, d, surfaces, by))
    return frozenset(found)


def turning_planes(o: Vector, d: Vector, surfaces: Sequence[Surface]) -> set[tuple[int, ...]]:
    """Return normals of all planes through the ray at which what it sees may change.

    They are those through an edge that the ray meets, and those through the line in which two
    surfaces meet that it meets at once.
    """
    found: set[tuple[int, ...]] = set()
    for surface in surfaces:
        corners = surface.points if surface.own_normal is None else ()
        for k in range(len(corners)):
            a, b = sub(corners[k - 1], o), sub(corners[k], o)
            m = cross(a, b)
            if dot(d, m) == 0:
                found.add(tuple(m if any(m) else cross(sub(b, a), d)))
    levels = [(dot(sub(s.points[0], o), s.normal), s.normal) for s in surfaces]
    for (depth1, n1), (depth2, n2) in combinations(levels, 2):
        w = [depth1 * b - depth2 * a for a, b in zip(n1, n2, strict=True)]
        if dot(d, w) == 0:
            found.add(tuple(w if any(w) or depth1 else cross(cross(n1, n2), d)))
    return {m for m in found if any(m)}

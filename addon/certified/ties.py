"""What one ray sees of all that it meets; and what else it may be said to see, where that is open.

In come exact hits, in integers (`exact.py`); out goes the nearest by the rule, and the ties.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cmp_to_key
from math import gcd

from ..tracer.hits import NOWHERE, Name
from .exact import PERTURBATION, Hit, Moves, crossing, gap, sign_of_difference, turning
from .integers import Integers


def seen_and_ties(hits: Sequence[tuple[Name, Hit]]) -> tuple[int, frozenset[Name]]:
    """Return which of these hits of one ray is seen, and whatever else may be.

    Returns
    -------
    seen : int
        Index of the one that the rule sees; -1 for nothing.
    ties : frozenset of names
        Where the ray as it is meets an edge, a corner, or two surfaces at once before anything
        else, all that one moved infinitesimally may see, NOWHERE for nothing; empty where the
        answer is the only one.
    """
    seen = _first(hits, PERTURBATION)
    inside = [m for _, m in hits if not m.on_edge]
    front = hits
    if inside:
        least = min(inside, key=cmp_to_key(gap))
        front = [(name, m) for name, m in hits if gap(m, least) <= 0]
    if not front or (len(front) == 1 and not front[0][1].on_edge):
        return seen, frozenset()
    first = min((m for _, m in front), key=cmp_to_key(gap))
    ties = {name for name, m in front if gap(m, first) == 0}
    ties.add(hits[seen][0] if seen >= 0 else NOWHERE)
    found = (_first(front, (move,)) for move in _ways([m for _, m in front]))
    ties.update(front[k][0] if k >= 0 else NOWHERE for k in found)
    return seen, frozenset(ties)


def _ways(hits: Sequence[Hit]) -> list[Integers]:
    """Return ways to move their ray, one for each answer that it may have.

    The answer changes where the moved ray meets an edge that the ray itself meets, or the line in
    which two surfaces cross that it meets there: lines through one point, seen along the ray. There
    is a way between every two that follow one another. What coincides has them once, not for each.
    """
    lines, planes = [], {}
    for hit in hits:
        edges = zip(hit.edges, hit.sides, hit.spans, strict=True)
        lines += [(m, span) for e, m, span in edges if e == 0]
        plane = _reduced(*hit.normal, hit.numerator)
        planes.setdefault(max(plane, tuple(-v for v in plane)), hit)
    planes = list(planes.values())
    for k, hit in enumerate(planes):
        lines += [crossing(hit, other) for other in planes[:k] if gap(hit, other) == 0]
    d = hits[0].direction
    lines = [turning(*line, d) for line in lines]
    along = max(range(3), key=lambda axis: abs(d[axis]))  # not needed: moves along d change nothing
    x, y = (along + 1) % 3, (along + 2) % 3
    found = {_reduced(-s * m[y], s * m[x]) for m in lines if m[x] or m[y] for s in (1, -1)}
    rays = sorted(found, key=cmp_to_key(_by_angle))
    out = []
    for k, (ux, uy) in enumerate(rays):
        vx, vy = rays[(k + 1) % len(rays)]
        turn = ux * vy - uy * vx
        if turn > 0:
            between = ux + vx, uy + vy
        elif turn == 0 and ux * vx + uy * vy < 0:  # opposite one another
            between = -uy, ux
        else:
            continue
        move = [0, 0, 0]
        move[x], move[y] = between
        out.append(tuple(move))
    return out


def _reduced(*vector: int) -> tuple[int, ...]:
    """Return the least integers that have the same direction."""
    unit = gcd(*vector)
    return tuple(v // unit for v in vector)


def _by_angle(u: tuple[int, int], v: tuple[int, int]) -> int:
    """Return the sign of u's angle less that of v, both from 0 to a whole turn."""
    lower_u, lower_v = ((y, x) < (0, 0) for x, y in (u, v))
    if lower_u != lower_v:
        return 1 if lower_u else -1
    turn = u[0] * v[1] - u[1] * v[0]
    return (turn < 0) - (turn > 0)


def _first(hits: Sequence[tuple[Name, Hit]], moves: Moves) -> int:
    """Return the index of the nearest hit of the moved ray, -1 for none."""
    best = -1
    for k, (name, m) in enumerate(hits):
        if m.is_hit(moves):
            order = sign_of_difference(m, hits[best][1], moves) if best >= 0 else -1
            if order < 0 or (order == 0 and name < hits[best][0]):
                best = k
    return best

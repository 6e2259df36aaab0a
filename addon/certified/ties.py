"""Decides which of its exact hits one ray sees by the rule, and which others tie with it.

The rule moves the ray infinitesimally (`exact.py`). Ties are what the ray may see if it is moved in
another way. Theorems: `Ties.v`, `Fans.fan_rule`.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cmp_to_key
from math import gcd

from ..tracer.hits import NOWHERE
from ..tracer.ties import Name
from .exact import PERTURBATION, Hit, Moves, gap, intersection, sign_of_difference, turning
from .integers import Integers


def seen_and_ties(hits: Sequence[tuple[Name, Hit]]) -> tuple[int, frozenset[Name]]:
    """Return which hit of one ray is seen, and all that the ray may see if its answer is ambiguous.

    Returns
    -------
    seen : int
        Index of the hit that the rule sees; -1 for none.
    ties : frozenset of names
        Ambiguous is a ray that, not moved, first meets an edge, a corner, or two surfaces at once.
        Then these are all surfaces that a moved ray may see, NOWHERE for none; else it is empty.
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
    """Return ways to move the ray of these hits, one for each answer that it may have.

    The answer changes where the moved ray goes to the other side of an edge that the ray meets, or
    of the line in which two surfaces intersect at the hit. Seen along the ray, these are lines
    through one point, so that one way between every two neighbours is enough.
    """
    d = hits[0].direction
    along = max(range(3), key=lambda axis: abs(d[axis]))  # moves along d change nothing
    x = (along + 1) % 3
    y = (along + 2) % 3
    lines = [turning(m, span, d) for m, span in _lines(hits)]
    found = {_reduced(-s * m[y], s * m[x]) for m in lines if m[x] or m[y] for s in (1, -1)}
    rays = sorted(found, key=cmp_to_key(_by_angle))
    out = []
    for k, (ux, uy) in enumerate(rays):
        vx, vy = rays[(k + 1) % len(rays)]
        turn = ux * vy - uy * vx
        if turn > 0:
            between = ux + vx, uy + vy
        elif turn == 0 and ux * vx + uy * vy < 0:  # opposite directions
            between = -uy, ux
        else:
            continue
        move = [0, 0, 0]
        move[x], move[y] = between
        out.append((move[0], move[1], move[2]))
    return out


def _lines(hits: Sequence[Hit]) -> list[tuple[Integers, Integers]]:
    """Return where the answer changes: edges, and intersections of different planes, as (m, span).

    Hits in one plane have their intersections with others once, not for each hit.
    """
    lines = []
    in_plane: dict[tuple[int, ...], Hit] = {}
    for hit in hits:
        edges = zip(hit.edges, hit.sides, hit.spans, strict=True)
        lines += [(m, span) for e, m, span in edges if e == 0]
        plane = _reduced(*hit.normal, hit.numerator)
        in_plane.setdefault(max(plane, tuple(-v for v in plane)), hit)
    planes = list(in_plane.values())
    for k, hit in enumerate(planes):
        lines += [intersection(hit, other) for other in planes[:k] if gap(hit, other) == 0]
    return lines


def _reduced(*vector: int) -> tuple[int, ...]:
    """Return the smallest integers with the same direction."""
    unit = gcd(*vector)
    return tuple(v // unit for v in vector)


def _by_angle(u: Sequence[int], v: Sequence[int]) -> int:
    """Return the sign of u's angle minus that of v, both from 0 to a whole turn."""
    lower_u = (u[1], u[0]) < (0, 0)
    lower_v = (v[1], v[0]) < (0, 0)
    if lower_u != lower_v:
        return 1 if lower_u else -1
    turn = u[0] * v[1] - u[1] * v[0]
    return (turn < 0) - (turn > 0)


def _first(hits: Sequence[tuple[Name, Hit]], moves: Moves) -> int:
    """Return the index of the moved ray's nearest hit, -1 for none."""
    best = -1
    for k, (name, m) in enumerate(hits):
        if m.is_crossed(moves):
            order = sign_of_difference(m, hits[best][1], moves) if best >= 0 else -1
            if order < 0 or (order == 0 and name < hits[best][0]):
                best = k
    return best

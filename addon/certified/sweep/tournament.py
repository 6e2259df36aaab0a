"""Finds the nearest of many coplanar sheets sooner: candidates are compared two by two, in rounds.

`decisions.one_by_one` compares as often, but in as many rounds as a ray has candidates. A
tournament takes their logarithm. Both find the same wherever all comparisons are decided.
"""

from __future__ import annotations

import numpy as np

from ...arrays import Bools, Index
from ..decisions import Compare
from ..order import COPLANAR, FARTHER, UNDECIDED


def tournament(compare: Compare, of_ray: Index) -> tuple[Index, Bools, Bools]:
    """Find the nearest of each ray's candidates, as `decisions.one_by_one`.

    In every round, each second candidate that is left of a ray is compared with the one before it,
    and the nearer stays; of two in one plane, the one before.
    """
    rays = int(of_ray[-1]) + 1 if len(of_ray) else 0
    decided = np.ones(rays, bool)
    tied = np.ones(len(of_ray), bool)
    left, rounds = np.arange(len(of_ray)), []
    while len(left) > rays:
        ray = of_ray[left]
        begins = np.flatnonzero(np.diff(ray, prepend=-1))
        second = np.flatnonzero((np.arange(len(left)) - begins[ray]) % 2)
        one, other = left[second - 1], left[second]
        result = compare(one, other)
        decided[ray[second[result == UNDECIDED]]] = False
        beaten = result == FARTHER
        stays = np.where(beaten, other, one)
        rounds.append((np.where(beaten, one, other), stays, result == COPLANAR))
        left[second - 1] = stays
        left = np.delete(left, second)
    for loser, winner, coplanar in reversed(rounds):
        tied[loser] = coplanar & tied[winner]
    return left, decided, tied

"""Decides what the error bound leaves open: by the order of depths, then by integers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bools, Index
from ..certainty import Certainty, Reason
from ..tracer.camera import Rays
from ..tracer.hits import Hits
from ..tracer.ties import Ties
from . import exact, order
from .measures import Prepared
from .surfaces import SURE, Candidates, Surfaces
from .ties import seen_and_ties

Met = list[exact.Hit | None]
# Whether the first of two candidates is nearer or farther than the second: codes of `order.py`.
Compare = Callable[[Index, Index], NDArray[np.int8]]


@dataclass(eq=False)
class Decisions:
    """Writes into `hits` what each step decides; `clip` and `around` are those of a `Ladder`."""

    hits: Hits
    rays: Rays
    surfaces: Surfaces
    clip: tuple[float, float]
    around: Rays
    reasons: Counter[Reason] = field(default_factory=Counter)  # why bounds did not decide
    ties: list[Ties] = field(default_factory=list)

    def by_bound(self, ray: Index, surface: Index) -> Iterator[None]:
        """Write the surfaces that rays certainly meet first, with t and barycentrics, in steps."""
        surfaces, surface = self.surfaces.only(surface)
        yield from Prepared(self.around, surfaces).enter(self.hits, ray, surface, self.rays.take)

    def by_order(self, found: Candidates) -> Candidates:
        """Decide the rays that certainly meet all their candidates, if the order of these is known.

        All candidates of a ray come together. Returns those of the other rays.
        """
        if not order.applies(self.around, self.clip[0]):
            return found
        doubtful = np.isin(found.ray, found.ray[found.doubt != SURE])
        rest = found.take(np.flatnonzero(doubtful))
        found = found.take(np.flatnonzero(~doubtful))
        if not len(found):
            return rest
        # Sorted by name: of several in one plane, the first, which stays, has the lowest name.
        found = found.take(np.lexsort((*self.surfaces.names(found.surface)[::-1], found.ray)))
        of_ray = np.cumsum(np.diff(found.ray, prepend=-1) != 0) - 1
        first, decided, coplanar = tournament(self._compare(found), of_ray)
        is_decided = decided[of_ray]
        losers = is_decided.copy()
        losers[first] = False
        coplanar &= is_decided
        self._count_reasons(losers, coplanar)
        winners = found.take(first[decided])
        for _ in self.by_bound(winners.ray, winners.surface):
            pass
        self.hits.certainty[winners.ray] = Certainty.EXACT
        has_ties = np.bincount(of_ray, coplanar) > 1
        self._enter_ties(found.take(np.flatnonzero(coplanar & has_ties[of_ray])))
        return Candidates.joined((rest, found.take(np.flatnonzero(~is_decided))))

    def _count_reasons(self, losers: Bools, coplanar: Bools) -> None:
        same_plane = int((losers & coplanar).sum())
        self.reasons[Reason.COPLANAR] += same_plane
        self.reasons[Reason.CLOSE] += int(losers.sum()) - same_plane

    def _enter_ties(self, tied: Candidates) -> None:
        """Note candidates in one plane with the nearest of their ray, sorted by ray."""
        self.ties.append(Ties.of(tied.ray, *self.surfaces.names(tied.surface)))
        self.hits.certainty[tied.ray] = Certainty.AMBIGUOUS

    def _compare(self, found: Candidates) -> Compare:
        """Return what compares two candidates of one ray by their depths."""
        none = np.zeros_like(found.ray)
        batch, _, surface = self.surfaces.integers(self.around, none, found.surface)

        def compare(one: Index, other: Index) -> NDArray[np.int8]:
            rays = self.rays.take(found.ray[other])
            return order.order_of(self.around, rays, batch, surface[one], surface[other])

        return compare

    def by_integers(self, found: Candidates) -> tuple[Met, Met]:
        """Decide rays, sorted, with all their candidates, as `definition.py` does.

        Returns the exact hit on each candidate, and the hit that its ray sees.
        """
        batch, *pairs = self.surfaces.integers(self.rays, found.ray, found.surface, self.clip)
        met = list(map(batch.hit, *(v.tolist() for v in pairs)))
        instance, triangle = (v.tolist() for v in self.surfaces.names(found.surface))
        names = list(zip(instance, triangle, strict=True))
        starts = np.flatnonzero(np.diff(found.ray, prepend=-1)).tolist()
        firsts: Met = []
        tied = []
        for start, end in zip(starts, [*starts[1:], len(met)], strict=True):
            ray = int(found.ray[start])
            hits = [(names[k], hit) for k in range(start, end) if (hit := met[k])]
            seen, ties = seen_and_ties(hits)
            self.hits.certainty[ray] = Certainty.AMBIGUOUS if ties else Certainty.EXACT
            tied += [(ray, *name) for name in sorted(ties)]
            first = None
            if seen >= 0:
                name, first = hits[seen]
                self.hits.instance[ray], self.hits.triangle[ray] = name
                self.hits.t[ray] = batch.t(first)
                self.hits.s[:, ray] = first.weights
            firsts += [first] * (end - start)
        ray_of, *name_of = np.array(tied, np.int64).reshape(-1, 3).T
        self.ties.append(Ties.of(ray_of, *name_of))
        return met, firsts


def tournament(compare: Compare, of_ray: Index) -> tuple[Index, Bools, Bools]:
    """Find the nearest of each ray's candidates: they are compared two by two, in rounds.

    In every round, each second candidate that is left of a ray is compared with the one before it,
    and the nearer stays; of two in one plane, the one before. So there are about as many rounds as
    the logarithm of a ray's candidates.

    Parameters
    ----------
    compare : callable
        Compares candidates of one ray.
    of_ray : (c,) int
        Which ray each candidate is of, counted from 0; they are sorted by it.

    Returns
    -------
    first : (r,) int
        The nearest candidate of each ray.
    decided : (r,) bool
        Whether that is certain.
    tied : (c,) bool
        Which candidates lie in one plane with the nearest of their ray, itself included.
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
        decided[ray[second[result == order.UNDECIDED]]] = False
        beaten = result == order.FARTHER
        stays = np.where(beaten, other, one)
        rounds.append((np.where(beaten, one, other), stays, result == order.COPLANAR))
        left[second - 1] = stays
        left = np.delete(left, second)
    for loser, winner, coplanar in reversed(rounds):
        tied[loser] = coplanar & tied[winner]
    return left, decided, tied

"""Who is nearest among the candidates of each ray, and at which t, correctly rounded.

In come candidates that the bounds could not rule out; out go entries in `Hits`. There are three
ways, from the cheapest: a ray has one candidate, which surely is a hit; it has several, all of
which surely are, and only their order is asked for; or anything may be in doubt.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..certainty import Certainty
from ..tracer.camera import Rays
from ..tracer.hits import Hits, Ties
from . import exact, order
from .reasons import Reason, of_doubts
from .surfaces import CLIP, EDGE, SURE, Candidates, Prepared, Surfaces
from .ties import seen_and_ties

# Candidates that are decided at a time, which takes some ten milliseconds.
BY_ORDER = 1 << 14
BY_INTEGERS = 1 << 11


def by_ray(found: Candidates, limit: int) -> Iterator[Candidates]:
    """Split candidates into parts of about at most `limit`, those of one ray together."""
    found = found.take(np.argsort(found.ray, kind="stable"))
    starts = np.flatnonzero(np.diff(found.ray, prepend=-1))
    ends = np.arange(limit, len(found.ray), limit)
    cuts = np.r_[starts, len(found.ray)][np.searchsorted(starts, ends)]
    for part in np.split(np.arange(len(found.ray)), cuts):
        if len(part):
            yield found.take(part)


@dataclass(eq=False)
class Decisions:
    """n rays on the way to being decided, and the surfaces that they may see.

    `clip` and `around` are as of a `Contest`; in `reasons` is counted why a candidate was not
    decided by the bounds.
    """

    hits: Hits
    rays: Rays
    surfaces: Surfaces
    clip: tuple[float, float]
    around: Rays
    reasons: Counter[Reason] | None = None
    ties: list[Ties] = field(default_factory=list)

    def by_bound(self, ray: NDArray[np.intp], surface: NDArray[np.intp]) -> Iterator[None]:
        """Enter what rays surely hit first, in small steps: only t and barycentrics are open."""
        surfaces, surface = self.surfaces.only(surface)
        yield from Prepared(self.around, surfaces).enter(self.hits, ray, surface, self.rays.take)

    def by_order(self, found: Candidates) -> Candidates:
        """Enter rays that surely hit all their candidates, where `order.py` says who is nearest.

        All candidates of a ray come together. Returns those of the other rays.
        """
        doubtful = np.zeros(len(self.hits), bool)
        doubtful[found.ray[found.doubt != SURE]] = True
        doubtful = doubtful[found.ray]
        if not order.applies(self.around, self.clip[0]) or doubtful.all():
            return found
        rest = found.take(np.flatnonzero(doubtful))
        found = found.take(np.flatnonzero(~doubtful))
        found = found.take(np.lexsort((*self.surfaces.names(found.surface)[::-1], found.ray)))
        of_ray = np.cumsum(np.diff(found.ray, prepend=-1) != 0) - 1
        first, decided, tied = self._first_by_order(found, of_ray)
        lost = decided[of_ray]
        rest = Candidates.joined((rest, found.take(np.flatnonzero(~lost))))
        lost[first] = False
        tied &= lost
        coplanar = int(tied.sum())
        self.reasons += Counter(
            {Reason.COPLANAR: coplanar, Reason.CLOSE: int(lost.sum()) - coplanar}
        )
        won = found.take(first[decided])
        for _ in self.by_bound(won.ray, won.surface):
            pass
        self.hits.certainty[won.ray] = Certainty.EXACT
        tied[first[np.unique(of_ray[tied])]] = True
        ties = found.take(np.flatnonzero(tied))  # what lies in one plane, sorted by ray
        self.ties.append(Ties.of(ties.ray, *self.surfaces.names(ties.surface)))
        self.hits.certainty[ties.ray] = Certainty.AMBIGUOUS
        return rest

    def _first_by_order(
        self, found: Candidates, of_ray: NDArray[np.intp]
    ) -> tuple[NDArray[np.intp], NDArray[np.bool_], NDArray[np.bool_]]:
        """Return the nearest of each ray's candidates, whether it is known, and what ties with it.

        Candidates are sorted by ray, of which `of_ray` counts the different ones. In every round
        each second one that is left of a ray meets the one before it, and one of the two stays.
        """
        none, rays = np.zeros_like(found.ray), int(of_ray[-1]) + 1
        batch, _, surface = self.surfaces.integers(self.around, none, found.surface)
        surface = np.array(surface)
        decided, tied = np.ones(rays, bool), np.ones(len(surface), bool)
        left, rounds = np.arange(len(surface)), []
        while len(left) > rays:
            ray = of_ray[left]
            begins = np.flatnonzero(np.diff(ray, prepend=-1))
            second = np.flatnonzero((np.arange(len(left)) - begins[ray]) % 2)
            one, other = left[second - 1], left[second]
            some = self.rays.take(found.ray[other])
            result = order.order_of(self.around, some, batch, surface[one], surface[other])
            decided[ray[second[result == order.UNDECIDED]]] = False
            beaten = result == order.FARTHER
            stays = np.where(beaten, other, one)
            rounds.append((np.where(beaten, one, other), stays, result == order.COPLANAR))
            left[second - 1] = stays
            left = np.delete(left, second)
        for loser, winner, coplanar in reversed(rounds):
            tied[loser] = coplanar & tied[winner]
        return left, decided, tied

    def by_integers(self, found: Candidates) -> None:
        """Enter rays, sorted, whose candidates are decided by integers, together."""
        batch, *pairs = self.surfaces.integers(self.rays, found.ray, found.surface, *self.clip)
        met = [batch.hit(*pair) for pair in zip(*pairs, strict=True)]
        names = list(zip(*(v.tolist() for v in self.surfaces.names(found.surface)), strict=True))
        groups: dict[int, list[tuple[int, exact.Hit | None]]] = {}
        for k, ray in enumerate(found.ray.tolist()):
            groups.setdefault(ray, []).append((k, met[k]))
        firsts: dict[int, exact.Hit | None] = {}
        tied = []
        for ray, group in groups.items():
            of_ray = [(names[k], hit) for k, hit in group if hit]
            seen, ties = seen_and_ties(of_ray)
            self.hits.certainty[ray] = Certainty.AMBIGUOUS if ties else Certainty.EXACT
            tied += [(ray, *name) for name in sorted(ties)]
            firsts[ray] = None
            if seen >= 0:
                name, firsts[ray] = of_ray[seen]
                self.hits.t[ray], self.hits.s[:, ray] = batch.t(firsts[ray]), firsts[ray].weights
                self.hits.instance[ray], self.hits.triangle[ray] = name
        ray, *name = np.array(tied, np.int64).reshape(-1, 3).T
        self.ties.append(Ties.of(ray, *name))
        if self.reasons is not None:
            self.reasons.update(self._reasons(found, groups, firsts))

    def _reasons(self, found: Candidates, groups, firsts) -> list[Reason]:
        """Return why candidates were not decided by the bounds, one each."""
        out, unusual = [], []
        planes = len(self.surfaces.planes)
        for ray, group in groups.items():
            first = firsts[ray]
            for k, hit in group:
                doubt, of_plane = found.doubt[k], found.surface[k] < planes
                if doubt == SURE:  # to be hit, but as near as another, for all the bounds know
                    if hit is not first:
                        same = hit and first and exact.sign_of_difference(hit, first) == 0
                        out.append(Reason.COPLANAR if same else Reason.CLOSE)
                elif doubt == EDGE and hit and hit.on_edge:
                    out.append(Reason.EDGE)
                elif of_plane:
                    out.append(Reason.CLIP if doubt == CLIP else Reason.EDGE_ON)
                else:
                    unusual.append(k)
        unusual = np.array(unusual, np.intp)
        corners = self.surfaces.triangles.corners.take(found.surface[unusual] - planes, axis=2)
        properties = of_doubts(self.rays.take(found.ray[unusual]), corners)
        for doubt, reason in zip(found.doubt[unusual], properties, strict=True):
            out.append(Reason.CLIP if doubt == CLIP and reason != Reason.EXTREME else reason)
        return out

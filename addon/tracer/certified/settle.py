"""Who is nearest among the candidates of each ray, and at which t, correctly rounded.

In come rivals that the bounds could not rule out; out go entries in `Hits`. There are three ways,
from the cheapest: a ray has one candidate, which surely is a hit; it has several, all of which
surely are, and only their order is asked for; or anything may be in doubt.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..camera import Rays
from ..hits import NOTHING, Hits, Name
from . import exact, order
from .certainty import Certainty
from .reasons import Reason, of_doubts
from .resolve import TOGETHER, Prepared
from .surfaces import CLIP, EDGE, SURE, Candidates, Surfaces
from .ties import nearest

_TOGETHER = 1 << 11  # candidates that whole numbers decide at a time: some ten milliseconds


def by_bound(
    hits: Hits,
    rays: Rays,
    surfaces: Surfaces,
    ray: NDArray[np.intp],
    surface: NDArray[np.intp],
    around: Rays,
) -> Iterator[None]:
    """Enter what rays surely hit first, in small steps: only t and the barycentrics are open."""
    surfaces, surface = surfaces.only(surface)
    prepared = Prepared(around, surfaces)
    for first in range(0, len(ray), TOGETHER):
        part = slice(first, first + TOGETHER)
        prepared.enter(hits, ray[part], rays.take(ray[part]), surface[part])
        yield
    prepared.finish(hits, rays.take)


def by_order(
    hits: Hits,
    rays: Rays,
    surfaces: Surfaces,
    clip: tuple[float, float],
    found: Candidates,
    reasons: Counter[Reason],
    around: Rays,
) -> Candidates:
    """Enter rays that surely hit all their candidates, where `order.py` says which is nearest.

    Returns the candidates of the other rays. `around` is as of a `Contest`.
    """
    doubtful = np.bincount(found.ray, found.doubt != SURE, len(hits.t)) > 0
    if not order.applies(around, clip[0]) or doubtful[found.ray].all():
        return found
    rest = found.take(np.flatnonzero(doubtful[found.ray]))
    found = found.take(np.flatnonzero(~doubtful[found.ray]))
    found = found.take(np.lexsort((*surfaces.names(found.surface)[::-1], found.ray)))
    numbers = surfaces.numbers(around, np.zeros_like(found.ray), found.surface)
    surface = np.array(numbers.surface)
    # The first of each ray is its champion, and meets one more of the ray's in every round.
    start = np.flatnonzero(np.diff(found.ray, prepend=-1))
    count = np.diff(np.r_[start, len(found.ray)])
    champion, decided, tied = start.copy(), np.ones(len(start), bool), np.zeros(len(surface), bool)
    for number in range(1, count.max()):
        at = np.flatnonzero(count > number)
        rival = start[at] + number
        some = rays.take(found.ray[rival])
        result = order.compare(around, some, numbers.batch, surface[champion[at]], surface[rival])
        decided[at[result == order.UNDECIDED]] = False
        tied[rival] = result == order.COPLANAR
        beaten = result == order.FARTHER
        champion[at[beaten]] = rival[beaten]
    of_ray = np.repeat(np.arange(len(start)), count)
    tied &= np.arange(len(surface)) > champion[of_ray]  # not those with a champion since beaten
    lost = decided[of_ray]
    rest = Candidates.joined((rest, found.take(np.flatnonzero(~lost))))
    lost[champion] = False
    coplanar = int((lost & tied).sum())
    reasons += Counter({Reason.COPLANAR: coplanar, Reason.CLOSE: int(lost.sum()) - coplanar})
    won = found.take(champion[decided])
    for _ in by_bound(hits, rays, surfaces, won.ray, won.surface, around):
        pass
    hits.certainty[won.ray] = Certainty.EXACT
    ambiguous = np.flatnonzero(lost & tied)
    _tie(hits, surfaces, found, np.r_[champion[np.unique(of_ray[ambiguous])], ambiguous])
    return rest


def _tie(hits: Hits, surfaces: Surfaces, found: Candidates, index: NDArray[np.intp]) -> None:
    """Enter candidates that lie in one plane as ties of their ray."""
    members: dict[int, tuple[Name, ...]] = {}
    names = zip(*(v.tolist() for v in surfaces.names(found.surface[index])), strict=True)
    for ray, name in zip(found.ray[index].tolist(), names, strict=True):
        members[ray] = (*members.get(ray, ()), name)
    sets = {names: frozenset(names) for names in set(members.values())}  # shared by many rays
    hits.ties.update((ray, sets[names]) for ray, names in members.items())
    hits.certainty[list(members)] = Certainty.AMBIGUOUS


def by_ray(found: Candidates) -> Iterator[Candidates]:
    """Split candidates into parts that are a short step each, those of one ray together."""
    found = found.take(np.argsort(found.ray, kind="stable"))
    starts = np.flatnonzero(np.diff(found.ray, prepend=-1))
    ends = np.arange(_TOGETHER, len(found.ray), _TOGETHER)
    cuts = np.r_[starts, len(found.ray)][np.searchsorted(starts, ends)]
    for part in np.split(np.arange(len(found.ray)), cuts):
        if len(part):
            yield found.take(part)


def by_numbers(
    hits: Hits,
    rays: Rays,
    surfaces: Surfaces,
    clip: tuple[float, float],
    found: Candidates,
    reasons: Counter[Reason],
) -> None:
    """Enter rays whose candidates are decided by whole numbers, together.

    Counts why each candidate had to be looked at.
    """
    numbers = surfaces.numbers(rays, found.ray, found.surface, *clip)
    names = list(zip(*(v.tolist() for v in surfaces.names(found.surface)), strict=True))
    groups: dict[int, list[tuple[int, exact.Meeting | None]]] = {}
    for k, ray in enumerate(found.ray.tolist()):
        groups.setdefault(ray, []).append((k, numbers.meeting(k)))
    first_of: dict[int, exact.Meeting | None] = {}
    for ray, group in groups.items():
        meetings = [(names[k], m) for k, m in group if m]
        seen, ties = nearest(meetings, (NOTHING, NOTHING))
        hits.certainty[ray] = Certainty.AMBIGUOUS if ties else Certainty.EXACT
        if ties:
            hits.ties[ray] = ties
        first = None
        if seen >= 0:
            name, first = meetings[seen]
            hits.t[ray] = numbers.batch.t(first)
            hits.instance[ray], hits.triangle[ray] = name
            if first.edges:
                ab, bc, ca = first.edges
                hits.s[:, ray] = [e / first.towards for e in (bc, ca, ab)]
        first_of[ray] = first
    reasons.update(_reasons(rays, surfaces, found, groups, first_of))


def _reasons(rays: Rays, surfaces: Surfaces, found: Candidates, groups, first_of) -> list[Reason]:
    """Return why candidates were not decided by the bounds, one each."""
    out, unusual = [], []
    for ray, group in groups.items():
        first = first_of[ray]
        for k, m in group:
            doubt, of_plane = found.doubt[k], found.surface[k] < len(surfaces.planes)
            if doubt == SURE:  # to be hit, but as near as another, for all the bounds know
                if m is not first:
                    same = m and first and exact.compare(m, first) == 0
                    out.append(Reason.COPLANAR if same else Reason.CLOSE)
            elif doubt == EDGE and m and m.on_edge:
                out.append(Reason.EDGE)
            elif of_plane:
                out.append(Reason.CLIP if doubt == CLIP else Reason.EDGE_ON)
            else:
                unusual.append(k)
    unusual = np.array(unusual, np.intp)
    corners = surfaces.triangles.corners.take(found.surface[unusual] - len(surfaces.planes), axis=2)
    properties = of_doubts(rays.take(found.ray[unusual]), corners)
    for doubt, reason in zip(found.doubt[unusual], properties, strict=True):
        out.append(Reason.CLIP if doubt == CLIP and reason != Reason.EXTREME else reason)
    return out

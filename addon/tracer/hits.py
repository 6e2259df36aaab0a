"""The hits of rays, and statistics of finding them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bools, Bytes, Floats, Index
from ..certainty import Certainty, Reason, sentences
from ..wording import count_of
from .vector import Vectors, gather, groups, spread

NOTHING = -1  # instance and triangle where a ray hits nothing
Names = NDArray[np.int32]  # (n,) instances, or triangles
Measures = Floats  # (4, n): t and the three barycentrics of n rays
# Finds those of rays: their numbers (k,), and the instance and triangle that each sees, (k,).
FindMeasures = Callable[[Index, Names, Names], Measures]
Name = tuple[int, int]  # instance and triangle
NOWHERE: Name = (NOTHING, NOTHING)  # what a ray sees that meets nothing
_TOGETHER = 1 << 17  # rows of ties looked at together


@dataclass
class Statistics:
    """Statistics of a picture."""

    method: str = ""  # what `auto` came to; else the requested one
    triangles: int = 0  # over all instances
    refused: int = 0  # of those, left out as a corner is not finite in world space
    pairs_tested: int = 0  # (ray, triangle or plane)
    rounding: str = ""  # how far rounding moves rays and corners before any test; certified only
    reasons: Counter[Reason] = field(default_factory=Counter)  # pairs that were decided exactly
    notes: list[str] = field(default_factory=list)  # what a user should know of how it was traced
    seconds: float = 0.0
    stages: dict[str, float] = field(default_factory=dict)  # seconds by part of the work
    # Of the sweep: triangles with a pixel in their box (boxed), not dropped as a whole (reached);
    # pixels in which they were evaluated (computed), and that it did not decide (left).
    culling: Counter[str] = field(default_factory=Counter)

    @property
    def pairs_exact(self) -> int:
        """Pairs of a ray and a surface that integers decided."""
        return sum(self.reasons.values())

    def required(self) -> list[str]:
        """Return what the scene required, in words, a fact a line; for a certified picture."""
        lines = list(self.notes)
        if self.refused:
            were = count_of(self.refused, "triangle was", "triangles were")
            lines.append(
                f"{were} left out: their corners are not finite in world space (clear the scale or "
                "the position that overflows)"
            )
        if self.method == "certified":
            lines += sentences(self.pairs_tested, self.reasons)
        return lines


@dataclass(frozen=True, eq=False)
class Ties(Mapping[int, frozenset[Name]]):
    """All surfaces that ambiguous rays may see; as a mapping it has the names of each.

    The k rays `ray`, in their order, may see the `count` (k,) surfaces from `start` (k,) on, of
    those in `instance` and `triangle`, (m,) each: neighbours that may see the same share them.
    """

    ray: NDArray[np.int64]
    start: NDArray[np.int64]
    count: NDArray[np.int32]
    instance: NDArray[np.int32]
    triangle: NDArray[np.int32]

    @classmethod
    @cache
    def none(cls) -> Ties:
        """Return no ties."""
        return cls(*np.zeros((2, 0), np.int64), *np.zeros((3, 0), np.int32))

    @classmethod
    def of(cls, ray: Index, instance: Index, triangle: Index) -> Ties:
        """Return the ties of rows of a ray and a surface, those of one ray together, in order."""
        start = np.flatnonzero(np.diff(ray, prepend=-1))
        count = np.diff(start, append=len(ray))
        before = np.arange(len(ray)) - np.repeat(np.r_[0, count][: len(count)], count)
        same = (instance == instance[before]) & (triangle == triangle[before])
        own = np.ones(len(start), bool)  # else what the ray before it may see
        if len(start):
            own[1:] = (count[1:] != count[:-1]) | ~np.logical_and.reduceat(same, start)[1:]
        first = np.cumsum(count * own) - count * own
        kept = np.repeat(own, count)
        return cls(
            ray[start].astype(np.int64),
            first[own][np.cumsum(own) - 1],
            count.astype(np.int32),
            instance[kept].astype(np.int32),
            triangle[kept].astype(np.int32),
        )

    @classmethod
    def joined(cls, parts: Sequence[Ties]) -> Ties:
        """Return the ties of several sets of rays, one after the other or mixed, as one."""
        parts = [part for part in parts if len(part.ray)]
        if len(parts) < 2:
            return parts[0] if parts else cls.none()
        ray = np.concatenate([p.ray for p in parts])
        order = np.argsort(ray, kind="stable")
        sizes = [len(p.instance) for p in parts]
        before = np.repeat(np.cumsum(sizes) - sizes, [len(p.ray) for p in parts])
        start = np.concatenate([p.start for p in parts]) + before
        return cls(
            ray[order],
            start[order],
            np.concatenate([p.count for p in parts])[order],
            np.concatenate([p.instance for p in parts]),
            np.concatenate([p.triangle for p in parts]),
        )

    def numbered(self, numbers: Index | int) -> Ties:
        """Return the ties with ray i called numbers[i], which ascend, or i + numbers."""
        if isinstance(numbers, int) and not numbers:
            return self
        ray = self.ray + numbers if isinstance(numbers, int) else numbers[self.ray]
        return replace(self, ray=ray.astype(np.int64, copy=False))

    def below(self, ray: int) -> Ties:
        """Return the ties of the rays with lower numbers."""
        some = slice(np.searchsorted(self.ray, ray))
        return replace(self, ray=self.ray[some], start=self.start[some], count=self.count[some])

    def may_see(self, ray: Index, instance: Index, triangle: Index) -> Bools:
        """Return which of these rays are ambiguous and may see these surfaces, (n,)."""
        out = np.zeros(len(ray), bool)
        at = np.searchsorted(self.ray, ray)
        some = np.flatnonzero(np.append(self.ray, -1)[at] == ray)
        for first, last in groups(self.count[at[some]], _TOGETHER):
            asked = some[first:last]
            of = at[asked]
            which, number = spread(asked, self.count[of])
            row = np.repeat(self.start[of], self.count[of]) + number
            same = (self.instance[row] == instance[which]) & (self.triangle[row] == triangle[which])
            out[which[same]] = True
        return out

    def __getitem__(self, ray: int) -> frozenset[Name]:
        at = int(np.searchsorted(self.ray, ray))
        if at == len(self.ray) or self.ray[at] != ray:
            raise KeyError(ray)
        rows = slice(self.start[at], self.start[at] + self.count[at])
        pairs = zip(self.instance[rows].tolist(), self.triangle[rows].tolist(), strict=True)
        return frozenset(pairs)

    def __iter__(self) -> Iterator[int]:
        return iter(self.ray.tolist())

    def __len__(self) -> int:
        return len(self.ray)


@dataclass(eq=False)
class Hits:
    """The hits of n rays: which surface, how that was decided, and where on it.

    Parameters
    ----------
    instance, triangle : (n,) int32
        The surface, NOTHING where no surface is hit. Plane k is the instance
        `len(scene.instances) + k`, and its triangle is NOTHING.
    certainty : (n,) uint8
        `Certainty` of the surface.
    measures : (4, n) float64, or callable
        t (inf where nothing is hit) and the barycentrics. Finding them takes longer than finding
        the surface, so a function that finds those of some rays may stand in their place: it is
        called when `t` or `s` is first asked for.
    ties : Ties
        Of ambiguous rays, by their index, every surface that may be seen.
    """

    instance: NDArray[np.int32]
    triangle: NDArray[np.int32]
    certainty: Bytes
    measures: Measures | FindMeasures
    ties: Ties = field(default_factory=Ties.none)

    def __len__(self) -> int:
        return len(self.instance)

    @classmethod
    def none(cls, count: int, certainty: Certainty = Certainty.NOT_CERTIFIED) -> Hits:
        """Return hits of `count` rays that have met nothing yet."""
        instance = np.full(count, NOTHING, np.int32)
        triangle = np.full(count, NOTHING, np.int32)
        return cls(instance, triangle, np.full(count, certainty, np.uint8), no_measures(count))

    @classmethod
    def of(cls, t: Floats, instance: Index, triangle: Index, s: Vectors) -> Hits:
        """Return hits of an unproven method: t (n,), the names (n,), and barycentrics s (3, n)."""
        certainty = np.full(len(t), Certainty.NOT_CERTIFIED, np.uint8)
        measures = np.vstack((t, s))
        return cls(instance.astype(np.int32), triangle.astype(np.int32), certainty, measures)

    @classmethod
    def joined(cls, parts: Sequence[Hits]) -> Hits:
        """Return the hits of several sets of rays, one after the other, as those of one."""
        if len(parts) == 1:
            return parts[0]
        starts = np.cumsum([0, *map(len, parts)])
        found = [part.measures for part in parts]
        measures: Measures | FindMeasures = partial(_measures_of, found, starts)
        if not any(callable(part) for part in found):
            measures = np.concatenate(found, axis=1)
        return cls(
            np.concatenate([part.instance for part in parts]),
            np.concatenate([part.triangle for part in parts]),
            np.concatenate([part.certainty for part in parts]),
            measures,
            Ties.joined([p.ties.numbered(s) for p, s in zip(parts, starts.tolist(), strict=False)]),
        )

    @cached_property
    def values(self) -> Measures:
        """T and the barycentrics of all rays, (4, n), found on first use."""
        return self.measured(np.arange(len(self))) if callable(self.measures) else self.measures

    @property
    def t(self) -> Floats:
        """The ray parameter of each hit, (n,): inf where nothing is hit."""
        return self.values[0]

    @property
    def s(self) -> Vectors:
        """The barycentrics of each hit, (3, n)."""
        return self.values[1:]

    def measured(self, ray: Index) -> Measures:
        """Return t and the barycentrics of some rays alone, (4, k)."""
        if callable(self.measures):
            return self.measures(ray, self.instance[ray], self.triangle[ray])
        return self.measures[:, ray]

    def enter(self, index: Index | slice, other: Hits) -> None:
        """Replace the hits of the rays at `index` by others, all but their ties."""
        self.instance[index] = other.instance
        self.triangle[index] = other.triangle
        self.certainty[index] = other.certainty
        for own, new in zip(self.values, other.values, strict=True):  # faster than all at once
            own[index] = new

    def take(self, index: Index | slice) -> Hits:
        """Return the hits of the rays at `index`, without their ties."""
        measures = self.measures
        if callable(measures):
            if isinstance(index, slice):
                index = np.arange(*index.indices(len(self)))
            measures = partial(_measures_at, measures, index)
        elif isinstance(index, slice):
            measures = measures[:, index]
        else:
            measures = gather(measures, index)
        return Hits(self.instance[index], self.triangle[index], self.certainty[index], measures)


def no_measures(*shape: int) -> Measures:
    """Return t and the barycentrics, (4, *shape), of rays that hit nothing."""
    out = np.zeros((4, *shape))
    out[0] = np.inf
    return out


def _measures_at(
    find: FindMeasures, own: Index, ray: Index, instance: Names, triangle: Names
) -> Measures:
    """Find the measures of rays that have other numbers, `own`, where they are known."""
    return find(own[ray], instance, triangle)


def _measures_of(
    found: Sequence[Measures | FindMeasures],
    starts: Index,
    ray: Index,
    instance: Names,
    triangle: Names,
) -> Measures:
    """Find the measures of rays that are numbered through several parts."""
    out = np.empty((4, len(ray)))
    part_of = np.searchsorted(starts, ray, side="right") - 1
    for number, measures in enumerate(found):
        some = np.flatnonzero(part_of == number)
        own = ray[some] - starts[number]
        if callable(measures):
            out[:, some] = measures(own, instance[some], triangle[some])
        else:
            out[:, some] = measures[:, own]
    return out

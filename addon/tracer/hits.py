"""What rays meet, and what it took to find out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property

import numpy as np
from numpy.typing import NDArray

from ..certainty import Certainty
from ..certified.reasons import Reason, sentences
from .vector import Arrays, Index, groups, spread

NOTHING = -1  # instance and triangle where a ray hits nothing
Measure = NDArray[np.float64]  # (4, ...): t, and the barycentrics
Name = tuple[int, int]  # instance and triangle
NOWHERE: Name = (NOTHING, NOTHING)  # what a ray sees that meets nothing
_TOGETHER = 1 << 17  # rows of ties looked at together
_ARRAYS = ("t", "instance", "triangle", "s", "certainty")  # of `Hits`
_NAMES = ("instance", "triangle", "certainty")  # what of them is not asked for later


@dataclass
class Statistics:
    """What a picture took."""

    method: str = ""  # what `auto` came to; else what was asked for
    triangles: int = 0  # over all instances
    refused: int = 0  # of those, left out as a corner is not finite in world space
    pairs_tested: int = 0  # (ray, triangle or plane)
    rounding: str = ""  # how far it goes before that, in words
    reasons: Counter[Reason] = field(default_factory=Counter)  # pairs that were decided exactly
    notes: list[str] = field(default_factory=list)  # what a user should know of how it was traced
    seconds: float = 0.0
    stages: Counter[str] = field(default_factory=Counter)  # seconds of the parts of certified work
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
            lines.append(
                f"{self.refused:,} triangles were left out: their corners are not finite in world "
                "space (clear the scale or the position that overflows)"
            )
        if self.method == "certified":
            lines += [*sentences(self.pairs_tested, self.reasons), self.rounding]
        return lines


@dataclass(frozen=True, eq=False)
class Ties(Mapping[int, frozenset[Name]]):
    """All that ambiguous rays may be said to see; as a mapping it has the names of each.

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
    def of(cls, ray: NDArray, instance: NDArray, triangle: NDArray) -> Ties:
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
        names = (v[kept].astype(np.int32) for v in (instance, triangle))
        first = first[own][np.cumsum(own) - 1]
        return cls(ray[start].astype(np.int64), first, count.astype(np.int32), *names)

    @classmethod
    def joined(cls, parts: Sequence[Ties]) -> Ties:
        """Return the ties of several sets of rays, one after the other or mixed, as one."""
        parts = [part for part in parts if len(part.ray)]
        if len(parts) < 2:
            return parts[0] if parts else cls.none()
        ray, start, count, *names = map(
            np.concatenate, zip(*(vars(p).values() for p in parts), strict=True)
        )
        sizes = [len(p.instance) for p in parts]
        start += np.repeat(np.cumsum(sizes) - sizes, [len(p.ray) for p in parts])
        order = np.argsort(ray, kind="stable")
        return cls(ray[order], start[order], count[order], *names)

    def numbered(self, numbers: NDArray[np.integer] | int) -> Ties:
        """Return the ties with ray i called numbers[i], which ascend, or i + numbers."""
        if isinstance(numbers, int) and not numbers:
            return self
        ray = self.ray + numbers if isinstance(numbers, int) else numbers[self.ray]
        return replace(self, ray=ray.astype(np.int64, copy=False))

    def below(self, ray: int) -> Ties:
        """Return the ties of the rays with lower numbers."""
        some = slice(np.searchsorted(self.ray, ray))
        return replace(self, ray=self.ray[some], start=self.start[some], count=self.count[some])

    def may_see(self, ray: NDArray, instance: NDArray, triangle: NDArray) -> NDArray[np.bool_]:
        """Return which of these rays are ambiguous and may be said to see these surfaces, (n,)."""
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
    """What n rays meet.

    `t` (n,) float64 is inf where nothing is hit; `instance` and `triangle`, (n,) int32, are NOTHING
    there; `s`, the barycentrics, is (3, n) float64. A hit on plane k has the instance
    `len(scene.instances) + k` and the triangle NOTHING. `certainty` (n,) uint8 holds `Certainty`;
    `ties` says of ambiguous rays, by their index, all that may be seen.
    """

    t: NDArray[np.float64]
    instance: NDArray[np.int32]
    triangle: NDArray[np.int32]
    s: NDArray[np.float64]
    certainty: NDArray[np.uint8] = None  # type: ignore[assignment]  # by default NOT_CERTIFIED
    ties: Ties = field(default_factory=Ties.none)
    _entered = _ARRAYS

    def __post_init__(self) -> None:
        if self.certainty is None:
            self.certainty = np.full(len(self.t), Certainty.NOT_CERTIFIED, np.uint8)

    def __len__(self) -> int:
        return len(self.instance)

    @classmethod
    def none(cls, count: int, certainty: Certainty = Certainty.NOT_CERTIFIED) -> Hits:
        """Return hits of `count` rays that have met nothing yet."""
        names = np.full((2, count), NOTHING, np.int32)
        known = np.full(count, certainty, np.uint8)
        return cls(np.full(count, np.inf), *names, np.zeros((3, count)), known)

    @classmethod
    def joined(cls, parts: Sequence[Hits]) -> Hits:
        """Return the hits of several sets of rays, one after the other, as those of one."""
        if len(parts) == 1:
            return parts[0]
        out = cls(*(np.concatenate([getattr(p, n) for p in parts], axis=-1) for n in _ARRAYS))
        starts = np.cumsum([0, *map(len, parts)]).tolist()
        out.ties = Ties.joined([p.ties.numbered(s) for p, s in zip(parts, starts, strict=False)])
        return out

    def enter(self, index: NDArray | slice, other: Hits) -> None:
        """Write others in the place of the hits of the rays at `index`, but for their ties."""
        for name in self._entered:
            getattr(self, name)[..., index] = getattr(other, name)

    def take(self, index: NDArray | slice) -> Hits:
        """Return the hits of the rays at `index`, without their ties."""
        return Hits(*(getattr(self, name)[..., index] for name in _ARRAYS))


@dataclass(frozen=True, eq=False)
class Measured(Arrays):
    """t and barycentrics, (4, k), of k rays that were found with the names; `ray` ascends."""

    ray: NDArray[np.int64]
    values: Measure

    @classmethod
    @cache
    def none(cls) -> Measured:
        """Return those of no rays."""
        return cls(np.zeros(0, np.int64), np.zeros((4, 0)))


class LazyHits(Hits):
    """What n rays meet, of which t and the barycentrics are found when they are asked for.

    `measure` gives both of the rays with these numbers (k,); `known` is what it knows already.
    """

    _entered = _NAMES

    def __init__(
        self,
        instance: NDArray[np.int32],
        triangle: NDArray[np.int32],
        certainty: NDArray[np.uint8],
        measure: Callable[[Index], Measure] | None = None,
    ) -> None:
        self.instance, self.triangle, self.certainty = instance, triangle, certainty
        self.ties, self.known, self.measure = Ties.none(), Measured.none(), measure

    @cached_property
    def _measured(self) -> Measure:
        return self.measure(np.arange(len(self)))

    t = property(lambda self: self._measured[0])
    s = property(lambda self: self._measured[1:])

    def take(self, index: NDArray | slice) -> LazyHits:
        """Return the hits of the rays at `index`, as lazy, without their ties."""
        own = np.arange(*index.indices(len(self))) if isinstance(index, slice) else index
        names, measure = (getattr(self, name)[index] for name in _NAMES), self.measure
        return LazyHits(*names, lambda ray: measure(own[ray]))

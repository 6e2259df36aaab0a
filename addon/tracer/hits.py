"""What rays meet, and what it took to find out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .certified.certainty import Certainty
from .certified.reasons import Reason, sentences
from .vector import spread

NOTHING = -1  # instance and triangle where a ray hits nothing
Name = tuple[int, int]  # instance and triangle
NOWHERE: Name = (NOTHING, NOTHING)  # what a ray sees that meets nothing
_ARRAYS = ("t", "instance", "triangle", "s", "certainty")  # of `Hits`


@dataclass
class Statistics:
    """What a picture took."""

    method: str = ""  # what `auto` came to; else what was asked for
    triangles: int = 0  # over all instances
    refused: int = 0  # of those, left out as a corner is not finite in world space
    pairs_tested: int = 0  # (ray, triangle or plane)
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
            lines += sentences(self.pairs_tested, self.reasons)
        return lines


@dataclass(frozen=True, eq=False)
class Ties(Mapping[int, frozenset[Name]]):
    """All that ambiguous rays may be said to see: a row for each ray and surface, (k,) each.

    Sorted by the ray's index. As a mapping it has the names of each ambiguous ray.
    """

    ray: NDArray[np.int64]
    instance: NDArray[np.int32]
    triangle: NDArray[np.int32]

    @classmethod
    def room(cls, count: int = 0) -> Ties:
        """Return room for so many rows; by default no ties."""
        return cls(np.empty(count, np.int64), *np.empty((2, count), np.int32))

    @classmethod
    def joined(cls, parts: Sequence[Ties]) -> Ties:
        """Return the ties of several sets of rays, one after the other or mixed, as one."""
        parts = [part for part in parts if len(part.ray)]
        if len(parts) < 2:
            return parts[0] if parts else cls.room()
        ray, *name = map(np.concatenate, zip(*(vars(p).values() for p in parts), strict=True))
        if (ray[1:] < ray[:-1]).any():
            order = np.argsort(ray, kind="stable")
            ray, name = ray[order], [v[order] for v in name]
        return cls(ray, *name)

    def enter(self, first: int, part: Ties) -> None:
        """Write a part into the rows from `first` on."""
        for own, rows in zip(vars(self).values(), vars(part).values(), strict=True):
            own[first : first + len(rows)] = rows

    def numbered(self, numbers: NDArray[np.integer] | int) -> Ties:
        """Return the ties with ray i called numbers[i], which ascend, or i + numbers."""
        if isinstance(numbers, int) and not numbers:
            return self
        ray = self.ray + numbers if isinstance(numbers, int) else numbers[self.ray]
        return Ties(ray.astype(np.int64, copy=False), self.instance, self.triangle)

    def may_see(self, ray: NDArray, instance: NDArray, triangle: NDArray) -> NDArray[np.bool_]:
        """Return which of these rays are ambiguous and may be said to see these surfaces, (n,)."""
        start, end = (np.searchsorted(self.ray, ray, side) for side in ("left", "right"))
        which, number = spread(np.arange(len(ray)), end - start)
        row = start[which] + number
        same = (self.instance[row] == instance[which]) & (self.triangle[row] == triangle[which])
        return np.bincount(which, same, len(ray)) > 0

    def __getitem__(self, ray: int) -> frozenset[Name]:
        start, end = (int(np.searchsorted(self.ray, ray, side)) for side in ("left", "right"))
        if start == end:
            raise KeyError(ray)
        rows = slice(start, end)
        pairs = zip(self.instance[rows].tolist(), self.triangle[rows].tolist(), strict=True)
        return frozenset(pairs)

    def __iter__(self) -> Iterator[int]:
        return iter(np.unique(self.ray).tolist())

    def __len__(self) -> int:
        return int((np.diff(self.ray, prepend=-1) != 0).sum())


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
    ties: Ties = field(default_factory=Ties.room)

    def __post_init__(self) -> None:
        if self.certainty is None:
            self.certainty = np.full(len(self.t), Certainty.NOT_CERTIFIED, np.uint8)

    @classmethod
    def none(cls, count: int, certainty: Certainty = Certainty.NOT_CERTIFIED) -> Hits:
        """Return hits of `count` rays that have met nothing yet."""
        hits = cls.room(count)
        hits.clear(slice(None), certainty)
        return hits

    @classmethod
    def room(cls, count: int) -> Hits:
        """Return room for the hits of so many rays."""
        names = np.empty((2, count), np.int32)
        return cls(np.empty(count), *names, np.empty((3, count)), np.empty(count, np.uint8))

    def clear(self, part: slice, certainty: Certainty) -> None:
        """Say of a part of the rays that they have met nothing yet."""
        for name, value in zip(_ARRAYS, (np.inf, NOTHING, NOTHING, 0.0, certainty), strict=True):
            getattr(self, name)[..., part] = value

    @classmethod
    def joined(cls, parts: Sequence[Hits]) -> Hits:
        """Return the hits of several sets of rays, one after the other, as those of one."""
        if len(parts) == 1:
            return parts[0]
        out = cls(*(np.concatenate([getattr(p, n) for p in parts], axis=-1) for n in _ARRAYS))
        starts = np.cumsum([0, *(len(part.t) for part in parts)]).tolist()
        out.ties = Ties.joined([p.ties.numbered(s) for p, s in zip(parts, starts, strict=False)])
        return out

    def enter(self, index: NDArray | slice, other: Hits) -> None:
        """Write others in the place of the hits of the rays at `index`, but for their ties."""
        for name in _ARRAYS:
            getattr(self, name)[..., index] = getattr(other, name)

    def take(self, index: NDArray | slice) -> Hits:
        """Return the hits of the rays at `index`, without their ties."""
        return Hits(*(getattr(self, name)[..., index] for name in _ARRAYS))

"""Rays that see several surfaces at one depth, and those that the tie was between."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bools, Index, groups
from .vector import spread

Name = tuple[int, int]  # instance and triangle


_TOGETHER = 1 << 17  # rows of ties compared together


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
        ray = self.ray + numbers if isinstance(numbers, int) else numbers[self.ray]
        return replace(self, ray=ray.astype(np.int64, copy=False))

    def below(self, ray: int) -> Ties:
        """Return the ties of the rays with lower numbers."""
        some = slice(np.searchsorted(self.ray, ray))
        return replace(self, ray=self.ray[some], start=self.start[some], count=self.count[some])

    def may_see(self, ray: Index, instance: Index, triangle: Index) -> Bools:
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

"""The hits of rays, and statistics of finding them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from ..arrays import Bytes, Floats, Index
from ..certainty import Certainty, Reason, sentences
from ..wording import count_of
from .ties import Name, Ties
from .vector import Vectors, gather

NOTHING = -1  # instance and triangle where a ray hits nothing
Names = NDArray[np.int32]  # (n,) instances, or triangles
Measures = Floats  # (4, n): t and the three barycentrics of n rays
# Finds those of rays: their numbers (k,), and the instance and triangle that each sees, (k,).
FindMeasures = Callable[[Index, Names, Names], Measures]
NOWHERE: Name = (NOTHING, NOTHING)  # what a ray sees that meets nothing


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
        """Concatenate the hits of several sets of rays."""
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

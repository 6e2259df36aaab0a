"""How much of a picture, or of the cases, is right: counts, and a score from 0 to 100."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from reference_tracer.arrays import Bools

# What each mistake costs, of 100, where they are all that is wrong with a file.
COST = 20.0


@dataclass(frozen=True)
class Tally:
    """Counts of cases (of pixels, in a scene) in which something is, or is said to be, hit.

    Parts after the first are counted where the first is right: t and barycentrics, where the
    triangle is. What lies on the boundary, where float64 may have it otherwise, is counted apart
    and not in the score.
    """

    total: int  # of the interior
    right: Mapping[str, int]  # how many of those have a part right, by its name
    boundary: int
    boundary_right: int
    weights: Mapping[str, float] = field(repr=False)  # of the parts' shares; they sum to 1

    @classmethod
    def of(
        cls,
        counted: Bools,
        boundary: Bools,
        right: Mapping[str, Bools],
        weights: Mapping[str, float],
    ) -> Tally:
        """Count: of those `counted`, which have each part right."""
        first, *_ = right.values()
        inside, border = counted & ~boundary, counted & boundary
        return cls(
            int(inside.sum()),
            {name: int((inside & first & mask).sum()) for name, mask in right.items()},
            int(border.sum()),
            int((border & first).sum()),
            weights,
        )

    @property
    def shares(self) -> dict[str, float]:
        """The right share of the first part, and of the others where that is right."""
        first, *others = self.right
        most = dict.fromkeys(others, self.right[first]) | {first: self.total}
        return {
            name: count / most[name] if most[name] else float(not self.total)
            for name, count in self.right.items()
        }

    @property
    def score(self) -> float:
        """0 to 100, rounded down to a tenth: 100 means that all of the interior is right."""
        return score_of([self])

    @property
    def all_right(self) -> bool:
        """Whether nothing of the interior is wrong."""
        return set(self.right.values()) == {self.total}

    def to_dict(self) -> dict[str, Any]:
        """Return the counts, the shares and the score as JSON can hold them."""
        return {
            "total": self.total,
            **self.right,
            "boundary": self.boundary,
            "boundary_right": self.boundary_right,
            "shares": self.shares,
            "score": self.score,
        }


def score_of(tallies: Sequence[Tally | None]) -> float:
    """Return the mean score of some, 0 to 100, rounded down to a tenth; None counts as 0.

    One in which nothing is counted says nothing, and is left out, unless all are such.
    """
    tallies = [t for t in tallies if t is None or t.total] or tallies
    if not any(tallies):
        return 0.0
    each = [sum(w * t.shares[name] for name, w in t.weights.items()) if t else 0.0 for t in tallies]
    if all(t and t.all_right for t in tallies):
        return 100.0
    return min(math.floor(1000 * sum(each) / len(each)) / 10, 99.9)

"""How much of a picture, or of the checks, is right: counts, and a score from 0 to 100."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

# What a right surface, t and barycentrics count for in the score of a scene.
WEIGHTS = {"surface": 0.6, "t": 0.2, "barycentrics": 0.2}

# What each mistake costs, of 100, where they are all that is wrong with a file.
COST = 20.0

Mask = NDArray[np.bool_]


@dataclass(frozen=True)
class Tally:
    """Counts of pixels (of pairs, in the checks) in which a triangle is, or is said to be, seen.

    Values of t and barycentrics are counted where the triangle is the right one. What lies on the
    boundary, where float64 may have it otherwise, is counted apart and not in the score.
    """

    total: int  # of the interior
    surface: int  # of those, with the right triangle
    t: int  # of those, with the right t
    barycentrics: int
    boundary: int
    boundary_right: int

    @classmethod
    def of(cls, counted: Mask, wrong: Mask, boundary: Mask, right: Mask, t: Mask, s: Mask) -> Tally:
        """Count: of those `counted`, which are `wrong`; of those `right`, whose t and s are."""
        inside, border = counted & ~boundary, counted & boundary
        return cls(
            int(inside.sum()),
            int((inside & ~wrong).sum()),
            int((inside & right & t).sum()),
            int((inside & right & s).sum()),
            int(border.sum()),
            int((border & ~wrong).sum()),
        )

    @property
    def shares(self) -> dict[str, float]:
        """The right share of surfaces, and of t and barycentrics where the surface is right."""
        return {
            "surface": self.surface / self.total if self.total else 1.0,
            "t": self.t / self.surface if self.surface else float(not self.total),
            "barycentrics": self.barycentrics / self.surface
            if self.surface
            else float(not self.total),
        }

    @property
    def score(self) -> float:
        """0 to 100, rounded down to a tenth: 100 means that all of the interior is right."""
        return score_of([self])

    @property
    def all_right(self) -> bool:
        """Whether nothing of the interior is wrong."""
        return self.total == self.surface == self.t == self.barycentrics

    def to_dict(self) -> dict[str, Any]:
        """Return the counts, the shares and the score as JSON can hold them."""
        return asdict(self) | {"shares": self.shares, "score": self.score}


def score_of(tallies: Sequence[Tally | None]) -> float:
    """Return the mean score of some, 0 to 100, rounded down to a tenth; None counts as 0.

    One in which nothing is counted says nothing, and is left out, unless all are such.
    """
    tallies = [t for t in tallies if t is None or t.total] or tallies
    if not any(tallies):
        return 0.0
    each = [sum(w * t.shares[name] for name, w in WEIGHTS.items()) if t else 0.0 for t in tallies]
    if all(t and t.all_right for t in tallies):
        return 100.0
    return min(math.floor(1000 * sum(each) / len(each)) / 10, 99.9)

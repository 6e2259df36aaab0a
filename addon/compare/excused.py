"""What share of a picture rests on rounding, whether that is too much, and what would help.

An edge, a depth tie, a clip plane is a reason why float32 *may* show something else. Each pixel
that rests on one could hide a fault. A few do in every picture; where many do, nobody knows whether
the two sides agree.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Bools
from ..tracer.frame import Frame
from .advice import advise
from .bounds import U32
from .case import Case
from .cause import NOT_DECIDABLE, Cause, Causes
from .causes import CAUSES
from .checks.edges import DEPTH_TIE

# The share of a picture that may rest on rounding. Measured: Blender's pictures of the sample
# scenes have at most 0.004 % of edges, ties and clip planes, the forest, of which 59 % is boundary,
# 0.21 %. Ten times the worst of these is no sound picture.
SMALL = 0.02
COMPARABLE = 0.5  # the largest share of a picture in which no fault could be found


@dataclass(frozen=True)
class Excused:
    """The pixels of a picture that rest on rounding."""

    pixels: int
    total: int
    by_cause: dict[Cause, int]
    advice: tuple[str, ...] = ()  # what would make these decidable, if it is too much

    @property
    def share(self) -> float:
        """The share of the picture that rests on rounding."""
        return self.pixels / max(self.total, 1)

    @property
    def too_much(self) -> bool:
        """Whether the verdict is no better than a warning."""
        return self.share > SMALL

    def lines(self) -> Iterator[str]:
        """Say so, if it is too much, and what would help."""
        if self.too_much:
            names = ", ".join(f"{cause.label} {n:,} px" for cause, n in self.by_cause.items())
            yield f"{100 * self.share:.1f} % of this picture rests on rounding alone: {names}"
            yield from (f"  to have it judged, {line}" for line in self.advice)

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return {
            "pixels": self.pixels,
            "share": self.share,
            "most": SMALL,
            "by_cause": {cause.key: n for cause, n in self.by_cause.items()},
            "advice": list(self.advice),
        }


def excused(case: Case, frame: Frame, causes: Causes) -> Excused:
    """Count the pixels that rest on rounding; if they are too many, say what would help."""
    coincident = in_one_place(frame, causes)
    where = {
        cause: found
        for cause in sorted(CAUSES)
        if cause.rounding or cause == NOT_DECIDABLE
        if (found := (causes.cause == cause) & ~coincident).any()
    }
    counts = {cause: int(found.sum()) for cause, found in where.items()}
    out = Excused(sum(counts.values()), causes.cause.size, counts)
    if not out.too_much:
        return out
    advice = advise(case, frame, causes, where, SMALL)
    return Excused(out.pixels, out.total, counts, tuple(advice))


def in_one_place(frame: Frame, causes: Causes) -> Bools:
    """Return the ties (h, w) of surfaces that no depth in float32 tells apart.

    These lie in one place, as copies do: either may be shown by any picture, and where the two are
    is judged as ever. They do not count.
    """
    with np.errstate(invalid="ignore"):
        return (causes.cause == DEPTH_TIE) & (causes.figure <= U32 * np.abs(frame.t))

"""Finds how much of a picture rests on rounding, whether it is too much, and what would help.

An edge, a depth tie, a clip plane is a reason why float32 *may* show something else. Each pixel
that rests on one could hide a fault. A few do in every picture; where many do, nobody knows whether
the two sides agree. So it is of each object: one with most of its pixels excused was not judged.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Bools, Integers
from ..pictures.bounds import U32
from ..tracer.frame import Frame
from .advice import advise
from .case import Case
from .cause import NOT_DECIDABLE, Cause, Causes
from .checks.edges import DEPTH_TIE
from .explain import CAUSES

# The share of a picture that may rest on rounding. Measured: 0.004 % at most of Blender's pictures
# of the sample scenes are edges, ties and clip planes; in the forest, where 59 % of the pixels lie
# at a boundary, 0.21 %. Ten times the worst of these is no sound picture.
SMALL = 0.02
COMPARABLE = 0.5  # the largest share of a picture, or of an object, in which no fault can be found
# The pixels of an object below which its share says nothing. If each of n rests on rounding with a
# probability p, half of them do with one of at most (4 p)^(n/2). In the forest p is 0.36 % at
# boundaries; where float32 moves edges by 0.1 px, which is far, a tenth: 3e-10 for 48 pixels. It is
# a guide and no bound, as the pixels along one edge do so together.
LEAST_PIXELS = 48
_TOLD = 3  # of such objects, those with most pixels; the others are counted


class Unjudged(NamedTuple):
    """An object that rests on rounding in most of its pixels: it could be wrong, or missing."""

    object: str
    pixels: int
    total: int  # in which it is seen: traced, or shown where that is known
    by_cause: dict[Cause, int]
    advice: tuple[str, ...] = ()

    def line(self) -> str:
        """Return it as a sentence without its full stop."""
        return (
            f"'{self.object}' was not judged: {self.pixels:,} of the {self.total:,} px in which it "
            f"is seen rest on rounding alone ({_named(self.by_cause)})"
        )

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return self._asdict() | {"by_cause": _keyed(self.by_cause), "advice": list(self.advice)}


@dataclass(frozen=True)
class Excused:
    """The pixels of a picture that rest on rounding."""

    pixels: int
    total: int
    by_cause: dict[Cause, int]
    advice: tuple[str, ...] = ()  # what would make these decidable, if it is too much
    objects: tuple[Unjudged, ...] = ()  # that rest on rounding, the largest first

    @property
    def share(self) -> float:
        """The share of the picture that rests on rounding."""
        return self.pixels / max(self.total, 1)

    @property
    def too_much(self) -> bool:
        """Whether the verdict is no better than a warning."""
        return self.share > SMALL

    def lines(self) -> Iterator[str]:
        """Say which objects, or how much of the picture, rest on rounding, and what would help."""
        found = [(one.line(), one.advice) for one in self.objects[:_TOLD]]
        if self.too_much:
            share = f"{100 * self.share:.1f} % of this picture rests on rounding alone"
            found.insert(0, (f"{share}: {_named(self.by_cause)}", self.advice))
        said: set[str] = set()  # what helps several is said once
        for line, advice in found:
            yield line
            yield from (f"  to have it judged, {a}" for a in advice if a not in said)
            said.update(advice)
        if more := len(self.objects[_TOLD:]):
            yield f"nor were {more:,} other objects judged"

    def to_dict(self) -> dict[str, object]:
        """Return it as JSON can hold it."""
        return {
            "pixels": self.pixels,
            "share": self.share,
            "most": SMALL,
            "by_cause": _keyed(self.by_cause),
            "advice": list(self.advice),
            "objects": [one.to_dict() for one in self.objects],
        }


def _named(by_cause: Mapping[Cause, int]) -> str:
    return ", ".join(f"{cause.label} {n:,} px" for cause, n in by_cause.items())


def _keyed(by_cause: Mapping[Cause, int]) -> dict[str, int]:
    return {cause.key: n for cause, n in by_cause.items()}


def excused(case: Case, frame: Frame, causes: Causes) -> Excused:
    """Count the pixels that rest on rounding; if they are too many, say what would help."""
    every = {
        cause: found
        for cause in sorted(CAUSES)
        if cause.rounding or cause == NOT_DECIDABLE
        if (found := causes.cause == cause).any()
    }
    coincident = in_one_place(frame, causes)
    where = {cause: found & ~coincident for cause, found in every.items()}
    counts = _counts(where)
    objects = tuple(_unjudged(case, frame, causes, every))
    out = Excused(sum(counts.values()), causes.cause.size, counts, objects=objects)
    if not out.too_much:
        return out
    return replace(out, advice=tuple(advise(case, frame, causes, where, SMALL)))


def _counts(where: Mapping[Cause, Bools]) -> dict[Cause, int]:
    return {cause: n for cause, found in where.items() if (n := int(found.sum()))}


def _unjudged(
    case: Case, frame: Frame, causes: Causes, where: Mapping[Cause, Bools]
) -> Iterator[Unjudged]:
    """Yield the objects that rest on rounding by more than COMPARABLE, the largest first.

    Surfaces in one place count here: as either may be shown, neither is judged. An object is looked
    at where it is traced, and where it is shown instead: of two in one place the tracer sees one.
    """
    if not where:
        return
    any_cause = np.any(list(where.values()), axis=0)
    found: dict[str, tuple[Bools, int]] = {}
    sides = [(case.scene.objects, frame.object_index)]
    if owners := case.picture.owners:
        sides.append((owners.names, owners.pixels))
    for names, seen in sides:
        for number, total in _mostly(seen, any_cause):
            found.setdefault(names[number], ((seen == number) & any_cause, total))
    for name, (own, total) in sorted(found.items(), key=lambda one: -one[1][1]):
        here = {cause: whole & own for cause, whole in where.items() if (whole & own).any()}
        allowed = COMPARABLE * total / own.size
        advice = tuple(advise(case, frame, causes, here, allowed))
        yield Unjudged(name, int(own.sum()), total, _counts(here), advice)


def _mostly(seen: Integers, where: Bools) -> Iterator[tuple[int, int]]:
    """Yield each number of `seen` (h, w) with most of its pixels in `where`, and their count."""
    is_object = seen >= 0
    total = np.bincount(seen[is_object])
    own = np.bincount(seen[is_object & where], minlength=len(total))
    for number in np.flatnonzero((own > COMPARABLE * total) & (total >= LEAST_PIXELS)):
        yield int(number), int(total[number])


def in_one_place(frame: Frame, causes: Causes) -> Bools:
    """Return the depth ties (h, w) of coincident surfaces, which float32 cannot separate.

    These lie in one place, as copies do: either may be shown by any picture, and where the two are
    is judged as ever. They do not count for the picture.
    """
    with np.errstate(invalid="ignore"):
        return (causes.cause == DEPTH_TIE) & (causes.figure <= U32 * np.abs(frame.t))

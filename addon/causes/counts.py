"""Counts a comparison's pixels by their causes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Bools, Bytes
from ..pictures.identity import Identity, Shows
from .cause import AGREE, NOT_DECIDABLE, NOT_TRACED, UNEXPLAINED, Cause, Causes
from .explain import CAUSES

EXAMPLES = 10  # pixels named of each cause


@dataclass(frozen=True)
class Counts:
    """How many pixels of a picture, or of a part of it, have each cause.

    total = agree + differ + not_decidable + not_traced, and differ = explained + unexplained.
    """

    total: int
    agree: int
    explained: int
    unexplained: int
    not_decidable: int
    not_traced: int
    by_cause: Mapping[str, int]  # by the causes' keys, but for pixels that agree or are not traced

    @property
    def differ(self) -> int:
        """Those that differ, explained or not."""
        return self.explained + self.unexplained

    def of_causes(self) -> Iterator[tuple[Cause, int]]:
        """Yield the causes that some pixels have, and how many do."""
        for cause in sorted(CAUSES):
            if count := self.by_cause.get(cause.key):
                yield cause, count

    @classmethod
    def of(cls, cause: Bytes) -> Counts:
        """Count pixels of any shape by the numbers of their causes."""
        return cls(**_counted(cause))

    def to_dict(self) -> dict[str, object]:
        """Return them as JSON can hold them."""
        return {
            "total": self.total,
            "agree": self.agree,
            "differ": self.differ,
            "explained": self.explained,
            "unexplained": self.unexplained,
            "not_decidable": self.not_decidable,
            "not_traced": self.not_traced,
            "by_cause": dict(self.by_cause),
        }


class NotJudged(NamedTuple):
    """Pixels in which something that the tracer does not model would excuse a fault."""

    pixels: int
    share: float  # of the picture
    by_feature: Mapping[str, int]  # by the feature's words, the most pixels first


class BehindCount(NamedTuple):
    """Pixels in which what is behind transparent surfaces was judged."""

    pixels: int
    unexplained: int  # of these


@dataclass(frozen=True)
class PixelCounts(Counts):
    """How many pixels of a picture have each cause, and where some of them are."""

    interior: Counts  # pixels that see what all eight around them see
    boundary: Counts  # the others
    # Some pixels of each cause, spread over all, [x, y] of the region from its lower left.
    examples: Mapping[str, list[list[int]]]
    not_judged: NotJudged
    behind: BehindCount | None = None  # None: it was not judged
    unexplained_shows: Shows | None = None  # owners of unexplained pixels, if known

    def to_dict(self) -> dict[str, object]:
        """Return them as JSON can hold them."""
        out = super().to_dict()
        out["interior"] = self.interior.to_dict()
        out["boundary"] = self.boundary.to_dict()
        out["examples"] = dict(self.examples)
        out["not_judged"] = self.not_judged._asdict()
        if self.behind:
            out["behind"] = self.behind._asdict()
        if self.unexplained_shows:
            out["unexplained_shows"] = self.unexplained_shows._asdict()
        return out


def count_pixels(
    causes: Causes,
    at_boundary: Bools,
    identity: Identity | None = None,
    features: Sequence[str] = (),
) -> PixelCounts:
    """Count pixels by their causes: all of them, then those at boundaries and inside.

    Parameters
    ----------
    causes : Causes
        Of each pixel (h, w).
    at_boundary : (h, w) bool
    identity : Identity, optional
        Which objects are shown.
    features : sequence of str
        What the tracer does not model, by the numbers in `causes.blind`.
    """
    cause = causes.cause
    wrong = cause == UNEXPLAINED
    blind = causes.blind[causes.blind >= 0]
    by_feature: Counter[str] = Counter()
    for number, many in zip(*np.unique(blind, return_counts=True), strict=True):
        by_feature[features[number]] += int(many)
    whole = _counted(cause)
    return PixelCounts(
        **whole,
        interior=Counts.of(cause[~at_boundary]),
        boundary=Counts.of(cause[at_boundary]),
        examples={
            c.key: _places(cause == c) for c in sorted(CAUSES) if whole["by_cause"].get(c.key)
        },
        not_judged=NotJudged(
            len(blind), len(blind) / max(cause.size, 1), dict(by_feature.most_common())
        ),
        behind=None
        if causes.behind is None
        else BehindCount(int(causes.behind.sum()), int((causes.behind & wrong).sum())),
        unexplained_shows=identity and identity.shows(wrong),
    )


def _counted(cause: Bytes) -> dict[str, Any]:
    """Return the counts as the fields of `Counts`."""
    count = {c: int((cause == c).sum()) for c in sorted(CAUSES)}
    apart = UNEXPLAINED, NOT_DECIDABLE
    return {
        "total": cause.size,
        "agree": count[AGREE],
        "explained": sum(n for c, n in count.items() if c.explains),
        "unexplained": count[UNEXPLAINED],
        "not_decidable": count[NOT_DECIDABLE],
        "not_traced": count[NOT_TRACED],
        "by_cause": {c.key: n for c, n in count.items() if c.explains or c in apart},
    }


def _places(where: Bools) -> list[list[int]]:
    """Return some pixels, spread evenly over all, as [x, y] from the lower left."""
    found = np.flatnonzero(where)
    chosen = np.linspace(0, len(found) - 1, min(len(found), EXAMPLES)).astype(int)
    return [[int(i % where.shape[1]), int(i // where.shape[1])] for i in found[chosen]]

"""Counts a comparison's pixels by their causes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import NamedTuple

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
    differ: int
    explained: int
    unexplained: int
    not_decidable: int
    not_traced: int
    by_cause: Mapping[str, int]  # by the causes' keys, but for pixels that agree or are not traced

    def of_causes(self) -> Iterator[tuple[Cause, int]]:
        """Yield the causes that some pixels have, and how many do."""
        for cause in sorted(CAUSES):
            if count := self.by_cause.get(cause.key):
                yield cause, count

    @classmethod
    def of(cls, cause: Bytes) -> Counts:
        """Count pixels of any shape by the numbers of their causes."""
        count = {c: int((cause == c).sum()) for c in sorted(CAUSES)}
        explained = sum(n for c, n in count.items() if c.explains)
        return cls(
            cause.size,
            count[AGREE],
            explained + count[UNEXPLAINED],
            explained,
            count[UNEXPLAINED],
            count[NOT_DECIDABLE],
            count[NOT_TRACED],
            {c.key: n for c, n in count.items() if c not in (AGREE, NOT_TRACED)},
        )

    def to_dict(self) -> dict[str, object]:
        """Return them as JSON can hold them; what is not known is left out."""
        known = {name: value for name, value in asdict(self).items() if value is not None}
        return {k: v._asdict() if hasattr(v, "_asdict") else v for k, v in known.items()}


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
    whole = Counts.of(cause)
    return PixelCounts(
        **vars(whole),
        interior=Counts.of(cause[~at_boundary]),
        boundary=Counts.of(cause[at_boundary]),
        examples={c.key: _places(cause == c) for c, _ in whole.of_causes()},
        not_judged=NotJudged(
            len(blind), len(blind) / max(cause.size, 1), dict(by_feature.most_common())
        ),
        behind=None
        if causes.behind is None
        else BehindCount(int(causes.behind.sum()), int((causes.behind & wrong).sum())),
        unexplained_shows=identity and identity.shows(wrong),
    )


def _places(where: Bools) -> list[list[int]]:
    """Return some pixels, spread evenly over all, as [x, y] from the lower left."""
    found = np.flatnonzero(where)
    chosen = np.linspace(0, len(found) - 1, min(len(found), EXAMPLES)).astype(int)
    return [[int(i % where.shape[1]), int(i // where.shape[1])] for i in found[chosen]]

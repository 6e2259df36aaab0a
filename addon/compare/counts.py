"""Counts a comparison's pixels by their causes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..arrays import Bools, Bytes
from .cause import AGREE, NOT_DECIDABLE, NOT_TRACED, UNEXPLAINED, Causes
from .causes import CAUSES
from .identity import Identity

EXAMPLES = 10  # pixels named of each cause


def count_pixels(
    causes: Causes,
    at_boundary: Bools,
    identity: Identity | None = None,
    features: Sequence[str] = (),
) -> dict[str, Any]:
    """Count pixels by their causes: all of them, then those at boundaries and inside.

    total = agree + differ + not_decidable + not_traced, and differ = explained + unexplained.

    Parameters
    ----------
    causes : Causes
        Of each pixel (h, w).
    at_boundary : (h, w) bool
    identity : Identity, optional
        Which objects are shown. Then `unexplained_shows` counts how many unexplained pixels show
        the same object in a wrong colour, and how many a wrong object.
    features : sequence of str
        What the tracer does not model; `not_judged` counts the pixels in which one of these would
        excuse a fault. `behind` counts those in which what is behind glass was judged.

    Returns
    -------
    dict
        As JSON can hold it. `examples` has some pixels of each cause, spread over them, [x, y] of
        the region from its lower left.
    """
    cause = causes.cause
    out = _counts(cause)
    out["interior"] = _counts(cause[~at_boundary])
    out["boundary"] = _counts(cause[at_boundary])
    out["examples"] = {
        c.key: _positions(cause == c) for c in sorted(CAUSES) if out["by_cause"].get(c.key)
    }
    blind = causes.blind[causes.blind >= 0]
    found, count = np.unique(blind, return_counts=True)
    by_feature: Counter[str] = Counter()
    for n, many in zip(found, count, strict=True):
        by_feature[features[n]] += int(many)
    out["not_judged"] = {
        "pixels": len(blind),
        "share": len(blind) / max(cause.size, 1),
        "by_feature": dict(by_feature.most_common()),
    }
    if causes.behind is not None:
        wrong = causes.behind & (cause == UNEXPLAINED)
        out["behind"] = {"pixels": int(causes.behind.sum()), "unexplained": int(wrong.sum())}
    if identity is not None:
        out["unexplained_shows"] = identity.counts(cause == UNEXPLAINED)
    return out


def _counts(cause: Bytes) -> dict[str, Any]:
    count = {c: int((cause == c).sum()) for c in sorted(CAUSES)}
    explained = sum(n for c, n in count.items() if c.explains)
    return {
        "total": cause.size,
        "agree": count[AGREE],
        "differ": explained + count[UNEXPLAINED],
        "explained": explained,
        "unexplained": count[UNEXPLAINED],
        "not_decidable": count[NOT_DECIDABLE],
        "not_traced": count[NOT_TRACED],
        "by_cause": {
            c.key: n for c, n in count.items() if c.explains or c in (UNEXPLAINED, NOT_DECIDABLE)
        },
    }


def _positions(where: Bools) -> list[list[int]]:
    """Return some pixels, spread evenly over all, as [x, y] from the lower left."""
    found = np.flatnonzero(where)
    chosen = np.linspace(0, len(found) - 1, min(len(found), EXAMPLES)).astype(int)
    return [[int(i % where.shape[1]), int(i // where.shape[1])] for i in found[chosen]]

"""How many pixels each cause has: the score."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .cause import EXPLAINED, Cause, Causes
from .identity import Identity

EXAMPLES = 10  # pixels named of each cause
_COUNTED = tuple(c for c in Cause if c not in (Cause.AGREE, Cause.NOT_TRACED))


def count_pixels(
    causes: Causes, at_boundary: NDArray[np.bool_], identity: Identity | None = None
) -> dict[str, Any]:
    """Count pixels by what is said of them, and those at boundaries and inside apart.

    total = agree + differ + not_decidable + not_traced, and differ = explained + unexplained. The
    `examples` are some pixels of each cause, spread over them, [x, y] of the region from its
    lower left. Where it is known whose surfaces are shown, `unexplained_shows` says whether what is
    unexplained is a wrong colour (the same object) or a wrong object.
    """
    cause = causes.cause
    out = _counts(cause)
    out["interior"] = _counts(cause[~at_boundary])
    out["boundary"] = _counts(cause[at_boundary])
    shown = (c for c in Cause if c not in (Cause.AGREE, Cause.NOT_DECIDABLE, Cause.NOT_TRACED))
    out["examples"] = {
        c.name.lower(): _positions(cause == c) for c in shown if out["by_cause"][c.name.lower()]
    }
    if identity is not None:
        out["unexplained_shows"] = identity.counts(cause == Cause.UNEXPLAINED)
    return out


def _counts(cause: NDArray[np.uint8]) -> dict[str, Any]:
    count = {c: int((cause == c).sum()) for c in Cause}
    explained = sum(count[c] for c in EXPLAINED)
    return {
        "total": cause.size,
        "agree": count[Cause.AGREE],
        "differ": explained + count[Cause.UNEXPLAINED],
        "explained": explained,
        "unexplained": count[Cause.UNEXPLAINED],
        "not_decidable": count[Cause.NOT_DECIDABLE],
        "not_traced": count[Cause.NOT_TRACED],
        "by_cause": {c.name.lower(): count[c] for c in _COUNTED},
    }


def _positions(where: NDArray[np.bool_]) -> list[list[int]]:
    """Return some pixels, spread evenly over all, as [x, y] from the lower left."""
    found = np.flatnonzero(where)
    chosen = np.linspace(0, len(found) - 1, min(len(found), EXAMPLES)).astype(int)
    return [[int(i % where.shape[1]), int(i // where.shape[1])] for i in found[chosen]]

"""How many pixels each cause has: the score, at the boundaries of what is traced and inside."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..tracer.frame import Frame
from .cause import Cause, Causes
from .identity import Identity

EXAMPLES = 10  # pixels named of each cause


def boundary(frame: Frame) -> NDArray[np.bool_]:
    """Return which pixels see, with the eight around them, more than one appearance of an object.

    The background is one, too. Beyond the picture's rim is what its outermost pixels see.
    """
    seen = np.pad(frame.instance_index, 1, mode="edge")
    out = np.zeros(frame.instance_index.shape, bool)
    height, width = out.shape
    for y in range(3):
        for x in range(3):
            out |= seen[y : y + height, x : x + width] != frame.instance_index
    return out


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
    out["examples"] = {
        c.key: _positions(cause == c) for c in sorted(Cause) if c.differs and out["by_cause"][c.key]
    }
    if identity is not None:
        out["unexplained_shows"] = identity.counts(cause == Cause.UNEXPLAINED)
    return out


def _counts(cause: NDArray[np.uint8]) -> dict[str, Any]:
    count = {c: int((cause == c).sum()) for c in sorted(Cause)}
    explained = sum(n for c, n in count.items() if c.explains)
    return {
        "total": cause.size,
        "agree": count[Cause.AGREE],
        "differ": explained + count[Cause.UNEXPLAINED],
        "explained": explained,
        "unexplained": count[Cause.UNEXPLAINED],
        "not_decidable": count[Cause.NOT_DECIDABLE],
        "not_traced": count[Cause.NOT_TRACED],
        "by_cause": {c.key: n for c, n in count.items() if c.differs or c is Cause.NOT_DECIDABLE},
    }


def _positions(where: NDArray[np.bool_]) -> list[list[int]]:
    """Return some pixels, spread evenly over all, as [x, y] from the lower left."""
    found = np.flatnonzero(where)
    chosen = np.linspace(0, len(found) - 1, min(len(found), EXAMPLES)).astype(int)
    return [[int(i % where.shape[1]), int(i // where.shape[1])] for i in found[chosen]]

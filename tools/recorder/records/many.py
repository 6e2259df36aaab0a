"""`certified/many.py`: which pairs are left out together, by signs of integers in numpy's arrays.

Of an array of objects numpy compares one by one, and asks Python how each comparison turns out:
each such question is a branch.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from reference_tracer.certified import many
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.certified.integers import ZERO

from ..whole import whole
from .integers import CORNERS, RAY, WholeRecord, Z, batch

# The rays of a batch, by what they share; the first of them is recorded.
_RAYS = {
    "from_point": {"directions": [whole(RAY), ZERO]},
    "parallel": {"origins": [whole(CORNERS[0]), ZERO]},
    "alone": {"origins": [whole(CORNERS[0]), ZERO], "directions": [whole(RAY), ZERO]},
}


def found(of: IntegerBatch, rays: Sequence[int], surfaces: Sequence[int], pair: int = 0) -> str:
    """Return what `hits` has for one of some pairs: None, or what `IntegerBatch.hit` finds of it.

    That is recorded by itself.
    """
    of.hit = lambda ray, surface: "found" if (ray, surface) == (rays[pair], surfaces[pair]) else ""
    return many.hits(of, np.array(rays), np.array(surfaces))[pair] or "None"


def _record(name: str, shared: str, surface: int, note: str) -> WholeRecord:
    return WholeRecord(
        f"whole_many_{name}",
        "many.hits",
        f"(found : option Hit) {Z.format(' '.join((RAY, *CORNERS)))}",
        "option Hit",
        lambda: found(batch(**_RAYS[shared], planes=[(ZERO, ZERO)]), [0], [surface]),
        f"IntegersCode.many_{name}_is",
        note,
    )


MANY = (
    _record("from_point", "from_point", 1, "of a triangle, rays from one point"),
    _record("parallel", "parallel", 1, "of a triangle, parallel rays"),
    _record("alone", "alone", 1, "of a triangle, rays that share nothing"),
    _record("plane", "from_point", 0, "of a plane"),
)

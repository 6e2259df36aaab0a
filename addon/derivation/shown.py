"""A derivation as a page shows it: the lecture, and the numbers of its drawings, for JSON.

The page's own `lecture.js` lays it out, and `drawing.js` draws it.
"""

from __future__ import annotations

import numpy as np

from .derivation import Derivation
from .document import lecture
from .textbook import Arithmetic


def shown(derivation: Derivation) -> dict[str, object]:
    """Return what the page's schema has as a derivation."""
    pixel = derivation.pixel
    return {
        "pixel": [pixel.x, pixel.y],
        "blocks": [_data(block) for block in lecture(derivation)],
        "drawn": _drawn(derivation),
    }


def _data(value: object) -> object:
    """Return blocks and cells as dicts that say what they are."""
    if not isinstance(value, tuple):
        return value
    if not hasattr(value, "_asdict"):
        return [_data(part) for part in value]
    fields = {name: _data(part) for name, part in value._asdict().items()}
    return {"is": type(value).__name__.lower(), **fields}


def _drawn(derivation: Derivation) -> dict[str, object]:
    """Return the float64 steps to what is seen, else to the first candidate; null: not finite."""
    test = derivation.seen_test or next(iter(derivation.tests), None)
    quantities = (*derivation.camera, *derivation.ray, *(test.quantities if test else ()))
    steps = {q.key: [*map(float, q.values[Arithmetic.FLOAT64])] for q in quantities}
    return {
        "projection": derivation.pixel.camera.projection.name,
        "title": test.candidate.title if test else "",
        "steps": {k: [v if np.isfinite(v) else None for v in of] for k, of in steps.items()},
    }

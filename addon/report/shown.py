"""A derivation as pages show it: the lecture, and the numbers of its drawings, for JSON.

`lecture.js` lays it out, and `drawing.js` draws it.
"""

from __future__ import annotations

import numpy as np

from ..derivation.derivation import Derivation
from ..derivation.document import lecture
from ..derivation.textbook import Arithmetic


def shown(derivation: Derivation) -> dict[str, object]:
    """Return what the page's schema has as a derivation."""
    pixel = derivation.pixel
    return {
        "pixel": [pixel.x, pixel.y],
        "blocks": data(lecture(derivation)),
        "drawn": _drawn(derivation),
    }


def data(value: object) -> object:
    """Return named tuples, and what is in them, as dicts that say what they are."""
    if not isinstance(value, (tuple, list)):
        return value
    parts = [data(part) for part in value]
    names = getattr(value, "_fields", None)
    if names is None:
        return parts
    return {"is": type(value).__name__.lower(), **dict(zip(names, parts, strict=True))}


def _drawn(derivation: Derivation) -> dict[str, object]:
    """Return the float64 steps to the surface seen, else to the first candidate; null: infinite."""
    test = derivation.seen_test or next(iter(derivation.tests), None)
    quantities = (*derivation.camera, *derivation.ray, *(test.quantities if test else ()))
    steps = {q.key: [*map(float, q.values[Arithmetic.FLOAT64])] for q in quantities}
    return {
        "projection": derivation.pixel.camera.projection.name,
        "title": test.candidate.title if test else "",
        "steps": {k: [v if np.isfinite(v) else None for v in of] for k, of in steps.items()},
    }

"""Writes a derivation as JSON.

No number is cut short. A float is a JSON number that means it to the bit; inf and NaN,
which JSON lacks, are strings. An exact number is
{"decimal": "…", "rational": "numerator/denominator"}.
"""

from __future__ import annotations

import json
from fractions import Fraction

import numpy as np

from .derivation import Derivation, Quantity, Test
from .digits import digits_text, exact_text, ulps
from .pixel import Answer
from .textbook import FLOATS, Number

SCHEMA = "reference_tracer.derivation/2"


def json_text(derivation: Derivation) -> str:
    """Return the JSON text."""
    return json.dumps(to_dict(derivation), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def to_dict(derivation: Derivation) -> dict[str, object]:
    """Return a derivation in dicts, lists, strings and numbers."""
    pixel, camera = derivation.pixel, derivation.pixel.camera
    return {
        "schema": SCHEMA,
        "source": pixel.source,
        "pixel": {"x": pixel.x, "y": pixel.y, "column": pixel.column, "row": pixel.row},
        "camera": {
            "name": camera.name,
            "projection": camera.projection.name,
            "width": camera.width,
            "height": camera.height,
            "clip_start": number(np.float64(camera.clip_start)),
            "clip_end": number(np.float64(camera.clip_end)),
            "steps": [_quantity(q) for q in derivation.camera],
        },
        "ray": [_quantity(q) for q in derivation.ray],
        "candidates": [_test(t) for t in derivation.tests],
        "scene": {
            "triangles": pixel.triangles,
            "candidates_left_out": pixel.left_out,
            "not_finite": pixel.refused,
        },
        "nearest": dict(derivation.nearest),
        "answers": [_answer(a, derivation) for a in derivation.answers],
        "certified": _answer(derivation.certified, derivation)
        | {
            "certainty": derivation.certified.certainty.name.lower(),
            "may_be_seen": [
                {"object": derivation.title_of(n), "instance": n[0], "triangle": n[1]}
                for n in sorted(derivation.certified.ties)
            ],
        },
        "color": {
            "linear_rgba": [number(np.float64(c)) for c in derivation.color],
            "steps": [_quantity(q) for q in derivation.shading],
        },
    }


def _quantity(quantity: Quantity) -> dict[str, object]:
    return {
        "key": quantity.key,
        "label": quantity.formula.label,
        "formula": quantity.formula.right,
        "components": [_component(quantity, k) for k in range(quantity.count)],
    }


def _component(quantity: Quantity, index: int) -> dict[str, object]:
    exact = quantity.exact(index)
    out: dict[str, object] = {kind: number(quantity.values[kind][index]) for kind in FLOATS}
    out["exact"] = None if exact is None else number(exact)
    off = {kind: ulps(quantity.values[kind][index], exact) for kind in FLOATS}
    out["ulp"] = {kind: None if v is None or np.isinf(v) else v for kind, v in off.items()}
    return out


def number(value: Number) -> object:
    """Return a number as JSON has it."""
    if isinstance(value, Fraction):
        rational = f"{value.numerator}/{value.denominator}"
        return {"decimal": exact_text(value), "rational": rational}
    return float(digits_text(value)) if np.isfinite(value) else digits_text(value)


def _test(test: Test) -> dict[str, object]:
    c = test.candidate
    return {
        "object": c.object,
        "kind": "plane" if c.is_plane else "triangle",
        "mesh": c.mesh,
        "instance": c.instance,
        "triangle": c.triangle,
        "slot": c.slot,
        "colors": [[number(v) for v in color] for color in c.colors.astype(float)],
        "steps": [_quantity(q) for q in test.quantities],
        "judgements": {
            kind: {
                "accepted": j.accepted,
                "as_printed": j.literal,
                "reasons": [{"code": r.value, "sentence": r.sentence} for r in j.reasons],
            }
            for kind, j in test.judgements.items()
        },
    }


def _answer(answer: Answer, derivation: Derivation) -> dict[str, object]:
    return {
        "method": answer.method.value,
        "precision": answer.precision.value,
        "object": derivation.title_of(answer.seen),
        "instance": answer.seen[0],
        "triangle": answer.seen[1],
        "t": number(np.float64(answer.t)),
    }

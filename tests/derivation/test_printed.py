"""Markdown has the numbers of the JSON, rounded, and their errors."""

from __future__ import annotations

import json
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.derivation import document, writers
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.digits import EXACT_DIGITS, ulps

from . import printed

PIXELS = ((12, 9), (3, 2), (16, 13), (0, 17), (23, 0))


@pytest.fixture
def derivations(ball_scene):
    return [derive(ball_scene, x, y, limit=4) for x, y in PIXELS]


@np.errstate(all="ignore")
def test_markdown_has_the_numbers_of_the_json(derivations):
    compared = 0
    for d in derivations:
        content = json.loads(writers.json_text(d))
        steps = [content["camera"]["steps"], content["ray"]]
        steps += [c["steps"] for c in content["candidates"]]
        tables = printed.tables(document.document_markdown(d))
        for (_, columns, off), own in zip(tables, steps, strict=True):
            for kind in ("float32", "float64"):
                held = from_json(own, kind)
                np.testing.assert_equal(columns[kind], held)
                compared += len(held)
            compared += rounded(from_json(own, "exact"), columns["exact"])
            check_errors(columns, off)
        for test, (heading, *_) in zip(d.tests, tables[2:], strict=True):
            assert test.candidate.title in heading.replace("\\", "")
    assert compared > 500


def rounded(truth, column):
    """Whether printed decimals are these numbers, rounded; returns how many."""
    assert truth.keys() == column.keys()
    for label, shown in column.items():
        exact, decimal = truth[label], Decimal(shown.replace("…", ""))
        rest = abs(Fraction(decimal) - exact)
        assert ("…" in shown) == bool(rest), label
        unit = Fraction(10) ** (decimal.adjusted() - EXACT_DIGITS + 1)
        assert 2 * rest <= unit, (label, shown, float(exact))
    return len(column)


def check_errors(columns, off):
    """The errors in ulp, from the float and the exact number beside it, to the digits printed."""
    for label, pair in off.items():
        if label not in columns["exact"]:
            assert pair == ("–", "–")
            continue
        exact = printed.as_fraction(columns["exact"][label])
        for kind, shown in zip(("float32", "float64"), pair, strict=True):
            value = ulps(columns[kind][label], exact)
            if value is None:
                assert shown == "–", label
            else:  # of two digits; and the exact number is printed with 24
                assert abs(float(shown) - value) <= 0.051 * value + 1e-6, (label, shown, value)


def from_json(steps, kind):
    """{label: number} of a list of steps; fractions are whole."""
    out = {}
    for step in steps:
        for k, component in enumerate(step["components"]):
            label = step["label"] + (f".{'xyz'[k]}" if len(step["components"]) == 3 else "")
            value = component[kind]
            if kind == "exact" and value is not None:
                out[label] = Fraction(value["rational"])
            elif kind != "exact":
                out[label] = np.dtype(kind).type(float(value))
    return out

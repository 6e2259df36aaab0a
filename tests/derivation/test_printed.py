"""Every number that is printed follows from those printed before it, in Markdown and in JSON."""

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
from .printed import Printed, flat

PIXELS = ((12, 9), (3, 2), (16, 13), (0, 17), (23, 0))


def check(made, column):
    """What was made is what was printed; returns how many numbers were compared."""
    with np.errstate(all="ignore"):
        for label, value in flat(made).items():
            np.testing.assert_array_equal(value, column[label], err_msg=label)
    return len(flat(made))


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
                assert held.keys() == columns[kind].keys()
                compared += check(held, columns[kind])
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
    out = Printed()
    for step in steps:
        for k, component in enumerate(step["components"]):
            label = step["label"] + (f".{'xyz'[k]}" if len(step["components"]) == 3 else "")
            value = component[kind]
            if kind == "exact" and value is not None:
                out[label] = Fraction(value["rational"])
            elif kind != "exact":
                out[label] = np.dtype(kind).type(float(value))
    return out


@np.errstate(all="ignore")
def test_json(derivations):
    for d in derivations:
        content = json.loads(writers.json_text(d))
        assert content == json.loads(json.dumps(writers.to_dict(d)))
        camera, pixel = content["camera"], content["pixel"]
        size = camera["width"], camera["height"], pixel["column"], pixel["row"]
        stored = from_json(content["ray"], "float64")
        for kind in ("float32", "float64", "exact"):
            p, ray = from_json(camera["steps"], kind), from_json(content["ray"], kind)
            made = printed.camera(p, *size, camera["projection"] == "orthographic")
            if kind == "float32":  # a pixel's size is float64's, rounded
                made |= {k: np.float32(from_json(camera["steps"], "float64")[k]) for k in "wh"}
            check(made, p)
            given_as_stored(camera["steps"], made)
            if kind != "exact":  # from the ray on, the truth is about what float64 has stored
                assert ray == {k: v for k, v in p.items() if k[0] in "od"}
            for c in content["candidates"]:
                make = printed.plane if c["kind"] == "plane" else printed.triangle
                table = from_json(c["steps"], kind)
                made = make(table, ray)
                assert check(made, table) >= 6
                given_as_stored(c["steps"], made)
        assert from_json(content["ray"], "exact") == {
            k: Fraction(float(v)) for k, v in stored.items()
        }
        check_verdicts(content)


def given_as_stored(steps, made):
    """What no formula makes is exactly what float64 has stored."""
    stored, exact = from_json(steps, "float64"), from_json(steps, "exact")
    for label in stored.keys() - flat(made).keys():
        if label in exact:
            assert exact[label] == Fraction(float(stored[label])), label


def check_verdicts(content):
    """Accept and reject, and the nearest, from the numbers in the JSON."""
    start, end = content["camera"]["clip_start"], content["camera"]["clip_end"]
    for kind, allowed in (("float32", 1e-6), ("float64", 1e-9), ("exact", 0)):
        best = None
        for k, c in enumerate(content["candidates"]):
            p, said = from_json(c["steps"], kind), c["judgements"][kind]
            accepted = "t" in p and bool(start <= p["t"] <= end)
            if c["kind"] == "triangle" and accepted:
                accepted = all(0 <= p[s] <= 1 for s in ("s₁", "s₂", "s₃"))
                sum_ = p["s₁ + s₂ + s₃"]
                accepted = accepted and abs(sum_ - 1) <= allowed
                assert said["as_printed"] == (accepted and bool(sum_ == 1))
            assert said["accepted"] == accepted != bool(said["reasons"])
            order = (p["t"], c["instance"], c["triangle"]) if accepted else None
            if accepted and (best is None or order < best[0]):
                best = order, k
        assert content["nearest"][kind] == (None if best is None else best[1])

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
def test_markdown(derivations):
    compared = 0
    for d in derivations:
        tables = printed.tables(document.document_markdown(d))
        assert len(tables) == 2 + len(d.tests)
        (_, camera, _), (_, ray, _), *tests = tables
        c = d.pixel.camera
        size = c.width, c.height, d.pixel.column, d.pixel.row, c.projection.shares_direction
        for kind in ("float32", "float64"):
            made = printed.camera(camera[kind], *size)
            if kind == "float32":  # a pixel's size is float64's, rounded
                made |= {k: np.float32(camera["float64"][k]) for k in "wh"}
            compared += check(made, camera[kind])
            assert ray[kind] == {k: v for k, v in camera[kind].items() if k[0] in "od"}
            for test, (heading, table, _) in zip(d.tests, tests, strict=True):
                assert test.candidate.title in heading.replace("\\", "")
                make = printed.plane if test.candidate.is_plane else printed.triangle
                compared += check(make(table[kind], ray[kind]), table[kind])
        compared += exactly(d, camera, ray, tests)
        for _, columns, off in tables:
            check_errors(columns, off)
    assert compared > 500


def exactly(d, camera, ray, tests):
    """Exact numbers, from the floats that are their input, rounded to what is printed."""
    c, inputs = d.pixel.camera, Printed()
    for label in ("u_min", "u_max", "v_min", "v_max"):
        inputs[label] = Fraction(float(camera["float64"][label]))
    for name in ("right", "up", "forward", "e"):
        inputs |= {f"{name}.{k}": Fraction(float(camera["float64"][f"{name}.{k}"])) for k in "xyz"}
    size = c.width, c.height, d.pixel.column, d.pixel.row, c.projection.shares_direction
    compared = rounded(grown(lambda p: printed.camera(p, *size), inputs), camera["exact"])
    line = Printed({k: Fraction(float(v)) for k, v in ray["float64"].items()})
    compared += rounded(line, ray["exact"])
    for test, (_, table, _) in zip(d.tests, tests, strict=True):
        plane = test.candidate.is_plane
        names = ("p", "n") if plane else ("p₁", "p₂", "p₃")
        corners = Printed(
            {
                f"{n}.{k}": Fraction(float(table["float64"][f"{n}.{k}"]))
                for n in names
                for k in "xyz"
            }
        )
        make = printed.plane if plane else printed.triangle
        compared += rounded(grown(lambda p, m=make: m(p, line), corners), table["exact"])
    return compared


class Growing(Printed):
    """Numbers that are not there yet are made from those that are, when they are asked for."""

    def __missing__(self, label):
        return Fraction(1, 7)  # of a step that comes later in the same table, and is made again


def grown(make, given):
    """All that follows from what is given: as often as steps stand on one another."""
    p = Growing(given)
    p["t"] = Fraction(1, 7)
    for _ in range(8):
        p |= {k: v for k, v in flat(make(p)).items() if k not in given}
    return p


def rounded(truth, column):
    """Whether printed decimals are these numbers, rounded; returns how many."""
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
        for kind in ("float32", "float64", "exact"):
            p, ray = from_json(camera["steps"], kind), from_json(content["ray"], kind)
            made = printed.camera(p, *size, camera["projection"] == "orthographic")
            if kind == "float32":
                made |= {k: np.float32(from_json(camera["steps"], "float64")[k]) for k in "wh"}
            check(made, p)
            for c in content["candidates"]:
                make = printed.plane if c["kind"] == "plane" else printed.triangle
                table = from_json(c["steps"], kind)
                assert check(make(table, ray), table) >= 6
        stored = from_json(content["ray"], "float64")
        assert from_json(content["ray"], "exact") == {
            k: Fraction(float(v)) for k, v in stored.items()
        }
        check_verdicts(content)


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

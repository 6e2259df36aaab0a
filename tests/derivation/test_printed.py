"""The tables of numbers, and the JSON, have the derivation's own, with their errors."""

from __future__ import annotations

import json
from fractions import Fraction

import numpy as np
import pytest
from reference_tracer.derivation import document, writers
from reference_tracer.derivation.blocks import Heading, Table
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.digits import exact_text, off_text, ulps
from reference_tracer.derivation.textbook import FLOATS

PIXELS = ((12, 9), (3, 2), (16, 13), (0, 17), (23, 0))


@pytest.fixture
def derivations(ball_scene):
    return [derive(ball_scene, x, y, limit=4) for x, y in PIXELS]


def components(derivation):
    """Each number of the camera, the ray and the tests: its quantity, and which component."""
    of_tests = [test.quantities for test in derivation.tests]
    every = [derivation.camera, derivation.ray, *of_tests]
    return [[(q, k) for q in quantities for k in range(q.count)] for quantities in every]


def same(shown, value):
    return np.array_equal(type(value)(float(shown)), value, equal_nan=True)


@np.errstate(all="ignore")
def test_tables_have_the_numbers_and_their_errors(derivations):
    compared = 0
    for d in derivations:
        lecture = document.lecture(d)
        tables = [
            block for block in lecture if isinstance(block, Table) and block.kind == "numbers"
        ]
        for table, own in zip(tables, components(d), strict=True):
            for row, (q, k) in zip(table.rows, own, strict=True):
                exact = q.exact(k)
                assert str(row[-1]) == ("undefined" if exact is None else exact_text(exact))
                for kind, shown, off in zip(FLOATS, row[2::2], row[3::2], strict=False):
                    value = q.values[kind][k]
                    assert same(str(shown), value) and off == off_text(ulps(value, exact))
                    compared += 1
        titles = [
            block.text for block in lecture if isinstance(block, Heading) and block.level == 3
        ]
        for title, test in zip(titles, d.tests, strict=True):
            assert test.candidate.title in title
    assert compared > 500


def test_the_json_has_the_numbers(derivations):
    for d in derivations:
        content = json.loads(writers.json_text(d))
        steps = [content["camera"]["steps"], content["ray"]]
        steps += [candidate["steps"] for candidate in content["candidates"]]
        for held, own in zip(steps, components(d), strict=True):
            parts = [part for step in held for part in step["components"]]
            for part, (q, k) in zip(parts, own, strict=True):
                exact = q.exact(k)
                rational = part["exact"] and Fraction(part["exact"]["rational"])
                assert rational == exact
                for kind in FLOATS:
                    assert same(part[kind], q.values[kind][k])
                    off = ulps(q.values[kind][k], exact)
                    assert part["ulp"][kind] == (None if off == np.inf else off)

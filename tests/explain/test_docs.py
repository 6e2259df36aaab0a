"""What docs/explain.md says in its own words; tests/test_docs.py has what the program makes."""

from __future__ import annotations

from pathlib import Path

from reference_tracer.explain import reproducer
from reference_tracer.explain.arithmetic import Arithmetic
from reference_tracer.explain.derivation import derive_pixel

PROJECT = Path(__file__).resolve().parents[2]


def test_what_it_says_of_its_pixel():
    found = derive_pixel(reproducer.read(PROJECT / "docs" / "pixel.json"))
    first = found.tests[0]
    assert found.seen is first.candidate
    accepted = [first.judgements[kind].accepted for kind in Arithmetic]
    assert accepted == [False, True, True]  # float32 lets the ray through
    assert first.judgements[Arithmetic.FLOAT64].literal is False  # and the printed test, float64's

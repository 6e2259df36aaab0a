"""What docs/explain.md says in its own words; tests/test_docs.py has what the program makes."""

from __future__ import annotations

from pathlib import Path

from reference_tracer.derivation import reproducer
from reference_tracer.derivation.derivation import derive_pixel
from reference_tracer.derivation.textbook import Arithmetic

PROJECT = Path(__file__).resolve().parents[2]


def test_what_it_says_of_its_pixel():
    found = derive_pixel(reproducer.read(PROJECT / "docs" / "pixel.json"))
    first = found.tests[0]
    assert found.seen is first.candidate
    accepted = [first.judgements[kind].accepted for kind in Arithmetic]
    assert accepted == [False, True, True]
    assert first.judgements[Arithmetic.FLOAT64].literal is False  # the printed test
    seen = {(a.method, a.precision): a.seen[1] for a in found.answers}
    assert seen["textbook", "float32"] == 656 and seen["textbook_literal", "float64"] == 633
    by_triangle = {t.candidate.triangle: t for t in found.tests}
    neighbour = [by_triangle[656].judgements[kind].accepted for kind in Arithmetic]
    assert neighbour == [True, False, False]
    assert by_triangle[633].judgements[Arithmetic.FLOAT64].accepted
    edge = {tuple(c) for c in by_triangle[656].candidate.points} & {
        tuple(c) for c in first.candidate.points[:2]
    }
    assert len(edge) == 2  # p₁ and p₂

"""The one formatter of text tables, and the numbers in its cells."""

from __future__ import annotations

from reference_tracer.report.tables import percent


def test_percent_does_not_round_to_all_or_none():
    shares = 0, 1e-9, 0.5, 1 - 1e-9, 1
    assert [percent(v) for v in shares] == ["0", "0.1", "50.0", "99.9", "100"]

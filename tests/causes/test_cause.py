"""The causes' records: none contradicts itself, none can be changed, all are told apart."""

from __future__ import annotations

from dataclasses import FrozenInstanceError

import pytest
from reference_tracer.causes.explain import BY_NUMBER, CAUSES, CLIP_PLANE, EDGE

from .colors import clash, free

APART = "agree", "not_decidable", "unexplained", "not_traced"  # in the counts


def test_a_record_stays_as_it_is():
    with pytest.raises(FrozenInstanceError):
        EDGE.label = "oops"
    assert EDGE.label == "edge"


@pytest.mark.parametrize("cause", CAUSES, ids=lambda cause: cause.key)
def test_no_record_contradicts_itself(cause):
    """A cause that warns without explaining would be missing in the counts, and on the page."""
    assert cause.explains != (cause.key in APART)
    assert cause.explains or not cause.rounding
    assert cause.explains or cause.key == "not_decidable" or not cause.warns
    assert (cause.color is None) == (cause.key == "agree")
    assert ("{figure" in cause.sentence) == (cause.unit not in ("", "index"))
    assert ("{name" in cause.sentence) == (cause.unit == "index")


def test_colours_are_told_apart_whatever_colours_one_sees():
    colors = {c.key: c.color for c in CAUSES if c.color}
    assert not clash(colors)
    colors["another"] = 0.95, 0.3, 0.0
    said = clash(colors)
    assert said.startswith("edge and another are 2.6 apart (vision: none)")
    colors["another"] = free(colors)
    assert str(colors["another"]) in said and not clash(colors)


def test_records_are_told_apart():
    following = max(CAUSES) + 1
    assert len({*CAUSES}) == len(CAUSES), f"two have one number: {following} is the next"
    for name in ("number", "key", "label", "sentence", "color"):
        assert len({getattr(c, name) for c in CAUSES}) == len(CAUSES)
    assert [c.key for c in sorted(CAUSES)][:3] == ["agree", "edge", "depth_tie"]  # in frame.npz
    for cause in CAUSES:
        assert "Blender" not in cause.sentence  # any program's picture may have it
        assert cause.in_words(0.5, 1.0, "hair") and BY_NUMBER[cause.number] is cause
    assert {c.key for c in CAUSES if c.rounding} == {EDGE.key, "depth_tie", CLIP_PLANE.key}

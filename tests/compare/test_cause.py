"""The causes' records, and the errand: a new cause is its record and its check, nothing else."""

from __future__ import annotations

import json

import numpy as np
import pytest
from reference_tracer.compare import causes
from reference_tracer.compare.cause import _LISTED, Cause, Record
from reference_tracer.compare.comparison import compare
from reference_tracer.rendering import render
from reference_tracer.report.comparison import difference_picture
from reference_tracer.report.page.content import _hex, content
from reference_tracer.tracer.progress import result_of

from .cases import case_of

COMET = Record(
    "comet",
    "a comet passed {figure:.0f} km away (seen up to {allowed:.0f} km)",
    "km",
    (0.9, 0.8, 0.1),
    explains=True,
    warns=True,
)


@pytest.fixture
def comet(monkeypatch):
    """Add a cause as a line in its class, its record and one among the checks would."""
    member = int.__new__(Cause, 42)
    member._name_, member._value_ = "COMET", 42
    vars(member).update(vars(COMET))
    monkeypatch.setattr(Cause, "_member_names_", [*Cause._member_names_, "COMET"])
    monkeypatch.setitem(Cause._member_map_, "COMET", member)
    monkeypatch.setitem(Cause._value2member_map_, 42, member)

    def check(pixels):
        white = (pixels.picture.color == 1).all(axis=-1)
        pixels.settle(pixels.open & white, member, 7.0, 9.0)
        yield 1.0

    monkeypatch.setattr(causes, "CHECKS", [(check, 1.0), *causes.CHECKS])
    return member


def test_a_new_cause_is_everywhere_by_its_record_and_its_check(room, comet):
    frame = render(room)
    color = frame.color.copy()
    color[3:5, 4:9] = 1
    found = result_of(compare(case_of(room, color), frame))
    pixels = found.pixels
    assert pixels["by_cause"]["comet"] == pixels["explained"] == pixels["differ"] == 10
    assert pixels["unexplained"] == 0 and found.verdict == "warnings"
    assert pixels["examples"]["comet"][0] == [4, 3]
    assert "  comet: 10, as at (4, 3)" in "\n".join(found.lines())
    held = json.loads(json.dumps(found.to_dict()))["causes"]["comet"]
    told = {key: getattr(COMET, key) for key in ("label", "sentence", "unit")}
    assert held == {"number": 42} | told
    assert np.array_equal(
        difference_picture(found)[3:5, 4:9, :3], np.full((2, 5, 3), COMET.color, "f4")
    )
    [entry] = [c for c in content(found)["causes"] if c["name"] == "comet"]
    assert entry["label"] == "Comet" and entry["pixels"] == 10 and entry["value"] == 42
    assert entry["color"] == _hex(COMET.color) and entry["sentence"] == COMET.sentence
    assert Cause(42).told(7.0, 9.0) == "a comet passed 7 km away (seen up to 9 km)"


def test_records_are_told_apart():
    assert [c.key for c in Cause] == list(_LISTED)  # a record each, in the order of the legend
    assert len(Cause) == len({c.label for c in Cause}) == len({c.color for c in Cause})
    assert [c.key for c in sorted(Cause)][:3] == ["agree", "edge", "depth_tie"]  # in frame.npz
    for cause in Cause:
        assert cause.told(0.5, 1.0) and (cause.color is None) == (cause is Cause.AGREE)
        assert ("{figure" in cause.sentence) == (cause.unit not in ("", "index"))
        assert ("{name" in cause.sentence) == (cause.unit == "index")
    assert {c for c in Cause if c.rounding} == {Cause.EDGE, Cause.DEPTH_TIE, Cause.CLIP_PLANE}

"""The 3D view in Rendered mode, in the real window; screenshots are left in out/gui."""

import re

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("viewport_pixels")
def test_every_kind_of_view_lies_pixel_on_pixel_over_blenders_own(noted):
    assert len(noted) == 6
    for name, found in noted.items():
        assert found["apart"] < 1e-3, name  # pixels
        assert found["colors"] > 5, name
        # Edge pixels that Blender, in float32, gives to the other side.
        assert found["differ"] < 50 and found["strange"] < 5, (name, found)
    for name in ("zoomed_border", "free_border"):
        assert noted[name]["outside"] > 0.95, name  # of what is not traced: the background


@pytest.mark.story("viewport_events")
def test_whatever_happens_to_a_view_it_shows_the_same_again_and_leaves_nothing(noted):
    assert noted.pop("left") == [0, 0, 0]
    assert len(noted) == 10
    for name, found in noted.items():
        assert found["live"] == 1 and found["same"] == 0, (name, found)
    assert noted["moved"]["coarse"] in (4, 8) and noted["moved"]["whole"] == 1
    assert noted["undone"]["changed"] > 1000
    assert noted["other_method"]["holes"] > 1000
    assert "Reference Tracer models perspective" in noted["in_words"]["said"]
    assert "not enough memory (none on the card)" in noted["in_words"]["not_drawn"]
    assert noted["in_words"]["white"] > 50 and noted["in_words"]["without"] == ""
    assert noted["two_views"]["heights"][0] < 200 < noted["two_views"]["heights"][1]
    assert noted["four_views"]["views"] == 4
    assert noted["rendered"]["done"] == ["FINISHED"]
    assert noted["loaded"]["none"] == 0


@pytest.mark.story("viewport_shows")
def test_what_each_method_sees_and_how_it_differs(noted):
    def numbers(name):
        line = noted[name]["line"]
        return [int(n.replace(",", "")) for n in re.findall(r"(?<!\w)[\d,]*\d", line)]

    wrong, total = numbers("free WRONG textbook_literal")
    assert 0.02 * total < wrong < 0.9 * total
    assert noted["free WRONG textbook_literal"]["red"] == wrong  # on the screen
    found = noted["free WRONG auto"]
    assert "none is wrong" in found["line"] and found["red"] == 0
    for view in ("free", "parallel"):
        line = noted[f"{view} DIFFERENCE auto"]["line"]
        differ, total, *_ = numbers(f"{view} DIFFERENCE auto")
        assert differ < 50 < total and "unexplained" not in line and "Blender's viewport" in line
    differ, total, *_ = numbers("far DIFFERENCE textbook_literal")
    assert differ > 100
    assert "unexplained" in noted["far DIFFERENCE textbook_literal"]["line"]
    assert sum(numbers("far CERTAINTY auto")) == total
    assert noted["drawn"] == 3
    hair = noted.pop("hair").values()
    assert [drawn for _, drawn in hair] == [5, 6, 7]
    pixels = [int(line.split()[0].replace(",", "")) for line, _ in hair]
    assert pixels[1] > 2 * pixels[2] > 0, hair  # long hair, and short
    assert noted["changed"] == noted["new"] == {}
    assert not any(found["said"] for found in noted.values() if isinstance(found, dict) and found)

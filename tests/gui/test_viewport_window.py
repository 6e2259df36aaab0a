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
        assert found["outside"] <= 3, name  # levels of the background's dither


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
    differ, total, *_ = numbers("free DIFFERENCE auto")
    line = noted["free DIFFERENCE auto"]["line"]
    assert differ < 50 < total and "unexplained" not in line and "Blender's viewport" in line
    differ, total, *_ = numbers("parallel DIFFERENCE textbook_literal")
    assert differ > 0.02 * total
    assert "unexplained" in noted["parallel DIFFERENCE textbook_literal"]["line"]
    assert sum(numbers("parallel CERTAINTY auto")) == total
    assert noted["drawn"] == 2
    assert noted["changed"] == noted["new"] == {}
    assert not any(found["said"] for found in noted.values() if isinstance(found, dict) and found)

"""The diagnosis in the window: Esc in its midst, the panel's line, the copy of the camera."""

import pytest

pytestmark = [pytest.mark.gui, pytest.mark.story("diagnosis")]


def test_esc_keeps_the_comparison(noted):
    assert noted["running_after_comparison"]
    assert noted["stopped"] == [True, True]  # while Blender made variants
    assert noted["esc"].pop("unexplained") > 100
    assert noted["esc"] == {"verdict": "differences", "diagnosed": False, "lens": True}
    assert "the comparison stays, without a diagnosis" in noted["reports"]


def test_what_is_wrong_is_told_and_applied_to_a_copy(noted):
    [told] = noted["told"]
    assert told.startswith("the focal length is +5")
    assert noted["pressed"] == ["FINISHED"]
    assert noted["copy"].pop("lens") == pytest.approx(1.05, abs=1e-3)
    assert noted["copy"] == {"name": "Camera as in the picture", "active_camera": "Camera"}
    assert noted["after_undo"] == []

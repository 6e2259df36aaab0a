"""*Select What the Camera Sees* in the window. Screenshots in out/gui."""

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("selected")
def test_objects_are_selected_and_undone(noted):
    assert noted["unseen"] == ["Within"] and noted["seen"] == ["Cube"]
    assert noted["undone"] == noted["before"]


@pytest.mark.story("selected")
def test_frames_are_cancelled_by_esc(noted):
    assert noted["running"]
    assert noted["cancelled"] == [1, noted["seen"], 1]
    assert "was cancelled; nothing was changed" in noted["reports"]

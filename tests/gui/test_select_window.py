"""*Select What the Camera Sees* in the window. Screenshots in out/gui."""

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("selected")
def test_objects_are_selected_and_undone(noted):
    assert noted["unseen"] == ["Within"] and noted["seen"] == ["Cube"]
    assert noted["undone"] == noted["before"]


@pytest.mark.story("selected")
def test_faces_behind_a_modifier_are_selected_and_undone(noted):
    assert noted["mode"] == "EDIT" and sum(noted["faces"]) == 3
    assert noted["stored"] == [int(own) for own in noted["faces"]]
    assert noted["faces_undone"] == [noted["all"], False]


@pytest.mark.story("selected")
def test_frames_are_cancelled_by_esc(noted):
    assert noted["running"]
    frame, faces, scenes = noted["cancelled"]
    assert (frame, faces, scenes) == (1, noted["all"], 1)
    assert "was cancelled; nothing was changed" in noted["reports"]

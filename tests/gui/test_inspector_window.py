"""The pixel inspector in the real window: clicks, what they find, Esc. Screenshots in out/gui."""

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("in_images")
def test_clicks_in_the_comparisons_images(noted):
    assert len(noted["running"]) == 1  # by a click on its button
    for name in ("Traced", "Difference", "Blender"):
        x, y, seen, t = noted[name]["pixel"]
        assert [x, y] == noted[name]["clicked"]
        assert t == noted["frame"][name]
        assert (seen is None) == (t == float("inf"))
    assert noted["Traced"]["pixel"][2] == "Suzanne"
    assert noted["outside"] == noted["other"] == noted["Blender"]["pixel"]  # nothing new
    assert noted["after_escape"] == []
    assert noted["changed"] == {}
    assert noted["texts"] == ["Reference Tracer Pixel"]
    assert noted["text_begins"].startswith("# The ray through pixel (300, 100) of suzanne.blend")


@pytest.mark.story("in_view")
def test_clicks_in_the_camera_view(noted):
    for clicked, found in noted["clicks"]:
        # A pixel of the picture is about as large as one of the screen here.
        assert abs(found[0] - clicked[0]) <= 1 and abs(found[1] - clicked[1]) <= 1
        assert found[2]
    assert "Ray" in noted["drawn"] and "Hit" in noted["drawn"]
    assert sum(name.startswith("s") and " = " in name for name in noted["drawn"]) == 3
    assert noted["selection_kept"]
    assert noted["not_through_the_camera"]
    assert noted["after_escape"] == []


@pytest.mark.story("other_file")
def test_another_file_ends_it(noted):
    assert noted["running"] and noted["left"] == []
    assert noted["again"] == ["RUNNING_MODAL"] and noted["ended"] == []

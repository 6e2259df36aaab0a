"""What happens to a comparison in the window while it runs: nothing is lost, nothing is left."""

import pytest

ENDING = "loaded", "switched_off", "closed_window"

pytestmark = pytest.mark.gui


@pytest.mark.story("interruptions")
def test_nothing_is_lost_or_left(noted):
    assert len(noted) == 8
    assert {name: found["error"] for name, found in noted.items() if "error" in found} == {}
    assert {name: found["running"] for name, found in noted.items() if found["running"]} == {}
    assert {name: found["left"] for name, found in noted.items() if found.get("left")} == {}


@pytest.mark.story("interruptions")
def test_the_next_comparison_works(noted):
    found = {name: one["again"] for name, one in noted.items() if "again" in one}
    assert found == dict.fromkeys(ENDING, "agree")


@pytest.mark.story("interruptions")
def test_what_ends_it_ends_it(noted):
    assert {name: noted[name]["stopped"] for name in ENDING} == dict.fromkeys(ENDING, True)
    assert noted["saved"]["saved"] == ["Suzanne"]


@pytest.mark.story("closed")
def test_the_last_window_is_closed(played, noted):
    """Blender ends as it does by its own menu: nothing crashes, and no operator fails."""
    assert noted == {"dirty": False}
    assert played.ended["closed"] == 0
    assert "in cancel\n" not in (played.out / "closed.log").read_text()

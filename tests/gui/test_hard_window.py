"""Scenes that are hard to judge, in the real window: nothing is unexplained, nothing is upset."""

import pytest

pytestmark = [pytest.mark.gui, pytest.mark.story("hard_scenes")]


def test_no_false_alarm_in_the_viewport(noted):
    assert len(noted) == 9
    assert {name: found["failed"] for name, found in noted.items() if found["failed"]} == {}
    assert {found["source"] for found in noted.values()} == {"viewport"}
    unexplained = {name: found["unexplained"] for name, found in noted.items()}
    assert unexplained == dict.fromkeys(noted, 0)


def test_simulations_and_edited_meshes_agree(noted):
    agreed = {name for name, found in noted.items() if found.get("verdict") == "agree"}
    assert {"particles", "cloth", "edited", "edited_shared"} <= agreed
    assert "particle_hair" not in agreed


def test_nothing_has_moved(noted):
    assert [name for name, found in noted.items() if not found.get("same")] == []

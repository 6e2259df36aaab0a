"""Scenes that are hard to judge, in the real window: nothing is unexplained, nothing is upset."""

import pytest

pytestmark = pytest.mark.gui

# Some scenes every day, the others in the long tests: and some of each that have to agree.
EACH_PART = pytest.mark.parametrize(
    "agreeing",
    [
        pytest.param(
            {"particles", "cloth", "edited", "edited_shared"},
            marks=pytest.mark.story("hard_scenes"),
        ),
        pytest.param(
            {"soft_body", "edited_with_mirror", "edited_and_changed"},
            marks=[pytest.mark.story("more_hard_scenes"), pytest.mark.torture],
        ),
    ],
    ids=["every day", "others"],
)


@EACH_PART
def test_no_false_alarm_in_the_viewport(noted, agreeing):
    assert len(noted) >= 9
    assert {name: found["failed"] for name, found in noted.items() if found["failed"]} == {}
    assert {found["source"] for found in noted.values()} == {"viewport"}
    unexplained = {name: found["unexplained"] for name, found in noted.items()}
    assert unexplained == dict.fromkeys(noted, 0)


@EACH_PART
def test_simulations_and_edited_meshes_agree(noted, agreeing):
    agreed = {name for name, found in noted.items() if found.get("verdict") == "agree"}
    assert agreeing <= agreed
    assert not {"particle_hair", "hair_and_particles"} & agreed


@EACH_PART
def test_nothing_has_moved(noted, agreeing):
    assert [name for name, found in noted.items() if not found.get("same")] == []

"""What comes after the first picture: a result is the session's, as a render is."""

import pytest

pytestmark = pytest.mark.gui

NAMES = [f"Reference Tracer {name}" for name in ("Blender", "Causes", "Difference", "Traced")]


@pytest.mark.story("second_day")
def test_a_comparison_stays_until_another_file_is_opened(noted):
    steps = noted["steps"]
    for name in ("compared", "saved", "saved_as", "moved", "undone", "redone", "saved_again"):
        found = steps[name]
        assert found["images"] == NAMES and found["shown"] in NAMES, name
        assert found["fresh"] and found["verdict"] == "agree", name
    for name in ("new", "opened", "opened_again"):
        found = steps[name]
        assert found["images"] == [] and not (found["shown"] or found["verdict"]), name


@pytest.mark.story("second_day")
def test_the_next_comparison_is_shown_in_the_same_place(noted):
    for name in ("compared_0", "compared_1", "compared_2", "workbench", "cycles"):
        found = noted["steps"][name]
        assert found["images"] == NAMES and found["shown"] in NAMES and found["fresh"], name


@pytest.mark.story("second_day")
def test_nothing_is_to_be_saved_and_no_file_grows(noted):
    """Ctrl+N opens a new file at once. A file grows by a window alone, as F12 opens one."""
    steps = noted["steps"]
    assert steps.pop("new after first") == steps.pop("new after second") == ""
    assert all(found["dirty"] == [] for found in steps.values())
    sizes = [found["size"] for found in steps.values()]
    assert max(sizes) < sizes[0] + 50_000


@pytest.mark.story("second_day")
def test_undo_is_the_users(noted):
    assert [noted["steps"][name]["at"] for name in ("moved", "undone", "redone")] == [3, 0, 1]


@pytest.mark.story("quitted")
def test_blender_is_left_without_a_question(played, noted):
    assert noted == {"verdict": "agree"} and played.ended["quitted"] == 0


@pytest.mark.story("elsewhere")
def test_two_scenes_in_two_windows(noted):
    agree = [["agree", None], [None, "agree"], ["agree", None]]
    assert [verdicts for _, verdicts in noted["scenes"]] == agree
    assert {shown for shown, _ in noted["scenes"]} <= set(NAMES)


@pytest.mark.story("elsewhere")
def test_what_the_user_saves_is_his(noted):
    same, images, shown = noted["saved"]
    assert same and images == sorted([*NAMES, "kept.png"]) and shown in NAMES


@pytest.mark.story("elsewhere")
def test_a_comparison_that_is_refused_leaves_no_other_one(noted):
    assert noted["refused"] == [["kept.png"], None, None]


@pytest.mark.story("elsewhere")
def test_they_go_with_the_add_on(noted):
    images, texts = noted["before"]
    assert images == sorted([*NAMES, "kept.png"]) and texts == ["Reference Tracer Pixel"]
    assert noted["disabled"] == [["kept.png"], [], None]

"""What is seen before and after the button. Screenshots are left in out/gui."""

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("panel")
def test_a_new_file_shows_one_button_and_one_sentence(noted):
    assert all(noted["folded"])
    first = noted["new"][0]
    assert first == ["button", "Trace and Compare"]
    kinds = [kind for kind, _ in noted["new"]]
    texts = [text for _, text in noted["new"]]
    shown = kinds[: texts.index("Settings")]
    assert shown == ["button", *["label"] * (len(shown) - 1)] and 2 <= len(shown) <= 3


@pytest.mark.story("panel")
def test_nothing_is_cut_at_any_size(noted):
    assert {name: n > 20 for name, (n, _) in noted["drawn"].items()} == dict.fromkeys(
        ("properties", "sidebar", "large", "narrow", "narrow_large"), True
    )
    assert noted["drawn"]["large"][1] == 2 * noted["drawn"]["sidebar"][1]
    assert noted["cut"] == {name: {} for name in noted["cut"]}
    assert noted["half"]  # in half the room something would be


@pytest.mark.story("panel")
def test_no_two_buttons_have_one_icon(noted):
    assert len(noted["icons"]) > 5
    assert len(set(noted["icons"])) == len(noted["icons"])

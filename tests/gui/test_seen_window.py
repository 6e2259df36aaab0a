"""What is seen before and after the button. Screenshots are left in out/gui."""

import re

import numpy as np
import pytest
from PIL import Image

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
    assert len(noted["drawn"]) == 6 and all(n > 20 for n, _ in noted["drawn"].values())
    assert noted["drawn"]["narrow_large"][1] == 2 * noted["drawn"]["narrow"][1]
    assert noted["cut"] == {name: {} for name in noted["cut"]}
    assert noted["half"]  # in half the room something would be


@pytest.mark.story("panel")
def test_no_two_buttons_have_one_icon(noted):
    assert len(noted["icons"]) > 5
    assert len(set(noted["icons"])) == len(noted["icons"])


@pytest.mark.story("first_result")
def test_the_first_result_says_what_it_is(noted):
    assert noted["running"] == [0, "Trace and Compare, Blender draws the scene  (Esc: cancel)"]
    first, *_ = noted["panel"]
    assert first[0] == "label" and first[1].startswith("Trace and Compare")  # in the button's place
    assert any("Esc" in text for _, text in noted["panel"])
    assert noted["image"] == "Reference Tracer Traced"
    pixels, left, bottom = noted["region"]
    [header] = noted["header"]
    assert re.fullmatch(r"Agree, but for \d+ px at edges", header)
    assert noted["texts"][0] == f"{pixels} px at edges ({left}, {bottom}): Cube"
    assert noted["marks"] == dict.fromkeys(("TRACED", "DIFFERENCE", "CAUSES", "BOTH"), True)
    said = " ".join(noted["inspector"])
    assert "In the Comparison" in said and "Viewport" in said
    assert "px from the centre the tracer sees" in said  # the cause, with its numbers


OURS = [f"Reference Tracer {name}" for name in ("Blender", "Causes", "Difference", "Traced")]


@pytest.mark.story("shown")
def test_the_result_opens_as_a_render_does_and_esc_goes_back(noted):
    [none, shows_none] = noted["NONE"]["once"]
    assert shows_none is None and "IMAGE_EDITOR" not in none[0]
    [areas], image = noted["AREA"]["once"]
    assert areas.count("IMAGE_EDITOR") == 1 and len(areas) == len(none[0])
    assert image == "Reference Tracer Traced"
    assert noted["SCREEN"]["once"] == [[["IMAGE_EDITOR"]], image]
    assert noted["WINDOW"] == [[none[0], ["IMAGE_EDITOR"]], image]
    for mode in ("NONE", "AREA", "SCREEN"):
        assert noted[mode]["again"] and noted[mode]["back"], mode
    assert noted["by_script"]  # opens nothing
    assert noted["images"] == OURS


@pytest.mark.story("after_a_render")
def test_the_result_opens_where_a_render_is_still_shown(noted):
    for mode in ("AREA", "SCREEN"):
        [[areas, rendered], [after, image]] = noted[mode]
        assert rendered == "Render Result" and image == "Reference Tracer Traced"
        assert after == areas


@pytest.mark.story("compared_images")
def test_the_line_divides_the_traced_picture_from_the_other(noted):
    both = noted["both"]
    assert both["apart"] > 0.8  # so it is seen whose each pixel is
    assert both["left"] < 0.05 and both["right"] < 0.05  # a screen's pixel may be that of two
    assert noted["dragged"][0] == pytest.approx(noted["dragged"][1], abs=0.005)


@pytest.mark.story("compared_images")
def test_a_region_is_framed_in_the_picture_and_in_the_view(noted):
    pixels = [n for n, _ in noted["regions"]]
    assert sum(pixels) == noted["differ"] > 0 and pixels == sorted(pixels, reverse=True)
    assert noted["framed"] == ["FINISHED"] and all(noted["inside"])
    across, width = noted["across"]
    assert across < 40 * (width + 16)  # enlarged
    moved, selected = noted["moved"]
    assert moved > 0.1 and selected == noted["regions"][0][1][:1]


@pytest.mark.story("status_bar")
def test_the_status_bar_says_what_is_done_and_is_cleared_however_it_ends(noted):
    assert noted["at_once"] == "Trace and Compare, Blender draws the scene  (Esc: cancel)"
    shares = [int(m[1]) for m in (re.search(r": (\d+) %", t) for t in noted["heard"]) if m]
    assert len(shares) > 2 and shares == sorted(shares) and shares[-1] <= 100
    assert all("Esc" in text for text in noted["heard"])
    assert any(", tracing" in text for text in noted["heard"])
    assert noted["left"] == []
    assert noted["moved"]  # it was still at work
    assert noted["after_escape"] == noted["after_error"] == [[], []]
    still, other = noted["of_another"]
    assert still == [other]


@pytest.mark.story("heavy")
def test_what_takes_long_is_said_before_and_done_once(noted):
    words = "Trace and Compare, Blender evaluates 'Heavy'  (Esc: cancel)"
    assert noted["said"] == [words, words]
    assert noted["evaluations"] == [1]
    assert set(noted["verdicts"].values()) == {"agree"} and "beside a plane" in noted["verdicts"]


@pytest.mark.story("tried")
def test_what_draws_itself_is_named_in_any_view_and_theme(noted):
    verdict, features = noted["tried"]
    assert verdict == "warnings" and features == ["grease pencil", "hair", "volume"]


@pytest.mark.story("tried")
def test_a_panel_that_grows_lies_over_no_other(played, noted):
    """As if it were drawn anew."""
    names = "session_tried", "session_tried_redrawn"
    shots = [Image.open(played.out / f"{name}.png").convert("RGB") for name in names]
    first, again = (np.asarray(shot.crop(noted["sidebar"])) for shot in shots)
    assert (first == again).all()

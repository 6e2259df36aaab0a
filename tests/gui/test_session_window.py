"""What draws itself is named in any view and theme; and Blender is left without a question."""

import numpy as np
import pytest
from PIL import Image

pytestmark = pytest.mark.gui


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


@pytest.mark.story("quitted")
def test_blender_is_left_without_a_question(played, noted):
    assert noted == {"verdict": "agree"} and played.ended["quitted"] == 0

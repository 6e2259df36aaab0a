"""A first use by clicks and keys, as the first lesson tells it."""

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("lesson_1")
def test_lesson_1_goes_as_its_plan_says(noted):
    assert noted["verdict"] == "agree"
    for name in ("Traced", "Causes"):
        assert noted[name.upper()] == f"Reference Tracer {name}"
    assert noted["pixels"] == [[67, 190], [67, 300]]
    assert noted["text"] == "Reference Tracer Pixel"


@pytest.mark.story("lesson_1")
def test_then_go_to_what_differs_and_open_the_page(noted):
    assert noted["selected"] == ["Chessboard"] and noted["page"]

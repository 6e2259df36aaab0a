"""Any picture is judged in the window; what is wrong is put right by clicks."""

import pytest

pytestmark = pytest.mark.gui


def agrees(found):
    return found == {"verdict": "agree", "unexplained": 0, "told": []}


@pytest.mark.story("given_image")
def test_what_is_wrong_with_an_image_is_found_selected_and_put_right(noted):
    assert noted["given_moved"]["told"] == ["object_moved"] and noted["selected"] == ["Cone"]
    assert agrees(noted["given_moved_too"])
    assert noted["given_lens"]["told"] == ["focal_length"]
    assert noted["shown"] == ["Reference Tracer Put Right"]
    assert noted["copied"] == [["Camera as in the picture"], "Camera"]
    assert noted["camera"] == "Camera as in the picture"
    assert agrees(noted["given_put_right"])

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


@pytest.mark.story("given_render")
def test_the_render_result_agrees_until_an_object_is_moved(noted):
    assert agrees(noted["given_rendered"])
    later = noted["given_rendered_before"]
    assert later["verdict"] == "differences" and later["unexplained"] > 1000
    assert noted["given_rendered_by"] == "raster"


@pytest.mark.story("given_render")
def test_a_picture_of_a_3d_view_has_no_excuse_of_the_engine_of_the_last_render(noted):
    assert noted["given_viewed_by"] == "rays"
    drawn, unknown = noted["notes"]
    assert "a 3D view (View > Render) or the Sequencer" in drawn and "choose Made By" in unknown

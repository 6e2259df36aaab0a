"""The 3D view in Rendered mode, in the real window; screenshots are left in out/gui."""

import pytest

pytestmark = pytest.mark.gui


@pytest.mark.story("viewport_pixels")
def test_every_kind_of_view_lies_pixel_on_pixel_over_blenders_own(noted):
    assert len(noted) == 6
    for name, found in noted.items():
        assert found["apart"] < 1e-3, name  # pixels
        assert found["colors"] > 5, name
        # Edge pixels that Blender, in float32, gives to the other side.
        assert found["differ"] < 50 and found["strange"] < 5, (name, found)
        assert found["outside"] <= 3, name  # levels of the background's dither

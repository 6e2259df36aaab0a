"""The render border: which pixels, against Blender's own pictures."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.blender.reading.camera import border_region, export_camera


def borders(count: int, seed: int):
    """Return (width, height, (min_x, max_x, min_y, max_y)), a few of them on whole pixels."""
    rng = np.random.default_rng(seed)
    out = []
    while len(out) < count:
        width, height = (int(n) for n in rng.integers(5, 60, 2))
        if len(out) % 2:  # shares that are pixels but for the rounding of float32
            shares = [
                k / n
                for n, top in ((width, width), (height, height))
                for k in sorted(rng.choice(top + 1, 2, replace=False))
            ]
        else:
            shares = [s for _ in range(2) for s in sorted(rng.random(2))]
        region = border_region(width, height, *shares)
        if region.x0 < region.x1 and region.y0 < region.y1:
            out.append((width, height, tuple(float(s) for s in shares)))
    return out


@pytest.mark.parametrize(("width", "height", "shares"), borders(12, seed=11))
def test_the_border_is_rounded_as_blender_rounds(width, height, shares, build, workbench):
    scene = build.scene(width, height)
    build.camera(type="ORTHO")
    build.square(size=100)
    render = scene.render
    render.film_transparent = render.use_border = True
    (render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y) = shares
    region = export_camera(scene).region
    render.use_crop_to_border = True
    assert workbench(render_aa="OFF").shape[:2] == (region.height, region.width)
    render.use_crop_to_border = False
    drawn = workbench(render_aa="OFF")[..., 3] > 0
    expected = np.zeros((height, width), bool)
    expected[region.y0 : region.y1, region.x0 : region.x1] = True
    np.testing.assert_array_equal(drawn, expected)

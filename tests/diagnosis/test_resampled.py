"""A picture that is resampled is told as such, also where a border is rendered."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.rendering import render
from reference_tracer.scene import Region, ViewWindow

from .diagnosing import diagnosis_of, names


@pytest.mark.slow
@pytest.mark.parametrize("n", [2, 3])
def test_what_a_border_shows_may_be_resampled(solids, n):
    """Its pixels at another size are those of a picture with just its window."""
    camera = replace(solids.camera, region=Region(24, 10, 144, 82))
    scene = replace(solids, camera=camera)
    c, w = camera, camera.window
    x, y = (w.right - w.left) / c.width, (w.top - w.bottom) / c.height
    part = ViewWindow(w.left + 24 * x, w.left + 144 * x, w.bottom + 10 * y, w.bottom + 82 * y)
    wide, high = 120 // n, 72 // n
    small = replace(c, window=part, width=wide, height=high, region=Region(0, 0, wide, high))
    rows = np.arange(72) // n
    columns = np.arange(120) // n
    found = diagnosis_of(scene, render(replace(scene, camera=small)).color[rows][:, columns])
    assert names(found) == ["resampled"]
    assert found.diagnosis.told[0].guess.values[0] == n

"""What is laid over a picture, or resampled, is told as such."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.diagnosis.diagnosis import diagnose
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.scene import Region, ViewWindow
from reference_tracer.tracer.progress import result_of

from ..cases import case_of
from .diagnosing import BY_NAME, diagnosis_of, names


@pytest.mark.torture
@pytest.mark.parametrize("opacity", [0.4, 1.0])
def test_something_laid_over_the_picture(solids, opacity):
    """But a part of it that has the colour of an object may be that object."""
    color = render(solids).color.copy()
    part = color[30:60, 60:130]
    part[:] = (1 - opacity) * part + opacity * np.array((0.02, 0.97, 0.95, 1))
    found = diagnosis_of(solids, color)
    assert names(found) == ["overlay"]
    assert found.diagnosis.told[0].guess.values[0] == pytest.approx(opacity, abs=0.01)
    like = render(solids).color.copy()
    like[30:60, 60:130] = solids.instances[2].colors[0]
    assert "overlay" not in names(diagnosis_of(solids, like))


@pytest.mark.slow
@pytest.mark.parametrize("size", [0.5, 0.75])
def test_what_a_border_shows_may_be_resampled(solids, size):
    """Its pixels at another size are those of a picture with just its window."""
    camera = replace(solids.camera, region=Region(24, 10, 144, 82))
    scene = replace(solids, camera=camera)
    c, w = camera, camera.window
    x, y = (w.right - w.left) / c.width, (w.top - w.bottom) / c.height
    part = ViewWindow(w.left + 24 * x, w.left + 144 * x, w.bottom + 10 * y, w.bottom + 82 * y)
    wide, high = round(size * 120), round(size * 72)
    small = replace(c, window=part, width=wide, height=high, region=Region(0, 0, wide, high))
    rows = ((np.arange(72) + 0.5) * size).astype(int)
    columns = ((np.arange(120) + 0.5) * size).astype(int)
    found = diagnosis_of(scene, render(replace(scene, camera=small)).color[rows][:, columns])
    assert names(found) == ["resampled"]
    assert found.diagnosis.told[0].guess.values[0] == size


INK = np.where(np.arange(40)[:, None] % 6 < 3, 0.95, 0.02)


@pytest.mark.slow
def test_stripes_in_a_box_over_one_surface_are_laid_over_it(solids):
    """Their opacity lies between two."""
    right = render(solids)
    floor = right.object_index == right.object_index[5, 24]
    assert floor[2:14, 4:44].all()
    striped = right.color.copy()
    striped[2:14, 4:44, :3] = 0.4 * striped[2:14, 4:44, :3] + 0.6 * INK
    found = diagnosis_of(solids, striped)
    assert names(found) == ["overlay"] and overlaid(solids, striped)
    guess = found.diagnosis.told[0].guess
    assert guess.low[0] <= 0.6 <= guess.high[0] == 1


@pytest.mark.torture
def test_one_colour_or_a_round_shape_may_be_an_unknown_object(solids):
    striped, plain, round_ = (render(solids).color.copy() for _ in range(3))
    striped[2:14, 4:44, :3] = 0.4 * striped[2:14, 4:44, :3] + 0.6 * INK
    plain[2:14, 4:44, :3] = (0.02, 0.97, 0.95)
    assert not overlaid(solids, plain)
    y, x = np.mgrid[2:14, 4:44]
    disc = np.hypot(y - 8, (x - 24) / 3) < 6
    round_[2:14, 4:44][disc] = striped[2:14, 4:44][disc]
    assert not overlaid(solids, round_)


def overlaid(scene, color):
    """Return what is told of a picture if nothing but an overlay is looked for."""
    found = result_of(trace_and_compare(case_of(scene, Picture(color), curves=())))
    assert found.counts.unexplained > 50
    faults = [BY_NAME["overlay"]]
    return result_of(diagnose(found.case, found.frame, found.causes, faults, np.inf)).told

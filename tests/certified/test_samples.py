"""All samples found at once are those that are traced one after the other, to the bit."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from reference_tracer.rendering import certified_tracer, render
from reference_tracer.scene import Region
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.progress import Meter, Progress
from reference_tracer.tracer.render import FINEST, _Band, rounds, samples_together
from reference_tracer.tracer.settings import Settings

from ..sampled import sampled
from ..tracer.hostile_scenes import hostile_scene
from ..tracer.pictures import mess

CERTIFIED = Settings("certified")


@sampled(2)
@pytest.mark.parametrize("color", [Color.OBJECT, Color.DEPTH])
def test_at_once_is_one_after_the_other(make, color, every):
    """Of hostile scenes, through a region of both kinds of cameras."""
    mixed = projections = 0
    for seed in range(70_000, 70_006):
        rng = np.random.default_rng(seed)
        scene = hostile_scene(make, rng) if seed % 3 else mess(make, rng, seed % 2 == 0, False)
        projections |= 1 + scene.camera.projection.shares_direction
        for n in (2, 4)[seed % every :: every]:
            settings = replace(CERTIFIED, samples=n, color=color)
            assert samples_together(scene.camera, settings)
            found = render(scene, settings)
            expected = render(scene, settings, tracer=certified_tracer)
            for name, values in expected.passes().items():
                assert found.passes()[name].tobytes() == values.tobytes(), (seed, n, name)
            mixed += (found.color != render(scene, replace(CERTIFIED, color=color)).color).any()
    assert mixed > 4 / every and projections == 3


def test_a_band_in_the_midst_of_a_picture(make, rng):
    """The samples of a border's pixels are those of the whole picture's."""
    camera = make.camera(16, 12)
    scene = make.scene(camera, make.quad(-0.9, 0.3, -0.7, 0.2, -2))
    region = Region(3, 2, 14, 11)
    part = replace(scene, camera=replace(camera, region=region))
    whole, some = (render(s, replace(CERTIFIED, samples=4)).color for s in (scene, part))
    assert some.tobytes() == whole[2:11, 3:14].tobytes()
    assert len(np.unique(some[..., 3])) > 2


@pytest.mark.parametrize(
    ("settings", "width"),
    [
        (Settings("certified"), 8),
        (Settings("certified", samples=3), 8),  # whose rays would be rounded otherwise
        (Settings("textbook", samples=4), 8),
        (Settings("certified", samples=4), FINEST // 4 + 1),
    ],
)
def test_what_is_not_found_at_once(make, settings, width):
    assert not samples_together(make.camera(width, 8), settings)
    assert samples_together(make.camera(8, 8), replace(CERTIFIED, samples=64))


def test_the_share_of_the_work_is_about_that_of_the_time(make):
    """The first sample finds all: it is not one of many steps of one size."""
    scene = make.scene(make.camera(64, 64), make.quad(-1, 1, -1, 1, -4))
    settings = Settings("certified", samples=8)
    band = Region(0, 0, 64, 64)
    asked: list[float] = []
    meter = Meter()

    def trace(region, dx, dy):
        asked.append(meter.share)
        yield Progress(1.0)
        return Hits.none(64 * 64)

    every = rounds(settings)[0]
    shade = partial(Color.OBJECT.of, scene, (0.0, 0.0))
    for event in _Band(Frame.empty(scene), band, every, shade, True).steps(trace):
        meter.read(event)
    assert meter.share == pytest.approx(1.0)
    assert asked[1] < 0.2 and asked[2] > 0.8  # the first sample begins, and has ended


def test_one_row_of_samples_fits_into_the_memory(make):
    camera = make.camera(256, 16)
    settings = Settings("certified", samples=64)
    assert samples_together(camera, settings)
    assert not samples_together(camera, replace(settings, memory=16 << 20))

"""Cycles as a judge: it shows constant colours, with one sample in each pixel's centre."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .judge import Judge

SAMPLE_RADIUS = 0.005  # pixels: the least that Cycles' filter allows
# Metres. Embree, which Cycles traces with, takes a triangle for invalid that has a coordinate of
# 1.844e18 or more, about a tenth of the root of float32's largest number (measured in 5.2: one
# of 1.8434e18 is drawn, one of 1.8445e18 is not).
FARTHEST = 1.843e18


@contextmanager
def _one_sample_a_pixel(scene: Any, layer: str) -> Iterator[None]:
    from .constant_material import constant_colors

    scene.cycles.samples = 1
    scene.view_layers[layer].samples = 0  # the scene's
    scene.cycles.film_exposure = 1.0
    scene.cycles.sample_clamp_direct = 0.0
    scene.cycles.use_denoising = False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 2 * SAMPLE_RADIUS
    with constant_colors(scene, layer):
        yield


CYCLES = Judge(
    name="cycles",
    label="Cycles",
    description="A Cycles render of the same constant colours, one sample in each pixel's centre",
    number=2,
    engine="CYCLES",
    ignores=("display type", "transparency", "texture", "in-front drawing", "hidden faces"),
    set_up=_one_sample_a_pixel,
    sample_radius=SAMPLE_RADIUS,
    farthest=FARTHEST,
    traces_rays=True,
    solid=False,
    random_instances=False,
)

"""Cycles as a judge: it shows constant colours, with one sample in each pixel's centre."""

from __future__ import annotations

from .judge import Judge

SAMPLE_RADIUS = 0.005  # pixels: the least that Cycles' filter allows
# Metres. Embree, which Cycles traces with, takes a triangle for invalid that has a coordinate of
# 1.844e18 or more, about a tenth of the root of float32's largest number (measured in 5.2: one
# of 1.8434e18 is drawn, one of 1.8445e18 is not).
FARTHEST = 1.843e18


CYCLES = Judge(
    name="cycles",
    label="Cycles",
    description="A Cycles render of the same constant colours, one sample in each pixel's centre",
    number=2,
    engine="CYCLES",
    ignores=("display type", "transparency", "texture", "in-front drawing", "hidden faces"),
    settings=(
        ("cycles.samples", 1),
        ("view_layers[0].samples", 0),  # the scene's
        ("cycles.film_exposure", 1.0),
        ("cycles.sample_clamp_direct", 0.0),
        ("cycles.use_denoising", False),
        ("cycles.use_adaptive_sampling", False),
        ("cycles.pixel_filter_type", "BOX"),
        ("cycles.filter_width", 2 * SAMPLE_RADIUS),
    ),
    sample_radius=SAMPLE_RADIUS,
    farthest=FARTHEST,
    traces_rays=True,
    solid=False,
)

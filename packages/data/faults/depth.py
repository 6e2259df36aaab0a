"""Faults of depths: of another axis, in another unit, or as a depth buffer has them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.tracer.hits import NOTHING

from ..depth import depth, distance
from ..kind import Data, Turn
from ..seen import Seen
from .normalised import normalised
from .turned import Turned, data_fault, once

_UNITS = (
    (1000.0, "millimetres"),
    (100.0, "centimetres"),
    (0.001, "kilometres, or metres were taken for millimetres"),
)
_STRAY = 0.02  # of the background: as much of it may hold something else
_LEAST = 16  # pixels that say by which factor values are off
_OUTLIERS = 1  # per cent of these at either end that may be wrong for another reason


def _scaled(factor: float) -> Turn:
    return lambda made, seen: made * factor


def _units(evidence: Evidence, data: Data) -> Iterator[Turned]:
    for factor, words in _UNITS:
        yield Turned(words=words, turn=_scaled(factor))


def _factor(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess the factor with which the most unexplained pixels are right."""
    frame = evidence.frame
    where = evidence.unexplained & (frame.instance_index != NOTHING) & ~data.blank
    made = data.of_frame(frame)[where].ravel()
    own = data.values[where].ravel()
    half = data.step.half(own)
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = (own - half) / made, (own + half) / made
    known = np.isfinite(low) & np.isfinite(high) & (made > 0)
    if known.sum() < _LEAST:
        return
    ends = np.percentile(low[known], 100 - _OUTLIERS), np.percentile(high[known], _OUTLIERS)
    factor = float(np.mean(ends))
    if ends[0] > ends[1]:
        factor = float(np.median(low[known] + high[known]) / 2)
    least, most = sorted(map(float, ends))
    if factor > 0:
        yield Turned((factor,), (least,), (most,), turn=_scaled(factor))


def _clip(seen: Seen) -> tuple[float, float]:
    return float(seen.scene.camera.clip_start), float(seen.scene.camera.clip_end)


def _buffer(seen: Seen) -> Floats:
    """Return a depth buffer's values, 0 to 1: f / (f - n) (1 - n / z), or linear if parallel."""
    near, far = _clip(seen)
    z = depth(seen)
    if seen.scene.camera.projection.shares_direction:
        return (z - near) / (far - near)
    with np.errstate(divide="ignore", invalid="ignore"):
        return far / (far - near) * (1 - near / z)


def _buffers(evidence: Evidence, data: Data) -> Iterator[Turned]:
    words = "0 at the near clip plane, 1 at the far one"
    yield Turned(words=words, turn=lambda made, seen: _buffer(seen) * data.full)
    words = "reversed, 1 at the near clip plane, 0 at the far one"
    yield Turned(words=words, turn=lambda made, seen: (1 - _buffer(seen)) * data.full)
    words = "-1 at the near clip plane, 1 at the far one"
    yield Turned(words=words, turn=lambda made, seen: 2 * _buffer(seen) - 1)


def _background(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess that one value stands for nothing in the whole background, as no other does."""
    nothing = evidence.frame.instance_index == NOTHING
    if (data.blank & nothing).sum() > _STRAY * nothing.sum():
        return
    held = data.values[nothing & evidence.unexplained]
    value, count = np.unique(held, return_counts=True)
    if not len(value) or np.max(count) <= (1 - _STRAY) * nothing.sum():
        return
    most = float(value[np.argmax(count)])

    def taken(data: Data) -> Data:
        return replace(data, blank=data.blank | (data.values == most).all(axis=-1))

    yield Turned((most,), change=taken)


def _inverse(made: Floats, seen: Seen) -> Floats:
    with np.errstate(divide="ignore"):
        return 1 / made


DEPTH_FAULTS = (
    data_fault(
        "distance_for_depth",
        ("depth",),
        "the values are distances along the ray, not depths along the view axis",
        "A ray tracer's t is a distance where directions have unit length.",
        "divide by the length of (x, y, 1), the pixel on the plane at depth 1; or --holds distance",
        once(lambda made, seen: distance(seen)),
        witness="mitsuba-renderer/mitsuba2#79",
    ),
    data_fault(
        "depth_for_distance",
        ("distance",),
        "the values are depths along the view axis, not distances along the ray",
        "Rasterisers, and Blender's Z pass, have depths along the view axis.",
        "multiply by the length of (x, y, 1), the pixel on the plane at depth 1; or --holds depth",
        once(lambda made, seen: depth(seen)),
        witness="google-research/kubric#151",
    ),
    data_fault(
        "data_unit",
        ("depth", "distance", "positions"),
        "the values are in {words}",
        "Sensors and 16-bit files store millimetres; a scale was left out, or applied twice.",
        "convert to metres, or name the unit with scale= of --holds",
        _units,
        words="millimetres in place of metres, and so on",
        witness="ScanNet/ScanNet#17",
    ),
    data_fault(
        "data_scale",
        ("depth", "distance", "positions"),
        "the values are {factor:.6g} times the right ones",
        "Data sets store depths in units of their own, as 1/5000 m or 1/256 m.",
        "divide the values by {factor:.6g}, or name the unit with scale= of --holds",
        _factor,
        ("factor",),
        witness="alexklwong/void-dataset#3",
    ),
    data_fault(
        "depth_buffer",
        ("depth", "distance"),
        "the values are a depth buffer's, of which near and far are not undone: {words}",
        "OpenGL and Vulkan keep f / (f - n) (1 - n / z), which is not linear in the depth z.",
        "of values d from 0 to 1, z = n f / (f - d (f - n))",
        _buffers,
        words="the range of the buffer, and whether it is reversed",
        witness="NVIDIA/VisRTX#60",
    ),
    data_fault(
        "depth_normalised",
        ("depth", "distance"),
        "the values are normalised: 0 is at {zero:.6g} m, full scale at {one:.6g} m",
        "Depths are stretched to some range to be looked at, and often reversed, so that near "
        "surfaces are bright.",
        "save the depths themselves, before they are normalised to be looked at",
        normalised,
        ("zero", "one"),
        witness="zju3dv/pvnet-rendering#5",
    ),
    data_fault(
        "background_value",
        ("depth", "distance"),
        "where nothing is seen the values are {value:.6g}",
        "An emptied depth buffer has the value of the far plane, which may be another than the "
        "scene's.",
        "save 0, an infinity or NaN where nothing is seen, or clip both at one depth",
        _background,
        ("value",),
        witness="ros-perception/vision_opencv#248",
    ),
    data_fault(
        "inverse_depth",
        ("depth", "distance"),
        "the values are inverse depths, as a disparity has them",
        "Stereo and networks for depth predict 1 / z.",
        "take 1 over each value",
        once(_inverse),
        witness="LiheYoung/Depth-Anything#47",
    ),
    data_fault(
        "data_sign",
        ("depth", "distance", "positions"),
        "the values have the wrong sign",
        "A camera looks along -Z: depths there are negative.",
        "change the sign",
        once(_scaled(-1.0)),
        witness="ssloy/tinyrenderer#67",
    ),
)

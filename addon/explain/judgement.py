"""Accept or reject, and why: the textbook's conditions on the numbers of one arithmetic.

In come the steps of a ray and a surface; out goes a `Judgement` with every condition that fails.
"""

from __future__ import annotations

from enum import StrEnum
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from ..scene import Camera
from ..tracer.nearest import within_clip
from ..tracer.triangle import SUM_TOLERANCE
from .arithmetic import Number
from .textbook import Steps


class Reason(StrEnum):
    """Why a surface is rejected; the values are what JSON calls them."""

    DEGENERATE = "degenerate"
    PARALLEL = "parallel"
    NOT_A_NUMBER = "not_a_number"
    S1_NEGATIVE = "s1_negative"
    S2_NEGATIVE = "s2_negative"
    S3_NEGATIVE = "s3_negative"
    S1_ABOVE_1 = "s1_above_1"
    S2_ABOVE_1 = "s2_above_1"
    S3_ABOVE_1 = "s3_above_1"
    SUM = "sum"
    BEHIND = "behind"
    BEFORE_CLIP_START = "before_clip_start"
    BEYOND_CLIP_END = "beyond_clip_end"


SENTENCES = {
    Reason.DEGENERATE: "n = 0: the corners lie on one line, there is no plane",
    Reason.PARALLEL: "d · n = 0: the ray is parallel to the plane",
    Reason.NOT_A_NUMBER: "t is not a finite number: an operation overflowed",
    Reason.S1_NEGATIVE: "s₁ < 0: x lies beyond the edge p₂p₃",
    Reason.S2_NEGATIVE: "s₂ < 0: x lies beyond the edge p₃p₁",
    Reason.S3_NEGATIVE: "s₃ < 0: x lies beyond the edge p₁p₂",
    Reason.S1_ABOVE_1: "s₁ > 1: x lies beyond the corner p₁",
    Reason.S2_ABOVE_1: "s₂ > 1: x lies beyond the corner p₂",
    Reason.S3_ABOVE_1: "s₃ > 1: x lies beyond the corner p₃",
    Reason.SUM: "s₁ + s₂ + s₃ is farther from 1 than rounding takes it: the sᵢ have lost their "
    "digits",
    Reason.BEHIND: "t < 0: the plane is behind the eye",
    Reason.BEFORE_CLIP_START: "t < clip start: nearer than the camera shows",
    Reason.BEYOND_CLIP_END: "t > clip end: farther than the camera shows",
}


class Judgement(NamedTuple):
    """What one arithmetic says of a surface.

    `literal` is whether the test as printed, sum = 1 included, accepts it, too; None of a plane.
    """

    accepted: bool
    reasons: tuple[Reason, ...]
    literal: bool | None = None


def judge(steps: Steps, camera: Camera) -> Judgement:
    """Judge the steps of a plane or a triangle against the textbook's conditions and the clip."""
    undefined = _undefined(steps)
    if undefined:
        return Judgement(False, (undefined,), False if "p1" in steps else None)
    reasons = _inside(steps) + _clipped(steps["t"], camera)
    literal = None
    if "sum" in steps:
        literal = not reasons and bool(steps["sum"] == 1)
    return Judgement(not reasons, tuple(reasons), literal)


def _undefined(steps: Steps) -> Reason | None:
    """Return why there is no t; floats have one by the rules for inf, but it means nothing."""
    if not any(steps["n"]):
        return Reason.DEGENERATE
    if steps["towards"] == 0:
        return Reason.PARALLEL
    values = [steps["t"], *(steps[k] for k in ("s1", "s2", "s3") if k in steps)]
    if not all(isinstance(v, Fraction) or np.isfinite(v) for v in values):
        return Reason.NOT_A_NUMBER
    return None


def _inside(steps: Steps) -> list[Reason]:
    if "s1" not in steps:
        return []
    found = [
        Reason(f"s{k}_{'negative' if steps[f's{k}'] < 0 else 'above_1'}")
        for k in (1, 2, 3)
        if not 0 <= steps[f"s{k}"] <= 1
    ]
    negative = [r for r in found if "negative" in r]  # where one is, it also says why others are >1
    if not found and not isinstance(steps["sum"], Fraction):
        kind = steps["sum"].dtype
        if not abs(steps["sum"] - kind.type(1)) <= kind.type(SUM_TOLERANCE[kind]):
            found.append(Reason.SUM)
    return negative or found


def _clipped(t: Number, camera: Camera) -> list[Reason]:
    """Return how t lies outside the clip range, in t's own arithmetic, as the tracer has it."""
    if isinstance(t, Fraction):
        start, end = (Fraction(v) if np.isfinite(v) else v for v in _clip(camera))
        seen = start <= t <= end and (t != 0 or start != 0)
    else:
        start, end = _clip(camera)
        seen = bool(within_clip(camera, np.array([t]))[0])
    if seen:
        return []
    if t < 0 and start >= 0:
        return [Reason.BEHIND]
    return [Reason.BEYOND_CLIP_END if t > end else Reason.BEFORE_CLIP_START]


def _clip(camera: Camera) -> tuple[float, float]:
    return float(camera.clip_start), float(camera.clip_end)

"""Computes the textbook's steps and conditions in float32, in float64 and exactly.

The formulas of `formulas.py` are evaluated as they are printed, one operation after the other. So
in float32 and float64 these numbers are those of `tracer/camera.py`, `plane.py` and `triangle.py`,
to the last bit, and a test holds them to it. A `Judgement` names every condition that fails.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from enum import StrEnum
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera
from ..tracer.camera import pixel_size
from ..tracer.nearest import within_clip
from ..tracer.triangle import SUM_TOLERANCE
from .expressions import Value, evaluate, parse
from .formulas import CAMERA, Formula, Rejection, ray_formulas

Number = np.float32 | np.float64 | Fraction
Vector = NDArray[Any]  # (3,), float32 or float64, which round after every operation, or fractions
Labelled = dict[str, Value]  # by their keys or labels


class Arithmetic(StrEnum):
    """The arithmetic of a column."""

    FLOAT32 = "float32"
    FLOAT64 = "float64"
    EXACT = "exact"

    def number(self, value: float) -> Number:
        """Return a finite float64 in this arithmetic: rounded to float32, else as it is."""
        if self is Arithmetic.EXACT:
            return Fraction(float(value))
        with np.errstate(over="ignore"):  # beyond float32's range it is inf, as in the tracer
            return np.dtype(self.value).type(value)

    def vector(self, values: Iterable[float]) -> Vector:
        """Return three finite float64 in this arithmetic."""
        return np.array([self.number(v) for v in values])


FLOATS = Arithmetic.FLOAT32, Arithmetic.FLOAT64


@np.errstate(all="ignore")
def evaluate_all(formulas: Mapping[str, Formula], given: Labelled) -> Labelled:
    """Return the values of formulas by their keys, exact ones up to where one would divide by 0.

    Parameters
    ----------
    formulas : mapping of str to Formula
        In order: each is made of what is given and of those before it.
    given : dict
        Labelled by their labels; a formula with one of these labels is not computed.
    """
    names, out = dict(given), {}
    for key, formula in formulas.items():
        if formula.label not in names:
            try:
                names[formula.label] = evaluate(parse(formula.right or formula.label), names)
            except ZeroDivisionError:
                break
        out[key] = names[formula.label]
    return out


def camera_steps(kind: Arithmetic, camera: Camera, x: int, y: int) -> Labelled:
    """Return the steps from a pixel to the ray through its centre.

    Parameters
    ----------
    kind : Arithmetic
    camera : Camera
    x, y : int
        Column and row of the whole picture.
    """
    w = camera.window
    numbers = {"u_min": w.left, "u_max": w.right, "v_min": w.bottom, "v_max": w.top}
    numbers |= {"columns": camera.width, "rows": camera.height, "X": x + 0.5, "Y": y + 0.5}
    if kind is not Arithmetic.EXACT:  # float32 takes those of float64, as the tracer does
        numbers |= zip("wh", pixel_size(camera), strict=True)
    vectors = {"right": camera.right, "up": camera.up, "forward": camera.forward}
    vectors["e"] = camera.origin
    given: Labelled = {label: kind.number(value) for label, value in numbers.items()}
    given |= {label: kind.vector(value) for label, value in vectors.items()}
    return evaluate_all(CAMERA | ray_formulas(camera.projection), given)


def surface_steps(
    formulas: Mapping[str, Formula], o: Vector, d: Vector, *points: Vector
) -> Labelled:
    """Return the steps of a ray with a triangle (three corners) or a plane (point and normal)."""
    labels = [formula.label for formula in formulas.values()]
    return evaluate_all(formulas, {"o": o, "d": d, **dict(zip(labels, points, strict=False))})


class Judgement(NamedTuple):
    """Whether one arithmetic accepts a surface, and why not.

    `literal` is whether the test as printed, with sum = 1, accepts it, too; None for a plane.
    """

    accepted: bool
    reasons: tuple[Rejection, ...]
    literal: bool | None = None


def judge(found: Labelled, camera: Camera) -> Judgement:
    """Judge the steps of a plane or a triangle by the textbook's conditions and the clip range."""
    undefined = _undefined(found)
    if undefined:
        return Judgement(False, (undefined,), False if "p1" in found else None)
    reasons = _inside(found) + _clipped(found["t"], camera)
    literal = not reasons and bool(found["sum"] == 1) if "sum" in found else None
    return Judgement(not reasons, tuple(reasons), literal)


def _undefined(found: Labelled) -> Rejection | None:
    """Return why t means nothing, where it does; floats have one by the rules for inf."""
    if not any(found["n"]):
        return Rejection.DEGENERATE
    if found["towards"] == 0:
        return Rejection.PARALLEL
    values = [found[k] for k in ("t", "s1", "s2", "s3") if k in found]
    if not all(isinstance(v, Fraction) or np.isfinite(v) for v in values):
        return Rejection.NOT_A_NUMBER
    return None


def _inside(found: Labelled) -> list[Rejection]:
    if "s1" not in found:
        return []
    outside = [
        Rejection(f"s{k}_{'negative' if found[f's{k}'] < 0 else 'above_1'}")
        for k in (1, 2, 3)
        if not 0 <= found[f"s{k}"] <= 1
    ]
    total = found["sum"]
    if not outside and not isinstance(total, Fraction):
        if not abs(total - total.dtype.type(1)) <= total.dtype.type(SUM_TOLERANCE[total.dtype]):
            return [Rejection.SUM]
    negative = [r for r in outside if "negative" in r]  # it also says why others are above 1
    return negative or outside


def _clipped(t: Number, camera: Camera) -> list[Rejection]:
    """Return how t lies outside the clip range, in t's own arithmetic, as the tracer has it."""
    start, end = float(camera.clip_start), float(camera.clip_end)
    if isinstance(t, Fraction):
        seen = start <= t <= end and (t != 0 or start != 0)  # Python compares them exactly
    else:
        seen = bool(within_clip(camera, np.array([t]))[0])
    if seen:
        return []
    if t < 0 and start >= 0:
        return [Rejection.BEHIND]
    return [Rejection.BEYOND_CLIP_END if t > end else Rejection.BEFORE_CLIP_START]

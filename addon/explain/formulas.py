"""The textbook's formulas, what each number is called, and why a surface is rejected.

Every formula of the project but the tracer's own code is taken from here. A formula is plain text:
`textbook.py` evaluates it, Markdown shows it as it is, `html.py` sets it as MathML, and the
documents' tables are made of it. Vectors are the letters of `VECTORS`; all else is a number.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple

from ..projections import Projection

VECTORS = frozenset({"o", "d", "n", "p", "x", "c", "e", "right", "up", "forward"})


class Formula(NamedTuple):
    """The left side of a formula, its right side (empty where a number is given), and a remark."""

    label: str
    right: str = ""
    remark: str = ""

    def __str__(self) -> str:
        right = f" = {self.right}" if self.right else ""
        return f"{self.label}{right}{self.remark and f' ({self.remark})'}"


CAMERA = {
    "left": Formula("u_min", "", "the view window"),
    "right_end": Formula("u_max"),
    "bottom": Formula("v_min"),
    "top": Formula("v_max"),
    "width": Formula("w", "(u_max − u_min) / columns", "a pixel's width"),
    "height": Formula("h", "(v_max − v_min) / rows", "a pixel's height"),
    "px": Formula("X", "column + ½", "the pixel's centre, in pixels"),
    "py": Formula("Y", "row + ½"),
    "right": Formula("right", "", "the camera's frame, in world space"),
    "up": Formula("up"),
    "forward": Formula("forward"),
    "eye": Formula("e", "", "the camera's position"),
    "u": Formula("u", "u_min + X w"),
    "v": Formula("v", "v_min + Y h"),
}
STORED = {"o": Formula("o"), "d": Formula("d")}
PLANE = {
    "p": Formula("p", "", "a point of the plane"),
    "n": Formula("n", "", "its normal"),
    "from_p": Formula("(o − p) · n"),
    "towards": Formula("d · n"),
    "t": Formula("t", "−((o − p) · n) / (d · n)"),
    "x": Formula("x", "o + t d"),
}
TRIANGLE = {
    "p1": Formula("p₁", "", "corners, in world space"),
    "p2": Formula("p₂"),
    "p3": Formula("p₃"),
    "n": Formula("n", "(p₃ − p₁) × (p₂ − p₁)", "as long as twice the area"),
    "from_p": Formula("(o − p₁) · n"),
    "towards": Formula("d · n", "", "0: parallel"),
    "t": Formula("t", "−((o − p₁) · n) / (d · n)"),
    "x": Formula("x", "o + t d", "where the ray meets the plane"),
    "ns1": Formula("nₛ₁", "(p₂ − p₃) × (x − p₃)"),
    "ns2": Formula("nₛ₂", "(p₁ − p₂) × (x − p₂)", "0 on the edge p₁p₂"),
    "ns3": Formula("nₛ₃", "(p₃ − p₁) × (x − p₁)", "0 on the edge p₃p₁"),
    "area": Formula("‖n‖²", "n · n"),
    "s1": Formula("s₁", "(n · nₛ₁) / ‖n‖²", "weighs p₁"),
    "s2": Formula("s₂", "(n · nₛ₃) / ‖n‖²", "printed as s₃: erratum 1"),
    "s3": Formula("s₃", "(n · nₛ₂) / ‖n‖²", "printed as s₂: erratum 1"),
    "sum": Formula("s₁ + s₂ + s₃", "", "printed: = 1, erratum 2"),
}
COLOR = {
    "c1": Formula("c₁", "", "colours at the corners, linear"),
    "c2": Formula("c₂"),
    "c3": Formula("c₃"),
    "color": Formula("c", "s₁ c₁ + s₂ c₂ + s₃ c₃"),
}

ERRATA = (
    "nₛ₂ is 0 on the edge p₁p₂ and nₛ₃ on the edge p₃p₁. So s₂ as the textbook prints it weighs "
    "p₃, and s₃ weighs p₂: the opposite of x = s₁ p₁ + s₂ p₂ + s₃ p₃. Constant shading never shows "
    "it; colours between corners would. Here sᵢ weighs pᵢ.",
    "x cancels out of nₛ₁ + nₛ₂ + nₛ₃, so s₁ + s₂ + s₃ = 1 always holds exactly and says nothing. "
    "In floating point, rounding makes the printed test fail for about every second hit. The "
    "repaired test allows the sum 10⁻⁶ in float32 and 10⁻⁹ in float64.",
)


class Rejection(StrEnum):
    """Why a surface is rejected; the values are what JSON calls them."""

    sentence: str  # for a reader

    def __new__(cls, value: str, sentence: str) -> Rejection:
        """Return the string that JSON has, with its sentence."""
        made = str.__new__(cls, value)
        made._value_, made.sentence = value, sentence
        return made

    DEGENERATE = "degenerate", "n = 0: the corners lie on one line, there is no plane"
    PARALLEL = "parallel", "d · n = 0: the ray is parallel to the plane"
    NOT_A_NUMBER = "not_a_number", "t is not a finite number: an operation overflowed"
    S1_NEGATIVE = "s1_negative", "s₁ < 0: x lies beyond the edge p₂p₃"
    S2_NEGATIVE = "s2_negative", "s₂ < 0: x lies beyond the edge p₃p₁"
    S3_NEGATIVE = "s3_negative", "s₃ < 0: x lies beyond the edge p₁p₂"
    S1_ABOVE_1 = "s1_above_1", "s₁ > 1: x lies beyond the corner p₁"
    S2_ABOVE_1 = "s2_above_1", "s₂ > 1: x lies beyond the corner p₂"
    S3_ABOVE_1 = "s3_above_1", "s₃ > 1: x lies beyond the corner p₃"
    SUM = (
        "sum",
        "s₁ + s₂ + s₃ is farther from 1 than rounding takes it: the sᵢ have lost their digits",
    )
    BEHIND = "behind", "t < 0: the plane is behind the eye"
    BEFORE_CLIP_START = "before_clip_start", "t < clip start: nearer than the camera shows"
    BEYOND_CLIP_END = "beyond_clip_end", "t > clip end: farther than the camera shows"


def ray_formulas(projection: Projection) -> dict[str, Formula]:
    """Return the formulas of a ray's origin and direction."""
    return {key: Formula(key, *own) for key, own in projection.formulas.items()}

"""Reads the textbook's formulas, and the sentences on why a surface is rejected.

`formulas.toml` lists them: every formula of the project but the tracer's own code is taken from
there. A formula is plain text: `textbook.py` and the page evaluate it, and all documents show it.
The letters of `VECTORS` are vectors; all else is a number.
"""

from __future__ import annotations

import tomllib
from enum import StrEnum, auto
from pathlib import Path
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


_LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
CAMERA, STORED, PLANE, TRIANGLE, COLOR = (
    {key: Formula(*parts) for key, parts in _LISTED[name].items()}
    for name in ("camera", "stored", "plane", "triangle", "color")
)
ERRATA = tuple(_LISTED["errata"])


class Rejection(StrEnum):
    """Why a surface is rejected; the values are what JSON calls them."""

    DEGENERATE = auto()
    PARALLEL = auto()
    NOT_A_NUMBER = auto()
    S1_NEGATIVE = auto()
    S2_NEGATIVE = auto()
    S3_NEGATIVE = auto()
    S1_ABOVE_1 = auto()
    S2_ABOVE_1 = auto()
    S3_ABOVE_1 = auto()
    SUM = auto()
    BEHIND = auto()
    BEFORE_CLIP_START = auto()
    BEYOND_CLIP_END = auto()

    @property
    def sentence(self) -> str:
        """Why, for a reader."""
        return _LISTED["rejections"][self]


def ray_formulas(projection: Projection) -> dict[str, Formula]:
    """Return the formulas of a ray's origin and direction."""
    return {key: Formula(key, *own) for key, own in projection.formulas.items()}

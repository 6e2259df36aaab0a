"""The programs that a ray/triangle test may be, as data: formulas in order, then conditions.

The textbook's formulas are those that the derivation shows (`derivation/formulas.toml`), in its
notation. A program with one formula or condition changed is a wrong program, and answers as a
student would who made that mistake: see `mutations.py`.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.derivation.expressions import Tree, evaluate, parse, printed
from reference_tracer.derivation.formulas import TRIANGLE

COMPARISONS: dict[str, Callable[[Any, Any], Any]] = {
    ">": operator.gt,
    "<": operator.lt,
    "≥": operator.ge,
    "≤": operator.le,
}
CONSTANTS = {"0": 0.0, "½": 0.5, "1": 1.0, "2": 2.0}
CORNERS = "p₁", "p₂", "p₃"
WEIGHTS = "s₁", "s₂", "s₃"


class Condition(NamedTuple):
    """What must hold of a hit."""

    left: Tree
    comparison: str
    right: str = "0"  # one of CONSTANTS

    def __str__(self) -> str:
        return f"{printed(self.left)} {self.comparison} {self.right}"


def condition(text: str) -> Condition:
    """Return a condition as it is printed: a formula, a comparison and a constant."""
    left, comparison, right = text.rsplit(" ", 2)
    return Condition(parse(left), comparison, right)


class Slip(NamedTuple):
    """A common mistake that is more than one sign, letter or condition: what is written instead."""

    name: str
    sentence: str
    formulas: Mapping[str, str] = {}
    conditions: Mapping[str, tuple[str, ...]] = {}  # by each that is replaced


@dataclass(frozen=True)
class Program:
    """A ray/triangle test.

    Its formulas are trees by their left sides, each made of o, d, p₁, p₂, p₃ and of those before
    it. Among them are t, and the barycentrics s₁, s₂, s₃ of the corners.
    """

    formulas: Mapping[str, Tree]
    conditions: tuple[Condition, ...]
    kinds: tuple[frozenset[str], ...]  # letters that may stand in one another's place
    slips: tuple[Slip, ...] = field(default=(), repr=False)

    @classmethod
    def of(
        cls,
        formulas: Mapping[str, str],
        conditions: tuple[str, ...],
        kinds: tuple[str, ...],
        slips: tuple[Slip, ...] = (),
    ) -> Program:
        """Return a program from its formulas and conditions as they are printed."""
        return cls(
            {label: parse(right) for label, right in formulas.items()},
            tuple(condition(text) for text in conditions),
            tuple(frozenset(kind.split()) for kind in kinds),
            slips,
        )

    @np.errstate(all="ignore")
    def answers(
        self, origins: Floats, directions: Floats, triangles: Floats
    ) -> tuple[Floats, Floats]:
        """Return t (n,), inf where it says to miss, and barycentrics (n, 3).

        Parameters
        ----------
        origins, directions : (n, 3) float64
        triangles : (n, 3, 3) float64
            Pair, corner, component.
        """
        count = len(origins)
        names: dict[str, Any] = {**CONSTANTS, "o": origins.T, "d": directions.T}
        names |= zip(CORNERS, triangles.transpose(1, 2, 0), strict=True)
        for label, right in self.formulas.items():
            names[label] = evaluate(right, names)
        t = np.broadcast_to(names["t"], count)
        hit = np.isfinite(t)
        for left, comparison, bound in self.conditions:
            hit = hit & COMPARISONS[comparison](evaluate(left, names), names[bound])
        s = np.stack([np.broadcast_to(names[w], count) for w in WEIGHTS], axis=1)
        return np.where(hit, t, np.inf), s


def _one_side(towards: str) -> Iterator[Slip]:
    """Yield that triangles are seen from one side only, by the sign of a formula."""
    for name, winding, sign in (
        ("back_faces_culled", "clockwise", ">"),
        ("front_faces_culled", "counter-clockwise", "<"),
    ):
        text = (
            f"triangles whose corners the ray sees {winding} are missed: {towards} may have "
            "either sign, a triangle has two sides"
        )
        yield Slip(name, text, conditions={"t > 0": ("t > 0", f"{towards} {sign} 0")})


TEXTBOOK = Program.of(
    {f.label: f.right for f in (TRIANGLE[k] for k in "n t x ns1 ns2 ns3 area s1 s2 s3".split())},
    ("s₁ ≥ 0", "s₂ ≥ 0", "s₃ ≥ 0", "t > 0"),
    ("p₁ p₂ p₃ x o", "n nₛ₁ nₛ₂ nₛ₃ d"),
    (
        *_one_side("d · n"),
        Slip(
            "s2_s3_swapped",
            "s₂ and s₃ are exchanged: the textbook's erratum. nₛ₂ is 0 on the edge p₁p₂, so what "
            "it gives weighs p₃, and what nₛ₃ gives weighs p₂",
            {"s₂": "(n · nₛ₂) / ‖n‖²", "s₃": "(n · nₛ₃) / ‖n‖²"},
        ),
        Slip(
            "inside_not_tested",
            "the whole plane of the triangle is hit: the barycentrics are not tested",
            conditions={"s₁ ≥ 0": (), "s₂ ≥ 0": (), "s₃ ≥ 0": ()},
        ),
        Slip(
            "only_upper_bounds",
            "sᵢ ≤ 1 is tested, where sᵢ ≥ 0 says what is inside",
            conditions={f"{w} ≥ 0": (f"{w} ≤ 1",) for w in WEIGHTS},
        ),
        Slip(
            "barycentrics_scale",
            "n · nₛᵢ is not divided by ‖n‖²: the barycentrics do not sum to 1",
            {"‖n‖²": "1"},
        ),
        Slip("area_doubled", "‖n‖² is taken twice as large as n · n", {"‖n‖²": "2 (n · n)"}),
        Slip("area_halved", "‖n‖² is taken half as large as n · n", {"‖n‖²": "½ (n · n)"}),
    ),
)

MOLLER_TRUMBORE = Program.of(
    {
        "e₁": "p₂ − p₁",
        "e₂": "p₃ − p₁",
        "h": "d × e₂",
        "a": "e₁ · h",
        "q": "o − p₁",
        "u": "(q · h) / a",
        "r": "q × e₁",
        "v": "(d · r) / a",
        "t": "(e₂ · r) / a",
        "s₁": "1 − u − v",
        "s₂": "u",
        "s₃": "v",
    },
    ("u ≥ 0", "v ≥ 0", "u + v ≤ 1", "t > 0"),
    ("p₁ p₂ p₃ o", "e₁ e₂ h q r d", "u v"),
    (
        *_one_side("a"),
        Slip(
            "parallelogram",
            "u ≤ 1 and v ≤ 1 are tested, where u + v ≤ 1 says what is before the edge p₂p₃: a "
            "parallelogram is hit",
            conditions={"u + v ≤ 1": ("u ≤ 1", "v ≤ 1")},
        ),
        Slip(
            "barycentrics_order",
            "the barycentrics are given as u, v, 1 − u − v: u weighs p₂, v weighs p₃, the rest p₁",
            {"s₁": "u", "s₂": "v", "s₃": "1 − u − v"},
        ),
        Slip(
            "inside_not_tested",
            "the whole plane of the triangle is hit: u and v are not tested",
            conditions={"u ≥ 0": (), "v ≥ 0": (), "u + v ≤ 1": ()},
        ),
    ),
)

PROGRAMS = TEXTBOOK, MOLLER_TRUMBORE

"""The methods by which a ray meets a triangle: a record each.

A new one is its function (`tracer/triangle.py`) and, here, a member and its record. What lists
methods reads these, in this order: options, panels, studies, plots, tables.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum, auto


@dataclass(frozen=True)
class MethodRecord:
    """A method's name, number, colour and texts."""

    label: str  # in Blender's panel
    words: str  # in plots and sentences
    short: str  # in a table
    number: int  # what a .blend stores: one that was given away is never given to another
    color: str  # in plots; distinct for colour-blind readers (after Okabe and Ito)
    description: str  # the tooltip in Blender's panel
    guarantees: str  # of the picture, for the documents


class Method(StrEnum):
    """How a ray meets a triangle, in the order of how far the answer can be trusted.

    A member is its name in options and files. `certified` proves every pixel (`certified/`). `auto`
    does so too where the machine's arithmetic allows a proof, and is `watertight` in float64 where
    it does not.
    """

    TEXTBOOK_LITERAL = auto()
    TEXTBOOK = auto()
    MOLLER_TRUMBORE = auto()
    WATERTIGHT = auto()
    CERTIFIED = auto()
    AUTO = auto()

    @property
    def record(self) -> MethodRecord:
        """The method's record."""
        return RECORDS[self]

    @property
    def is_proven(self) -> bool:
        """Whether it comes with a proof; else it is floating point alone, in either precision."""
        return self in (Method.CERTIFIED, Method.AUTO)


RECORDS = {
    Method.TEXTBOOK_LITERAL: MethodRecord(
        label="Textbook, Literal",
        words="textbook, literal",
        short="literal",
        number=1,
        color="#b0723a",
        description=(
            "The test exactly as printed, with s1 + s2 + s3 = 1: it loses about half of all hits"
        ),
        guarantees="nothing",
    ),
    Method.TEXTBOOK: MethodRecord(
        label="Textbook",
        words="textbook",
        short="textbook",
        number=0,
        color="#d55e00",
        description=(
            "The exercise's test, first the plane and then the barycentrics, usable in "
            "floating point"
        ),
        guarantees="nothing near edges",
    ),
    Method.MOLLER_TRUMBORE: MethodRecord(
        label="Möller–Trumbore",
        words="Möller–Trumbore",
        short="Möller–T.",
        number=2,
        color="#0072b2",
        description="The test that most renderers started from (1997)",
        guarantees="nothing near edges, as neighbours compute the common edge in different ways",
    ),
    Method.WATERTIGHT: MethodRecord(
        label="Watertight",
        words="watertight",
        short="watertight",
        number=3,
        color="#009e73",
        description=(
            "Woop, Benthin and Wald 2013: neighbours compute their common edge from the same "
            "numbers, so that no ray slips between them; it may hit both"
        ),
        guarantees=(
            "no ray slips through an edge or a corner of the triangles as rounded; but it may name "
            "the wrong one of the two at an edge, and either of two surfaces near each other"
        ),
    ),
    Method.CERTIFIED: MethodRecord(
        label="Certified",
        words="certified",
        short="certified",
        number=4,
        color="#7a3d9a",
        description="Every pixel shows what exact arithmetic says it should, or the render fails",
        guarantees="every pixel",
    ),
    Method.AUTO: MethodRecord(
        label="Automatic",
        words="automatic",
        short="automatic",
        number=5,
        color="#222222",
        description=(
            "The cheapest way to a proven picture: an error bound first, and integers only "
            "where it does not decide. Where this machine's arithmetic allows no proof, "
            "watertight with a warning"
        ),
        guarantees="that of the method it came to",
    ),
}
UNPROVEN = tuple(m for m in Method if not m.is_proven)
MEASURED = (*UNPROVEN, Method.CERTIFIED)  # what a study measures: `auto` is one of them

"""The methods: a record each. A new one is its function (`tracer/triangle.py`) and its record here.

What lists methods reads these records, in this order: options, panels, studies, plots, tables.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

from .tracer import triangle


class Method(StrEnum):
    """How a ray meets a triangle, in the order of how far the answer can be trusted.

    A member is its name in options and files, with these attributes. `certified` proves every
    pixel (`tracer/certified`); `auto` does, too, where the machine's arithmetic allows a proof, and
    is `watertight` in float64 where it does not.
    """

    label: str  # this and the description: in Blender's panel
    words: str  # its name in plots and sentences
    short: str  # in a table
    head: str  # over a column of a narrow panel
    number: int  # what a .blend stores; one that was given away is never given to another
    color: str  # in plots; told apart without telling red from green (after Okabe and Ito)
    description: str
    # One of `tracer/triangle.py`; None where pixels are proven.
    function: Callable[..., triangle.Intersection] | None

    TEXTBOOK_LITERAL = (
        "textbook_literal",
        ("Textbook, Literal", "textbook, literal", "literal", "literal"),
        (1, "#b0723a"),
        "The test exactly as printed, s1 + s2 + s3 = 1 included: it loses about half of all hits",
        triangle.textbook_literal,
    )
    TEXTBOOK = (
        "textbook",
        ("Textbook", "textbook", "textbook", "textb."),
        (0, "#d55e00"),
        "The exercise's plane-then-barycentrics test, usable in floating point",
        triangle.textbook,
    )
    MOLLER_TRUMBORE = (
        "moller_trumbore",
        ("Möller–Trumbore", "Möller–Trumbore", "Möller–T.", "Möller"),
        (2, "#0072b2"),
        "The test most renderers started from",
        triangle.moller_trumbore,
    )
    WATERTIGHT = (
        "watertight",
        ("Watertight", "watertight", "watertight", "watert."),
        (3, "#009e73"),
        "Woop, Benthin and Wald: neighbours agree on whose a ray at their edge is, without a proof "
        "of the rest",
        triangle.watertight,
    )
    CERTIFIED = (
        "certified",
        ("Certified", "certified", "certified", "certified"),
        (4, "#7a3d9a"),
        "Every pixel shows what exact arithmetic says it should, or the render fails",
    )
    AUTO = (
        "auto",
        ("Automatic", "automatic", "automatic", "auto"),
        (5, "#222222"),
        "The cheapest way to a proven picture: an error bound first, integers only where it "
        "does not decide. Watertight, and a warning, where this machine allows no proof",
    )

    def __new__(
        cls,
        name: str,
        names: tuple[str, str, str, str],
        of_plots: tuple[int, str],
        description: str,
        function: Callable[..., triangle.Intersection] | None = None,
    ) -> Method:
        """Make a member of a record."""
        self = str.__new__(cls, name)
        self._value_ = name
        self.label, self.words, self.short, self.head = names
        self.number, self.color = of_plots
        self.description, self.function = description, function
        return self

    @property
    def is_plain(self) -> bool:
        """Whether it is floating point alone, in either precision, without a proof."""
        return self.function is not None


PLAIN = tuple(m for m in Method if m.is_plain)
MEASURED = (*PLAIN, Method.CERTIFIED)  # what a study measures: `auto` is one of them

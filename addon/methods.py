"""The methods: a record each, in `methods.toml`, which says what its words mean.

A new one is its function (`tracer/triangle.py`), its record, and a member here. What lists methods
reads these, in this order: options, panels, studies, plots, tables.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from enum import StrEnum, auto
from pathlib import Path
from typing import Any

_LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


class Method(StrEnum):
    """How a ray meets a triangle, in the order of how far the answer can be trusted.

    A member is its name in options and files, its attributes are its record's. `certified` proves
    every pixel (`certified`); `auto` does, too, where the machine's arithmetic allows a
    proof, and is `watertight` in float64 where it does not.
    """

    label: str
    words: str
    short: str
    head: str
    number: int
    color: str
    description: str

    TEXTBOOK_LITERAL = auto()
    TEXTBOOK = auto()
    MOLLER_TRUMBORE = auto()
    WATERTIGHT = auto()
    CERTIFIED = auto()
    AUTO = auto()

    def __init__(self, name: str) -> None:
        vars(self).update(_LISTED[name])

    @property
    def is_plain(self) -> bool:
        """Whether it is floating point alone, in either precision, without a proof."""
        return self not in (Method.CERTIFIED, Method.AUTO)

    @property
    def function(self) -> Callable[..., Any] | None:
        """The one of its name in `tracer/triangle.py`; None where pixels are proven."""
        from .tracer import triangle  # late: to register, Blender needs no numpy

        return getattr(triangle, self) if self.is_plain else None


PLAIN = tuple(m for m in Method if m.is_plain)
MEASURED = (*PLAIN, Method.CERTIFIED)  # what a study measures: `auto` is one of them

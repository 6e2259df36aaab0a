"""The causes: one record each, with all that is said, drawn and counted of it.

A new cause is a member of `Cause`, its record in `cause.toml` and a check in `checks/`. The counts,
the texts, the JSON, the page's legend, the panel and the difference picture read the record.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from enum import IntEnum
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Color = tuple[float, float, float]


@dataclass
class Record:
    """What there is to say of a cause: an entry of `cause.toml`, which says what is what."""

    label: str
    sentence: str
    unit: str = ""
    color: Color | None = None
    explains: bool = False
    warns: bool = False
    rounding: bool = False
    see_through: bool = False

    def __post_init__(self) -> None:
        self.color = self.color and tuple(self.color)


_LISTED = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


class Cause(IntEnum):
    """What is said of a pixel, in the order of the legend; its attributes are its `Record`'s.

    The numbers are stored in `frame.npz`: they stay.
    """

    AGREE = 0
    EDGE = 1
    DEPTH_TIE = 2
    CLIP_PLANE = 7
    ANTI_ALIASING = 8
    COLOR = 9
    NOT_MODELLED = 3
    HIDDEN = 10
    NOT_DECIDABLE = 4
    UNEXPLAINED = 5
    NOT_TRACED = 6

    def __init__(self, _: int) -> None:
        self.__dict__.update(vars(Record(**_LISTED[self.key])))

    @property
    def key(self) -> str:
        """The name in JSON."""
        return self.name.lower()

    @property
    def differs(self) -> bool:
        """Whether a pixel with this cause counts as one that differs."""
        return self.explains or self is Cause.UNEXPLAINED

    def told(self, figure: float, allowed: float, name: object = "") -> str:
        """Return the sentence with a pixel's numbers, or the name that its index stands for."""
        return self.sentence.format(figure=figure, allowed=allowed, name=name)

    def to_dict(self) -> dict[str, int | str]:
        """Return what a reader of JSON needs to know of the cause."""
        told = {"label": self.label, "sentence": self.sentence, "unit": self.unit}
        return {"number": int(self), **told}


class Shade(NamedTuple):
    """An object that the picture shows in another shade, by a transform if one was found."""

    object: str
    pixels: int
    transform: str = ""

    def line(self) -> str:
        """Return it as a sentence without its full stop."""
        how = f": {self.transform}" if self.transform else ""
        return f"'{self.object}' is shown in another shade ({self.pixels:,} px){how}"


class Hidden(NamedTuple):
    """An object that only one side shows, and why."""

    object: str
    reason: str

    def __str__(self) -> str:
        return f"'{self.object}': {self.reason}"


@dataclass(eq=False)
class Causes:
    """What is said of every pixel, with the figure that says it.

    `cause` is (h, w) uint8, a `Cause` each; `figure` (h, w) float64, NaN where there is none, and
    `allowed` (h, w) the bound that it was held against: the cause's sentence says what they mean.
    An index is one into the manifest's `unmodelled`, or into `hidden`. `transform` is what was
    found to turn the traced colours into those of the picture, in words; "" for nothing. `blind`
    (h, w) int32 is the feature of `unmodelled` that keeps a pixel from being judged, else -1.
    """

    cause: NDArray[np.uint8]
    figure: NDArray[np.float64]
    allowed: NDArray[np.float64]
    blind: NDArray[np.int32]
    hidden: list[Hidden] = field(default_factory=list)
    transform: str = ""
    shades: list[Shade] = field(default_factory=list)
    # Differing pixels that no check looked at, (n,), numbered row by row.
    passed_over: NDArray[np.intp] = field(default_factory=lambda: np.zeros(0, np.intp))

    @classmethod
    def none(cls, shape: tuple[int, int]) -> Causes:
        """Return those of a picture (h, w) that agrees."""
        figures = np.full(shape, np.nan), np.full(shape, np.nan)
        return cls(np.zeros(shape, np.uint8), *figures, np.full(shape, -1, np.int32))

    @property
    def unjudged(self) -> NDArray[np.bool_]:
        """Which pixels (h, w) cannot be judged: whatever were shown there would not be found."""
        return (self.blind >= 0) | (self.cause == Cause.NOT_DECIDABLE)

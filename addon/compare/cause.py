"""The causes: one record each, with all that is said, drawn and counted of it.

A new cause is a member of `Cause` and a check in `checks/`. The counts, the texts, the JSON, the
page's legend, the panel and the difference picture read the record.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Color = tuple[float, float, float]


@dataclass(frozen=True)
class Record:
    """What there is to say of a cause."""

    number: int  # stored in `frame.npz`: it stays
    label: str
    # With the fields {figure} and {allowed}, as `str.format` has them; {name} is what a figure that
    # is an index counts.
    sentence: str
    unit: str = ""  # of the figure
    # Linear RGB in the difference picture; colour-blind readers tell them apart, too. None: the
    # pixel agrees.
    color: Color | None = None
    explains: bool = False  # the pixel differs, and this is why
    warns: bool = False  # the verdict is no better than 'warnings' where a pixel has it
    rounding: bool = False  # Blender's own float32 arithmetic accounts for the pixel
    see_through: bool = False  # whole surfaces have it: they stay visible in the difference picture


class Cause(IntEnum):
    """What is said of a pixel, in the order of the legend; its attributes are its `Record`'s."""

    AGREE = Record(0, "agree", "both show the same")
    EDGE = Record(
        1,
        "edge",
        "{figure:.3g} px from the centre the tracer sees what Blender shows (float32 and its "
        "rasteriser may be off by {allowed:.3g} px)",
        "px",
        (1.0, 0.3, 0.0),
        explains=True,
        rounding=True,
    )
    DEPTH_TIE = Record(
        2,
        "depth tie",
        "what Blender shows lies {figure:.3g} m behind what the tracer sees (a depth buffer tells "
        "{allowed:.3g} m apart there)",
        "m",
        (0.0, 0.7, 1.0),
        explains=True,
        rounding=True,
    )
    CLIP_PLANE = Record(
        7,
        "clip plane",
        "a surface lies {figure:.3g} m from a clip plane, and float32 clips to within "
        "{allowed:.3g} m",
        "m",
        (1.0, 1.0, 0.4),
        explains=True,
        rounding=True,
    )
    ANTI_ALIASING = Record(
        8,
        "anti-aliasing",
        "the colour is a mix of what the tracer sees within {figure:.3g} px (the filter reaches "
        "{allowed:.3g} px)",
        "px",
        (0.7, 0.4, 0.2),
        explains=True,
        warns=True,
    )
    COLOR = Record(
        9,
        "colour only",
        "the same object in another shade: {figure:.3g} is left after the transform that the "
        "comparison names (allowed: {allowed:.3g})",
        "of 1",
        (0.4, 0.7, 0.7),
        explains=True,
        warns=True,
        see_through=True,
    )
    NOT_MODELLED = Record(
        3,
        "not modelled",
        "{name} changes the pixel",
        "index",
        (0.3, 0.08, 0.9),
        explains=True,
        warns=True,
    )
    HIDDEN = Record(
        10,
        "hidden for one side",
        "only one side shows {name}",
        "index",
        (0.08, 0.2, 0.08),
        explains=True,
        warns=True,
    )
    NOT_DECIDABLE = Record(
        4,
        "not decidable",
        "float32 may move Blender's surfaces by {figure:.3g} px there (decidable up to "
        "{allowed:.3g} px)",
        "px",
        (0.25, 0.3, 0.6),
        warns=True,
        see_through=True,
    )
    UNEXPLAINED = Record(
        5, "unexplained", "no check accounts for the difference", color=(1.0, 0.0, 0.0)
    )
    NOT_TRACED = Record(6, "not traced", "the picture was cancelled before", color=(0.0, 0.0, 0.0))

    def __new__(cls, record: Record) -> Cause:
        """Make the member whose number, and whose attributes, are the record's."""
        cause = int.__new__(cls, record.number)
        cause._value_ = record.number
        cause.__dict__.update(vars(record))
        return cause

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
    passed_over: int = 0  # differing pixels that no check looked at

    @classmethod
    def none(cls, shape: tuple[int, int]) -> Causes:
        """Return those of a picture (h, w) that agrees."""
        figures = np.full(shape, np.nan), np.full(shape, np.nan)
        return cls(np.zeros(shape, np.uint8), *figures, np.full(shape, -1, np.int32))

    @property
    def unjudged(self) -> NDArray[np.bool_]:
        """Which pixels (h, w) cannot be judged: whatever were shown there would not be found."""
        return (self.blind >= 0) | (self.cause == Cause.NOT_DECIDABLE)

"""The record of a cause, and the causes of all pixels of a comparison.

The record of a cause stands beside the check that gives it, in `checks/`; the four below have no
check. `explain.py` lists them all. Counts, texts, JSON, the page's legend, the panel and the
difference picture read the record.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple, Self

import numpy as np

from ..arrays import Bools, Bytes, Floats, Integers, Places

Color = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Cause(int):
    """Why a pixel differs, or that it agrees. It compares and sorts as its number."""

    number: int  # `frame.npz` stores it: it stays
    key: str  # its name in JSON
    label: str
    # With the pixel's {figure} and its bound {allowed}, or the {name} that an index stands for.
    sentence: str
    unit: str = ""  # of the figure; 'index' where it counts things that have a name
    # Linear RGB in the difference picture, which colour-blind readers tell apart, too; None for
    # pixels that agree.
    color: Color | None = None
    # The pixel differs, and this is why; the four below have counts of their own in the JSON.
    explains: bool = False
    warns: bool = False  # with such a pixel the verdict is no better than 'warnings'
    rounding: bool = False  # Blender's own float32 arithmetic accounts for the pixel
    see_through: bool = False  # whole surfaces have it: they stay visible in the difference picture
    place: str = ""  # after a count of pixels: '3 px at edges'; the label, if it is empty
    # For the documents, which are made of these.
    why: str = ""  # why it happens
    check: str = ""  # what is checked before a pixel gets the cause
    never: str = ""  # what it cannot excuse
    advice: str = ""  # what to do

    def __new__(cls, number: int, *_: object, **__: object) -> Self:
        """Return the record as an integer, its number."""
        return super().__new__(cls, number)

    def in_words(self, figure: float, allowed: float, name: object = "") -> str:
        """Return the sentence with a pixel's numbers, or the name that its index stands for."""
        return self.sentence.format(figure=figure, allowed=allowed, name=name)

    def count_in_words(self, pixels: int, words: Callable[[str], str] = str) -> str:
        """Return a count of pixels with the cause: '3 px at edges'; `words` translates."""
        return f"{pixels:,} px {words(self.place or self.label)}"

    def to_dict(self) -> dict[str, int | str]:
        """Return the fields that JSON has of the cause."""
        told = {"label": self.label, "sentence": self.sentence, "unit": self.unit}
        return {"number": self.number, **told}


AGREE = Cause(0, "agree", "agree", "both show the same")
NOT_DECIDABLE = Cause(
    4,
    "not_decidable",
    "not decidable",
    "float32 may move surfaces by {figure:.3g} px there (decidable up to {allowed:.3g} px)",
    "px",
    (0.25, 0.3, 0.6),
    warns=True,
    see_through=True,
    why="So far from the origin, or at such a scale, float32 moves surfaces by more than half a "
    "pixel: what the picture shows there proves nothing.",
    check="The bound of float32's error for the surfaces around the pixel is larger. It depends "
    "on the scene, not on the picture.",
    never="Any other pixel.",
    advice="move the scene to the origin, or apply the objects' scale",
)
UNEXPLAINED = Cause(
    5,
    "unexplained",
    "unexplained",
    "no check accounts for the difference",
    color=(1.0, 0.0, 0.0),
    why="The picture is wrong there, or it is of another scene than the one that was traced.",
    check="No other check finds a cause. Where more than 65,536 pixels differ, the checks look at "
    "16,384 of them first, and at no others if fewer than 1 % of these have a cause.",
    advice="read the diagnosis, and have one such pixel explained (`reftrace explain`, *Inspect "
    "Pixels*)",
)
NOT_TRACED = Cause(
    6,
    "not_traced",
    "not traced",
    "the picture was cancelled before",
    color=(0.0, 0.0, 0.0),
    why="The comparison was cancelled before the pixel's row was traced.",
    advice="compare again, and let it finish",
)


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
    """The cause of each pixel (h, w), and the number that supports it."""

    cause: Bytes  # the number of its `Cause`
    figure: Floats  # as the cause's sentence says; NaN where there is none
    allowed: Floats  # the bound that the figure was held against
    # The feature of the manifest's `unmodelled` that keeps the pixel from being judged, else -1.
    blind: Integers
    # (h, w) where what is behind glass was judged, by a picture without it; None if nowhere.
    behind: Bools | None = None
    hidden: list[Hidden] = field(default_factory=list)  # a figure may be an index into it
    transform: str = ""  # what turns the traced colours into the picture's, in words
    made_by: Callable[[Floats], Floats] | None = None  # that transform, if it is one of each colour
    shades: list[Shade] = field(default_factory=list)
    # Differing pixels that no check looked at, (n,), numbered row by row.
    passed_over: Places = field(default_factory=lambda: np.zeros(0, np.intp))
    not_asked: int = 0  # unexplained pixels of very many that no check looked at

    @classmethod
    def none(cls, shape: tuple[int, ...]) -> Causes:
        """Return the causes of a picture (h, w) in which every pixel agrees."""
        figure = np.full(shape, np.nan)
        blind = np.full(shape, -1, np.int32)
        return cls(np.zeros(shape, np.uint8), figure, figure.copy(), blind)

    @property
    def unjudged(self) -> Bools:
        """The pixels (h, w) that cannot be judged: no fault would be found in them."""
        return (self.blind >= 0) | (self.cause == NOT_DECIDABLE)

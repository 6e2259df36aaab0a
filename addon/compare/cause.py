"""What can be said of a pixel, and when two pixels differ at all."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..images import encoded

# Blender hands its viewport's colours over as half floats, 11 bits, and cuts off rather than
# rounds: 1 reads 0.9995. Next to an edge a window copies them once more, and up to 3 units in the
# last place are missing (measured in 4.3). So many units of the larger value are allowed.
UNITS = 4

# That copy lets a little of the neighbour through: beside a white pixel, black reads 3 * 2^-14
# (measured in 4.3). Eight such steps are allowed.
LEAST = 8 * 2.0**-14

# Workbench adds up the logarithms of 1 + a colour in half floats; of a dark one, this is lost.
LEAST_SUMMED = 2.0**-12

# A rasteriser interpolates a colour attribute between corners that it has rounded to 1/256 pixel,
# by an approximate 1/w: a ramp over a few pixels is off by as much as this (measured 0.0013).
INTERPOLATED = 2.0**-9

# What a writer's own rounding of sRGB's curve may add to half a level (float32, tables).
LEVEL_SLACK = 0.02


class Cause(IntEnum):
    """What is said of a pixel; the numbers are stored in `frame.npz`, and stay."""

    AGREE = 0
    EDGE = 1  # within Blender's own error of the centre, the tracer sees what Blender shows
    DEPTH_TIE = 2  # what Blender shows lies behind, by less than the depth buffer resolves
    NOT_MODELLED = 3  # something that the tracer does not model is drawn there
    NOT_DECIDABLE = 4  # float32 moves Blender's surfaces by more than half a pixel
    UNEXPLAINED = 5
    NOT_TRACED = 6  # a cancelled picture does not have it
    CLIP_PLANE = 7  # a surface lies so near a clip plane that float32 decides whether it is drawn
    ANTI_ALIASING = 8  # Blender's colour is a mix of what the tracer sees within the filter
    COLOR = 9  # the same object in another shade, which a transform or the light accounts for
    HIDDEN = 10  # an object that only one side shows, for a reason that the scene names


class Description(NamedTuple):
    """How a cause is told: its name, a sentence with `figure` and `allowed`, the figure's unit."""

    label: str
    sentence: str
    unit: str

    def told(self, figure: float, allowed: float) -> str:
        """Return the sentence with a pixel's numbers."""
        return self.sentence.format(figure=figure, allowed=allowed)


DESCRIPTIONS: dict[Cause, Description] = {
    Cause.AGREE: Description("agree", "both show the same", ""),
    Cause.EDGE: Description(
        "edge",
        "{figure:.3g} px from the centre the tracer sees what Blender shows (float32 and its "
        "rasteriser may be off by {allowed:.3g} px)",
        "px",
    ),
    Cause.DEPTH_TIE: Description(
        "depth tie",
        "what Blender shows lies {figure:.3g} m behind what the tracer sees (a depth buffer tells "
        "{allowed:.3g} m apart there)",
        "m",
    ),
    Cause.CLIP_PLANE: Description(
        "clip plane",
        "a surface lies {figure:.3g} m from a clip plane, and float32 clips to within "
        "{allowed:.3g} m",
        "m",
    ),
    Cause.ANTI_ALIASING: Description(
        "anti-aliasing",
        "the colour is a mix of what the tracer sees within {figure:.3g} px (the filter reaches "
        "{allowed:.3g} px)",
        "px",
    ),
    Cause.COLOR: Description(
        "colour only",
        "the same object in another shade: {figure:.3g} is left after the transform that the "
        "comparison names (allowed: {allowed:.3g})",
        "of 1",
    ),
    Cause.NOT_MODELLED: Description(
        "not modelled",
        "feature {figure:.0f} (from 0) of the scene's unmodelled ones is drawn there",
        "index",
    ),
    Cause.HIDDEN: Description(
        "hidden for one side",
        "entry {figure:.0f} (from 0) of the comparison's hidden objects: only one side shows it",
        "index",
    ),
    Cause.NOT_DECIDABLE: Description(
        "not decidable",
        "float32 may move Blender's surfaces by {figure:.3g} px there (decidable up to "
        "{allowed:.3g} px)",
        "px",
    ),
    Cause.UNEXPLAINED: Description("unexplained", "no check accounts for the difference", ""),
    Cause.NOT_TRACED: Description("not traced", "the picture was cancelled before", ""),
}

EXPLAINED = (
    Cause.EDGE,
    Cause.DEPTH_TIE,
    Cause.CLIP_PLANE,
    Cause.ANTI_ALIASING,
    Cause.COLOR,
    Cause.NOT_MODELLED,
    Cause.HIDDEN,
)


class Hidden(NamedTuple):
    """An object that only one side shows, and why."""

    object: str
    reason: str


@dataclass(eq=False)
class Causes:
    """What is said of every pixel, with the figure that says it.

    `cause` is (h, w) uint8, a `Cause` each; `figure` (h, w) float64, NaN where there is none, and
    `allowed` (h, w) the bound that it was held against: DESCRIPTIONS says what they mean. An index
    is one into the manifest's `unmodelled`, or into `hidden`. `transform` is what was found to turn
    the traced colours into those of the picture, in words; "" for nothing.
    """

    cause: NDArray[np.uint8]
    figure: NDArray[np.float64]
    allowed: NDArray[np.float64]
    hidden: list[Hidden] = field(default_factory=list)
    transform: str = ""
    passed_over: int = 0  # differing pixels that nobody was asked to look at


@dataclass(eq=False)
class Settler:
    """Writes a cause and takes its pixels off the open ones."""

    out: Causes
    open: NDArray[np.bool_]

    def __call__(
        self,
        where: NDArray[np.bool_],
        cause: Cause,
        figure: ArrayLike | None = None,
        allowed: ArrayLike = np.nan,
    ) -> None:
        """Give the pixels of `where` a cause, but those that have one already."""
        where = where & (self.out.cause == Cause.AGREE)
        self.out.cause[where] = cause
        if figure is not None:
            self.out.figure[where] = np.broadcast_to(figure, where.shape)[where]
            self.out.allowed[where] = np.broadcast_to(allowed, where.shape)[where]
        self.open &= ~where

    def rows(self, rows: slice) -> Settler:
        """Return the same for some rows; it writes into the whole."""
        o = self.out
        out = Causes(o.cause[rows], o.figure[rows], o.allowed[rows], o.hidden, o.transform)
        return Settler(out, self.open[rows])


def differing(
    first: NDArray,
    second: NDArray,
    interpolated: NDArray[np.bool_] | bool = False,
    levels: int = 0,
    sums: int = 0,
    dither: float = 0.0,
) -> NDArray[np.bool_]:
    """Return which pixels of two (..., c) pictures differ by more than rounding.

    UNITS of a half float's last place are allowed, but at least LEAST; where a colour is
    `interpolated` (...), INTERPOLATED more. What is not finite differs from everything. Where the
    second picture was stored in so many `levels` above 0 of sRGB's curve, as a PNG is, half a level
    is allowed in place of that, and `dither` levels of noise. A mean of `sums` samples, added up in
    half floats, loses half a unit with each.
    """
    size = np.maximum(np.abs(first), np.abs(second))
    apart, allowed = difference(first, second, interpolated, levels, sums, dither)
    with np.errstate(invalid="ignore"):
        return ~((apart <= allowed) & np.isfinite(size)).all(axis=-1)


def difference(
    first: NDArray,
    second: NDArray,
    interpolated: NDArray[np.bool_] | bool = False,
    levels: int = 0,
    sums: int = 0,
    dither: float = 0.0,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how far two pictures are apart, (..., c), and how far :func:`differing` allows."""
    first, second = first.astype(np.float64), second.astype(np.float64)
    more = INTERPOLATED * np.asarray(interpolated, dtype=np.float64)[..., None]
    if levels:
        first, second = encoded(first), encoded(second)
    with np.errstate(invalid="ignore"):
        apart = np.abs(first - second)
        if levels:
            return apart, np.broadcast_to((0.5 + LEVEL_SLACK + dither) / levels + more, apart.shape)
        size = np.maximum(np.abs(first), np.abs(second))
        unit = np.spacing(np.minimum(size, 2.0**15).astype(np.float16))  # the last binade
        unit = unit.astype(np.float64)
        more = more + sums / 2 * np.maximum(unit, LEAST_SUMMED)
        return apart, np.maximum(UNITS * unit, LEAST) + more

"""Finds the background of a foreign picture, which need not be the scene's.

Where the tracer sees nothing, nearly all of a picture may have one colour, such as black, that is
not the scene's. Then the scene is compared before that background, and only pixels that deviate
from it differ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...arrays import Bools, Colors
from ...files.images import encoded
from ...pictures.metrics import boundary
from ...pictures.picture import Curve, Picture
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from . import color as colors
from .probe import by_blocks, other_color

NEAR = 2.0**-7  # a surface with a colour this near to a background's looks like it
NEARLY_ALL = 0.75  # of the pixels that see nothing, away from edges


class Background(NamedTuple):
    """The picture's background and the scene's, linear RGBA with premultiplied alpha."""

    picture: tuple[float, ...]
    scene: tuple[float, ...]
    opaque: bool = False  # the picture has no alpha
    pixels: int = 0  # in which it is shown
    total: int = 0  # of the picture

    @property
    def transparent(self) -> bool:
        """Whether the picture shows nothing there: no colour that could be a surface's."""
        return not self.opaque and self.picture[3] == 0

    def line(self) -> str:
        """Return it as a sentence without its full stop."""
        picture, scene = (_name(color, self.opaque) for color in (self.picture, self.scene))
        return (
            f"the picture's background is {picture} where the scene's is {scene}: compared with "
            "the picture's"
        )

    def unjudged(self) -> str:
        """Say which part of the picture is taken for background, where no fault would be seen."""
        name, share = _name(self.picture, self.opaque), self.pixels / max(self.total, 1)
        return (
            f"{name}, in {self.pixels:,} px ({100 * share:.0f} %), is taken for the background: "
            "whether something of that colour stands there is not judged"
        )

    def to_dict(self) -> dict[str, object]:
        """Return it as JSON can hold it."""
        return {
            "text": self.line(),
            "pixels": self.pixels,
            "not_judged": None if self.transparent else self.unjudged(),
            "picture": list(self.picture),
            "scene": list(self.scene),
        }


def find_background(
    frame: Frame, picture: Picture, curves: Sequence[Curve]
) -> Work[Background | None]:
    """Return the background of a picture (h, w) that has one of its own, else None.

    `curves` are what may have been done to the colours. What the transform of the surfaces makes of
    the scene's background still counts as the scene's.
    """
    interior = frame.rows_done[:, None] & ~boundary(frame)
    nothing = (frame.instance_index == NOTHING) & interior
    if not nothing.any():
        return None
    own, color = frame.scene.background, np.median(picture.color[nothing], axis=0)

    same = nothing & ~(yield from other_color(picture, color))
    if not np.isfinite(color).all() or same.sum() < NEARLY_ALL * nothing.sum():
        return None
    found = yield from colors.find_transform(frame, picture, interior, curves)
    transform = found.of if found else picture.transform
    surface, made = interior & ~nothing, replace(picture, transform=transform)
    if not (yield from _apart(frame, made, color, surface)):
        return None
    one = replace(picture, color=color[None].astype(np.float32), owners=None, transform=transform)
    if not one.other_color(own[None])[0]:
        return None
    shown = frame.instance_index == NOTHING
    shown &= ~(yield from other_color(picture, color))
    colors_of_both = tuple(map(float, color)), tuple(map(float, own))
    return Background(*colors_of_both, picture.storage.opaque, int(shown.sum()), shown.size)


def _apart(frame: Frame, picture: Picture, color: Colors, surface: Bools) -> Work[bool]:
    """Return whether a colour may be the background: surfaces of that colour are in place.

    (A picture upside down shows the floor where the sky is, and the sky where the floor is.)
    """

    def has_it(rows: slice) -> Bools:
        made = picture.made_of(frame.color[rows])
        return surface[rows] & (np.abs(made - color[: made.shape[-1]]) <= NEAR).all(axis=-1)

    own = yield from by_blocks(surface.shape, has_it)
    shown = own & ~(yield from other_color(picture, frame.color))
    return bool(shown.sum() >= NEARLY_ALL * own.sum())


def _name(color: Sequence[float], opaque: bool) -> str:
    """Name linear premultiplied RGBA by its sRGB values, as a screen shows them."""
    if color[3] == 0 and not opaque:
        return "transparent"
    red, green, blue, alpha = (round(float(v), 3) for v in encoded(np.array(color)))
    name = f"({red:g}, {green:g}, {blue:g}) of sRGB"
    if red == green == blue and red in (0, 1):
        name = "white" if red else "black"
    return name if opaque or alpha == 1 else f"{name} with alpha {alpha:g}"

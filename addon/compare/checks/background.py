"""The background of a foreign picture, which need not be the scene's: transparent, black, white.

Where the tracer sees nothing, nearly all of a picture may have one colour that is not the scene's.
Then the scene is compared on that background, and the pixels that deviate from it remain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ...arrays import Colors, Mask
from ...images import encoded
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.progress import Work
from ..metrics import boundary
from ..picture import Curve, Picture
from . import color as colors
from .probe import blocks

NEAR = 2.0**-7  # so near a surface's colour is to a background's that these are one
NEARLY_ALL = 0.75  # of the pixels that see nothing, away from edges
_NAMES = {(0, 0, 0): "black", (1, 1, 1): "white"}


class Background(NamedTuple):
    """Two backgrounds, linear RGBA with premultiplied alpha: the picture's and the scene's."""

    picture: tuple[float, ...]
    scene: tuple[float, ...]
    opaque: bool = False  # the picture has no alpha

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

    def to_dict(self) -> dict[str, Any]:
        """Return it as JSON can hold it."""
        return {"text": self.line(), "picture": list(self.picture), "scene": list(self.scene)}


def find_background(
    frame: Frame, picture: Picture, curves: Sequence[Curve]
) -> Work[Background | None]:
    """Return the background of a picture (h, w) that has one of its own, else None.

    The scene's background through the transform that the surfaces went through is the scene's;
    `curves` are what may have been done to the colours.
    """
    interior = frame.rows_done[:, None] & ~boundary(frame)
    nothing = (frame.instance_index == NOTHING) & interior
    if not nothing.any():
        return None
    own, color = frame.scene.background, np.median(picture.color[nothing], axis=0)
    same = 0
    for rows in blocks(nothing.shape):
        there = picture.at(rows).at(nothing[rows])
        same += int((~there.other_color(np.broadcast_to(color, there.color.shape))).sum())
        yield 0.0
    if not np.isfinite(color).all() or same < NEARLY_ALL * nothing.sum():
        return None
    found = yield from colors.find_transform(frame, picture, interior, curves)
    transform = found.of if found else None
    surface, made = interior & ~nothing, replace(picture, transform=transform)
    if not (yield from _apart(frame, made, color, surface)):
        return None
    one = replace(picture, color=color[None].astype(np.float32), owner=None, transform=transform)
    if not one.other_color(own[None])[0]:
        return None
    return Background(tuple(map(float, color)), tuple(map(float, own)), picture.opaque)


def _apart(frame: Frame, picture: Picture, color: Colors, surface: Mask) -> Work[bool]:
    """Return whether a colour is a background's: surfaces that have it are where they should be.

    A picture upside down shows the floor where the sky is, and the sky where the floor is.
    """
    of, shown = 0, 0
    for rows in blocks(surface.shape):
        made = picture.made_of(frame.color[rows])
        own = surface[rows] & (np.abs(made - color[: made.shape[-1]]) <= NEAR).all(axis=-1)
        there = picture.at(rows).at(own)
        of += len(there.color)
        shown += int((~there.other_color(frame.color[rows][own])).sum())
        yield 0.0
    return shown >= NEARLY_ALL * of


def _name(color: Sequence[float], opaque: bool) -> str:
    """Name linear premultiplied RGBA, by what a screen shows."""
    if color[3] == 0 and not opaque:
        return "transparent"
    *rgb, alpha = (round(float(v), 3) for v in encoded(np.array(color)))
    of = _NAMES.get(tuple(rgb)) or f"({', '.join(f'{v:g}' for v in rgb)}) of sRGB"
    return of if opaque or alpha == 1 else f"{of} with alpha {alpha:g}"

"""The background of a foreign picture, which need not be the scene's: transparent, black, white.

Where the tracer sees nothing, nearly all of a picture may have one colour that is not the scene's.
Then the scene is compared on that background, and the pixels that deviate from it remain.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..images import encoded
from ..scene import Scene
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from . import transforms
from .boundary import boundary
from .known import Known
from .shown import Shown

NEARLY_ALL = 0.75  # of the pixels that see nothing, away from edges
_NAMES = {(0, 0, 0): "black", (1, 1, 1): "white"}


@dataclass(frozen=True)
class Background:
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

    def under(self, scene: Scene) -> Scene:
        """Return a scene before the picture's background."""
        return replace(scene, background=np.array(self.picture, np.float32))

    def behind(self, known: Known) -> Known:
        """Return what is known with the picture's background behind every scene."""
        later = known.next_frame
        return replace(
            known,
            alternatives=tuple(replace(a, scene=self.under(a.scene)) for a in known.alternatives),
            next_frame=later and self.under(later),
        )


def find_background(
    frame: Frame, shown: Shown, curves: Sequence[transforms.Named]
) -> Background | None:
    """Return the background of a picture that has one of its own, else None.

    Parameters
    ----------
    frame : Frame
    shown : Shown
        (h, w).
    curves : sequence of transforms.Named
        What may have been done to the colours: the scene's background through the transform that
        the surfaces went through is the scene's.
    """
    at_edge = boundary(frame)
    nothing = (frame.instance_index == NOTHING) & frame.rows_done[:, None] & ~at_edge
    if not nothing.any():
        return None
    there, own = shown.at(nothing), frame.scene.background
    color = np.median(there.color, axis=0)
    if not np.isfinite(color).all() or _share(there, color) < NEARLY_ALL:
        return None
    one = replace(shown, color=color[None].astype(np.float32), owner=None)
    found = transforms.find(frame, shown, frame.rows_done[:, None] & ~at_edge, curves)
    seen = one.through(found.of) if found else one
    if not seen.other_color(own[None])[0]:
        return None
    return Background(tuple(map(float, color)), tuple(map(float, own)), shown.opaque)


def _share(shown: Shown, color: NDArray) -> float:
    """Return the share of n pixels that have a colour (4,)."""
    return float(np.mean(~shown.other_color(np.broadcast_to(color, shown.color.shape))))


def _name(color: Sequence[float], opaque: bool) -> str:
    """Name linear premultiplied RGBA, by what a screen shows."""
    if color[3] == 0 and not opaque:
        return "transparent"
    *rgb, alpha = (round(float(v), 3) for v in encoded(np.array(color)))
    of = _NAMES.get(tuple(rgb)) or f"({', '.join(f'{v:g}' for v in rgb)}) of sRGB"
    return of if opaque or alpha == 1 else f"{of} with alpha {alpha:g}"

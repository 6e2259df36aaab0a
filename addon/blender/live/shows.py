"""What a 3D view in Rendered mode can show: a record each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene import Camera, Scene
from ...tracer.frame import Frame
from ...tracer.render import steps
from ...tracer.settings import Settings


@dataclass(eq=False)
class Picture:
    """A picture of h x w pixels that is being made: a camera's region, row 0 at the bottom."""

    color: NDArray[np.float32]  # (h, w, 4) linear RGBA, alpha premultiplied
    rows_done: NDArray[np.bool_]  # (h,) of which the colour is known
    line: str = ""  # said in the view's corner

    @classmethod
    def empty(cls, camera: Camera) -> Picture:
        """Return one with no row done."""
        height, width = camera.region.height, camera.region.width
        return cls(np.zeros((height, width, 4), np.float32), np.zeros(height, bool))


class Show(NamedTuple):
    """One thing to show; `steps` fills a picture in steps of some milliseconds, with the share."""

    identifier: str
    label: str
    description: str
    number: int  # what a .blend stores: one that was given away is never given to another
    steps: Callable[[Scene, Settings, Picture], Iterator[float]]
    is_raw: bool = False  # whether a screen shows the values as they are, by no view transform


def picture(scene: Scene, settings: Settings, shown: Picture) -> Iterator[float]:
    """Trace the picture of F12."""
    frame = Frame.empty(scene)
    shown.color, shown.rows_done = frame.color, frame.rows_done
    yield from steps(scene, settings, frame)


SHOWS = (Show("PICTURE", "Picture", "What a render shows", 0, picture),)


def chosen(context: Any) -> Show:
    """Return what the view of a context is to show."""
    return SHOWS[0]

"""A picture of a 3D view in the making, coarse or whole, and its way to the screen."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any, NamedTuple

from ...scene import Camera
from ...tracer.settings import Settings
from .camera import coarser
from .drawing import Textures
from .kept import KeptScene
from .shows import Picture, Show


class Wanted(NamedTuple):
    """What a view is to show; two that are equal look the same."""

    camera: str  # all that it has
    version: int  # of the scene
    settings: Settings
    show: Show
    space: int  # the address of the view's

    def is_moved(self, other: Wanted) -> bool:
        """Return whether the camera alone is another one."""
        return self != other and self[1:] == other[1:]


class Job:
    """A picture whose pixels are `factor` times as wide and high as those of the region."""

    def __init__(self, wanted: Wanted, kept: KeptScene, camera: Camera, factor: int) -> None:
        self.wanted, self.factor = wanted, factor
        scene = kept.scene(camera if factor == 1 else coarser(camera, factor))
        self._size = camera.width, camera.height
        self._corner = scene.camera.region.x0, scene.camera.region.y0
        self.picture = Picture.empty(scene.camera, wanted.space, factor > 1)
        self._work: Iterator[float] | None = wanted.show.steps(scene, wanted.settings, self.picture)
        self.seconds = 0.0
        self._textures: Textures | None = None
        self._before: Textures | None = None  # of an older picture, until the newer's are whole
        self.below: Job | None = None
        self._rows = 0

    @property
    def is_done(self) -> bool:
        """Whether there is nothing left to do."""
        return self._work is None

    def step(self) -> None:
        """Do one step of the work."""
        began = time.perf_counter()
        if next(self._work, None) is None:
            self._work = None  # with all that it holds
        self.seconds += time.perf_counter() - began

    def has_grown(self) -> bool:
        """Return whether more rows are done than when this was last asked."""
        before, self._rows = self._rows, int(self.picture.rows_done.sum())
        return self._rows > before

    def draw(self, shader: Any, width: int, height: int, until: float) -> bool:
        """Draw what is done over a region, in pixels; True if something could not be by a time.

        Of a region of another size it is stretched.
        """
        if not self._textures or self._textures.color is not self.picture.color:
            self._before, self._textures = self._textures, Textures(self.picture)
        is_left = self._textures.upload(until)
        if self._textures.is_whole:
            self.below = self._before = None
        if self.below:
            self.below.draw(shader, width, height, until)
        x, y = self.factor * width / self._size[0], self.factor * height / self._size[1]
        for textures in filter(None, (self._before, self._textures)):
            textures.draw(shader, self._corner[0] * x, self._corner[1] * y, x, y)
        return is_left

    def replace(self, other: Job | None) -> None:
        """Take another's place, which is drawn below until all of this one can be."""
        is_drawn = other and other._textures and other._textures.is_whole
        self.below = other if is_drawn else other and other.below

"""Parts of the open pixels, each with its own rays, and the surfaces near them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Bools, Floats, Index, Places, groups, places
from ...pictures.picture import Picture
from ...scene import Region, Scene
from ...tracer.candidates import Plan
from ...tracer.hits import NOTHING, Hits
from ...tracer.progress import Progress, Work
from ...tracer.shading import interpolated
from ..cause import Cause
from .plans import shared_plan
from .probe import FEW, OpenPixels, Probe


@dataclass(frozen=True, eq=False)
class Part:
    """The n open pixels of a part of the picture, and the probe that asks about them."""

    pixels: OpenPixels
    at: tuple[Places, ...]  # the rows and columns of the n pixels
    scene: Scene  # the scene that is asked, with its camera's own clip range
    picture: Picture  # what the n pixels show
    band: Floats  # (n,) pixels: how far from the centres Blender's samples may lie
    probe: Probe

    @classmethod
    def of(cls, pixels: OpenPixels, at: tuple[Places, ...], probe: Probe) -> Part:
        """Return the part of the pixels in some rows and columns."""
        return cls(pixels, at, pixels.case.scene, pixels.picture.at(at), pixels.bands(at), probe)

    def take(self, wanted: Bools) -> Part:
        """Return the part of some of the n pixels."""
        probe = self.probe.take(np.flatnonzero(wanted))
        return Part.of(self.pixels, tuple(axis[wanted] for axis in self.at), probe)

    @property
    def done(self) -> bool:
        """Whether all n pixels have a cause."""
        return not self.pixels.open[self.at].any()

    def give(self, where: Bools, cause: Cause, figure: ArrayLike, allowed: ArrayLike) -> None:
        """Give a cause to those of the n pixels that have none yet."""
        self.pixels.give(where, cause, figure, allowed, self.at)

    def resolution(self, hits: Hits) -> Floats:
        """Return the depth difference below which surfaces tie, at n hits; 0 for no hit."""
        seen, out = np.flatnonzero(hits.instance != NOTHING), np.zeros(len(hits))
        found, renderer = hits.take(seen), self.picture.sampling.renderer
        rays = self.probe.rays(pixel=seen)
        along = renderer.along(self.scene, found, self.probe.points(hits)[seen], rays)
        out[seen] = renderer.resolution(self.scene.camera, found.t, along)
        return out


def by_parts(pixels: OpenPixels, made: Plan, look: Callable[[Part], Work[None]]) -> Work[None]:
    """Have `look` give causes to the open pixels of a whole picture, a part of it at a time.

    The plan `made` has the scene that is asked, perhaps with another clip range than the case's.
    """
    r = made.scene.camera.region
    asked = pixels.open.copy()
    yield from pixels.band.find(asked)
    height = len(asked)
    for y0, y1 in groups(asked.sum(axis=1), FEW):
        rows = slice(y0, y1)
        tile = Region(r.x0, r.y0 + y0, r.x1, r.y0 + y1)
        if asked[rows].any():
            yield Progress(y0 / height)
            probe = yield from Probe.of(made, tile, asked[rows].ravel())
            y, x = places(asked[rows])
            yield from look(Part.of(pixels, (y + y0, x), probe))


def near_surfaces(
    pixels: OpenPixels, scene: Scene, reach: float, look: Callable[[Part], Work[None]]
) -> Work[None]:
    """Have `look` give causes to open pixels that may show what lies near, in a scene.

    Rays pass at most `reach` pixels from the centres.
    """

    def look_near(part: Part) -> Work[None]:
        near = yield from _near(part.picture, part.probe)
        if near.any():
            yield from look(part if near.all() else part.take(near))

    # The scene may have the case's own clip range, or a wider one.
    made = yield from shared_plan(pixels.case.scene, pixels.picture.sampling.renderer, reach)
    made = replace(made, scene=scene)
    yield from by_parts(pixels, made, look_near)


def _near(picture: Picture, probe: Probe) -> Work[Bools]:
    """Return which of n pixels show a colour and an object that a ray near them may meet.

    No ray of the probe can explain the others.
    """
    scene, count = probe.scene, len(probe.px)
    color, object_ = np.zeros((2, count), bool)
    any_color = interpolated(scene, np.arange(len(scene.instance_objects))).any()
    for pixel, instance, triangle in _surfaces(probe):
        hits = Hits.none(len(pixel))
        hits.instance[:], hits.triangle[:] = instance, triangle
        shown = picture.at(pixel)
        color[pixel[any_color | shown.same_color(scene, hits)]] = True
        object_[pixel[~shown.other_object(hits.instance)]] = True
        yield None
    return color & object_


def _surfaces(probe: Probe) -> Iterator[tuple[Index, Index | int, Index | int]]:
    """Yield pixels (k,), and the instance and triangle that rays near each may meet, or NOTHING."""
    every, first = np.arange(len(probe.px)), len(probe.scene.instances)
    for number in (NOTHING, *range(first, first + len(probe.scene.planes))):
        yield every, number, NOTHING
    for some in probe.chunks:
        yield some.pixel, some.instance, some.triangle

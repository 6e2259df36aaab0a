"""The open pixels, which differ and have no cause yet, and the rays that the checks ask about them.

These rays pass beside their pixel's centre, or go on behind its first hit. With them a check asks
what a pixel would show had Blender's arithmetic moved it a little. It does so for a part of the
picture at a time, in steps of a bounded number of pixels and pairs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Array, Bools, Floats, Index, Places, groups, parts
from ...pictures.bands import SampleBand
from ...pictures.picture import Picture
from ...scene import Region, Scene
from ...tracer.camera import Rays, camera_rays, film_positions
from ...tracer.candidates import PAIRS, Plan, candidates
from ...tracer.frame import Frame
from ...tracer.hits import Hits
from ...tracer.nearest import test_pairs, test_planes
from ...tracer.progress import Work
from ...tracer.shading import positions
from ...tracer.world import Pairs, WorldTriangles
from ..case import Case
from ..cause import AGREE, Cause, Causes
from .plans import SOUND

LAYERS = 4  # surfaces behind one another that are tested
FEW = 1 << 11  # pixels tested together, so that a step is short where whole pictures differ
BLOCK = 1 << 15  # pixels tested in one step, where that needs no rays

Some = tuple[Places, ...] | slice  # rows and columns of pixels, or rows


def blocks(shape: tuple[int, ...]) -> list[slice]:
    """Split a picture (h, w, ...) into whole rows of about BLOCK pixels."""
    return parts(shape[0], max(1, BLOCK // shape[1]))


def other_color(picture: Picture, colors: Array, ramp: Bools | bool = False) -> Work[Bools]:
    """Return where a picture has another colour than the traced ones, (h, w, 4) or one (4,).

    `ramp` (h, w) says where the traced colours are interpolated.
    """
    colors = np.broadcast_to(colors, picture.color.shape)
    ramp = np.broadcast_to(ramp, colors.shape[:2])
    return by_blocks(
        ramp.shape, lambda rows: picture.at(rows).other_color(colors[rows], ramp[rows])
    )


def by_blocks(shape: tuple[int, ...], of: Callable[[slice], Bools]) -> Work[Bools]:
    """Return a function's value of each pixel (h, w); it is called for some rows at a time."""
    out = np.zeros(shape, bool)
    for rows in blocks(shape):
        out[rows] = of(rows)
        yield None
    return out


@dataclass(eq=False)
class OpenPixels:
    """The open pixels: a check gives some of them their cause."""

    case: Case
    frame: Frame  # what was traced
    picture: Picture  # (h, w): the case's, as it is seen once a transform of its colours is found
    out: Causes  # what has been found
    open: Bools  # (h, w)
    band: SampleBand  # how far from its centre Blender's sample may lie, but for the picture's own

    def bands(self, at: Some) -> Floats:
        """Return how far from the centres of some pixels Blender's samples may lie, in pixels.

        `band.find` has found them.
        """
        return self.band.values[at] + self.picture.sampling.off_center

    def give(
        self,
        where: Bools,
        cause: Cause,
        figure: ArrayLike = np.nan,
        allowed: ArrayLike = np.nan,
        at: Some = slice(None),
    ) -> None:
        """Give a cause to pixels without one: those of `where`, (h, w), or (n,) of those `at`."""
        new = where & (self.out.cause[at] == AGREE)
        if not new.any():
            return
        for values, given in (
            (self.out.cause, cause.number),
            (self.out.figure, figure),
            (self.out.allowed, allowed),
            (self.open, False),
        ):
            values[at] = np.where(new, given, values[at])


@dataclass(frozen=True, eq=False)
class Probe:
    """Some pixels of a tile, with every triangle that rays near their centres may hit."""

    scene: Scene
    px: Floats  # (n,) film positions of the centres, in pixels of the whole picture
    py: Floats
    chunks: list[Pairs]  # `pixel` numbers the n pixels

    @classmethod
    def of(cls, made: Plan, tile: Region, wanted: Bools) -> Work[Probe]:
        """Prepare n pixels of a tile, those where `wanted` (row by row from the lowest) is True."""
        chunks = []
        for _, some in candidates(made, tile, wanted):
            if some is not None and len(some.pixel):
                chunks.append(some)
            yield None
        px, py = film_positions(tile, pixel=np.flatnonzero(wanted))
        return cls(made.scene, px, py, _together(chunks))

    def take(self, some: Places) -> Probe:
        """Return the probe of some of the n pixels."""
        number = np.full(len(self.px), -1)
        number[some] = np.arange(len(some))
        kept = (p.take(np.flatnonzero(number[p.pixel] >= 0)) for p in self.chunks)
        chunks = [replace(p, pixel=number[p.pixel]) for p in kept if len(p.pixel)]
        return replace(self, px=self.px[some], py=self.py[some], chunks=_together(chunks))

    def rays(
        self,
        dx: Floats | float = 0.0,
        dy: Floats | float = 0.0,
        pixel: Index | slice = slice(None),
    ) -> Rays:
        """Return rays that pass the centres of some of the n pixels at (dx, dy), in pixels."""
        return camera_rays(self.scene.camera, self.px[pixel] + dx, self.py[pixel] + dy)

    def points(self, hits: Hits) -> Floats:
        """Return where the rays through the n centres end, (n, 3) world space."""
        return positions(self.rays(), hits)

    def trace(
        self, dx: Floats | float = 0.0, dy: Floats | float = 0.0, after: Hits | None = None
    ) -> Work[Hits]:
        """Trace one ray a pixel, a chunk of pairs a step.

        It passes its pixel's centre at (dx, dy), a number or (n,) each, in pixels: at most the
        plan's reach. With `after`, only what lies behind those n hits counts.
        """
        rays = self.rays(dx, dy)
        hits = Hits.none(len(self.px))
        test_planes(self.scene, rays, hits, after)
        for some in self.chunks:
            test_pairs(self.scene, SOUND, rays, some, hits, after)
            yield None
        return hits


def _together(chunks: list[Pairs]) -> list[Pairs]:
    """Concatenate chunks of few pairs that follow each other: one short step in place of many."""
    counts = np.array([len(p.pixel) for p in chunks])
    ends = groups(counts, PAIRS)
    return [_joined(chunks[a:b]) if b > a + 1 else chunks[a] for a, b in ends]


def _joined(chunks: list[Pairs]) -> Pairs:
    """Concatenate pairs, with one triangle each."""
    pixel = np.concatenate([p.pixel for p in chunks])
    triangles = WorldTriangles.joined([p.triangles.take(p.row) for p in chunks])
    return Pairs(pixel, np.arange(len(pixel)), triangles)

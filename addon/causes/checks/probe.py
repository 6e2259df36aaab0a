"""The open pixels, which differ and have no cause yet, and the rays that the checks ask about them.

These rays pass beside their pixel's centre, or go on behind its first hit. With them a check asks
what a pixel would show had Blender's arithmetic moved it a little. It does so for a part of the
picture at a time, in steps of a bounded number of pixels and pairs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Array, Bools, Floats, Index, Places, places
from ...pictures.bands import SampleBand
from ...pictures.picture import Picture
from ...scene import Region, Scene
from ...tracer.camera import Rays, camera_rays, film_positions
from ...tracer.candidates import PAIRS, Plan, candidates
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING, Hits
from ...tracer.nearest import test_pairs, test_planes
from ...tracer.progress import Work, scaled
from ...tracer.settings import Precision, Settings
from ...tracer.shading import interpolated, positions
from ...tracer.vector import groups, parts
from ...tracer.world import Pairs, WorldTriangles
from ..case import Case
from ..cause import AGREE, Cause, Causes
from .plans import SOUND, shared_plan

LAYERS = 4  # surfaces behind one another that are looked at
FEW = 1 << 11  # pixels looked at together, so that a step is short where whole pictures differ
FEW_COLORS = 64  # of a scene: a picture's pixels are held against each of them
BLOCK = 1 << 15  # pixels looked at in one step, where that needs no rays

Some = tuple[Places, ...] | slice  # rows and columns of pixels, or rows


def blocks(shape: tuple[int, ...]) -> list[slice]:
    """Split a picture (h, w, ...) into whole rows of about BLOCK pixels."""
    rows = max(1, BLOCK // shape[1])
    return [slice(y, min(y + rows, shape[0])) for y in range(0, shape[0], rows)]


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
        yield 0.0
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
            if isinstance(at, slice):
                np.copyto(values[at], given, where=new)
            else:
                values[at] = np.where(new, given, values[at])


@dataclass(frozen=True, eq=False)
class Probe:
    """Some pixels of a tile, with every triangle that rays near their centres may hit."""

    scene: Scene
    px: Floats  # (n,) film positions of the centres, in pixels of the whole picture
    py: Floats
    chunks: list[Pairs]  # `pixel` numbers the n pixels
    settings: Settings

    @classmethod
    def of(cls, made: Plan, tile: Region, wanted: Bools, settings: Settings = SOUND) -> Work[Probe]:
        """Prepare n pixels of a tile, those where `wanted` (row by row from the lowest) is True.

        Yields the share of the work done; returns the probe.
        """
        chunks = []
        for share, some in candidates(made, tile, wanted):
            if some is not None and len(some.pixel):
                chunks.append(some)
            yield share
        px, py = film_positions(tile, pixel=np.flatnonzero(wanted))
        return cls(made.scene, px, py, _together(chunks), settings)

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
        dtype = Precision(self.settings.precision).dtype
        return camera_rays(self.scene.camera, self.px[pixel] + dx, self.py[pixel] + dy, dtype)

    def points(self, hits: Hits) -> Floats:
        """Return where the rays through the n centres end, (n, 3) world space."""
        return positions(camera_rays(self.scene.camera, self.px, self.py), hits)

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
            test_pairs(self.scene, self.settings, rays, some, hits, after)
            yield 0.0
        return hits


def _together(chunks: list[Pairs]) -> list[Pairs]:
    """Concatenate chunks of few pairs that follow each other: one short step in place of many."""
    counts = np.array([len(p.pixel) for p in chunks])
    ends = groups(counts, PAIRS)
    return [_joined(chunks[a:b]) if b > a + 1 else chunks[a] for a, b in ends]


def _joined(chunks: list[Pairs]) -> Pairs:
    """Concatenate pairs, with one triangle each."""
    pixel, instance, triangle = (
        np.concatenate([getattr(p, name) for p in chunks])
        for name in ("pixel", "instance", "triangle")
    )
    corners = np.concatenate([p.corners for p in chunks], axis=2)
    return Pairs(pixel, np.arange(len(pixel)), WorldTriangles(corners, instance, triangle))


@dataclass(frozen=True, eq=False)
class Part:
    """The n open pixels of a part of the picture, and the probe that asks about them."""

    pixels: OpenPixels
    at: tuple[Places, ...]  # the rows and columns of the n pixels
    scene: Scene  # the traced scene, with its camera's own clip range
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


def by_parts(
    pixels: OpenPixels,
    made: Plan,
    look: Callable[[Part], Work[None]],
    asked: Bools | bool = True,
) -> Work[None]:
    """Have `look` give causes to the open pixels of a whole picture, a part of it at a time.

    The plan `made` has the traced scene, perhaps with another clip range than the case's.
    Only the pixels `asked` (h, w) are looked at, if given.
    """
    r = made.scene.camera.region
    asked = pixels.open & asked
    yield from scaled(pixels.band.find(asked), 0.0, 0.0)
    height = len(asked)
    for y0, y1 in groups(asked.sum(axis=1), FEW):
        rows = slice(y0, y1)
        tile = Region(r.x0, r.y0 + y0, r.x1, r.y0 + y1)
        if asked[rows].any():
            finding = Probe.of(made, tile, asked[rows].ravel())
            probe = yield from scaled(finding, y0 / height, 0.5 * (y1 - y0) / height)
            y, x = places(asked[rows])
            for _ in look(Part.of(pixels, (y + y0, x), probe)):
                yield 0.5 * (y0 + y1) / height


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
    asked = yield from scaled(may_be_seen(pixels, scene), 0.0, 0.1)
    yield from scaled(by_parts(pixels, made, look_near, asked), 0.1, 0.9)


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
        yield 0.0
    return color & object_


def _surfaces(probe: Probe) -> Iterator[tuple[Index, Index | int, Index | int]]:
    """Yield pixels (k,), and the instance and triangle that rays near each may meet, or NOTHING."""
    every, first = np.arange(len(probe.px)), len(probe.scene.instances)
    for number in (NOTHING, *range(first, first + len(probe.scene.planes))):
        yield every, number, NOTHING
    for some in probe.chunks:
        yield some.pixel, some.instance, some.triangle


def may_be_seen(pixels: OpenPixels, scene: Scene) -> Work[Bools]:
    """Return which open pixels, (h, w), show a colour that something in a scene may have.

    No ray sees what the others show. A scene with many colours, or with a surface that may have
    any colour, is not asked.
    """
    picture = pixels.picture
    colors = np.unique(np.vstack((scene.color_table, np.zeros(4))), axis=0)  # 0: of a hole
    any_color = interpolated(scene, np.arange(len(scene.instance_objects))).any()
    any_color |= picture.lit or picture.data is not None or np.any(picture.colorless)
    if any_color or len(colors) > FEW_COLORS:
        return pixels.open
    out = np.zeros_like(pixels.open)
    row, column = places(pixels.open)
    for part in parts(len(row), BLOCK // len(colors)):
        at = row[part], column[part]
        shape = len(colors), *pixels.picture.color[at].shape
        shown = replace(picture, color=np.broadcast_to(picture.color[at], shape))
        traced = np.broadcast_to(colors[:, None], shape)
        out[at] = ~shown.other_color(traced).all(axis=0)
        yield part.start / len(row)
    return out

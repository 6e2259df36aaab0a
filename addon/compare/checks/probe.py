"""The open pixels, which differ and have no cause yet, and the rays that the checks ask about them.

The picture has no such rays: they pass beside their pixel's centre, or go on behind its first hit.
A check asks with them what a pixel would show had Blender's arithmetic moved it a little. It does
so for a part of the picture at a time, in steps of a bounded number of pixels and pairs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...methods import Method
from ...scene import Region, Scene
from ...tracer.camera import camera_rays
from ...tracer.frame import Frame
from ...tracer.hits import NOTHING
from ...tracer.nearest import Hits, Pairs, Plan, candidates, film_positions, test_pairs, test_planes
from ...tracer.progress import Work, scaled
from ...tracer.settings import Precision, Settings
from ...tracer.shading import interpolated, positions
from ...tracer.vector import groups
from ..bounds import depth_resolution, view_error
from ..case import Case
from ..cause import Cause, Causes
from ..picture import Picture

# A method that loses hits would find at some sample or other whatever Blender shows.
SOUND = Settings(Method.MOLLER_TRUMBORE, Precision.FLOAT64)

LAYERS = 4  # surfaces behind one another that are looked at
FEW = 1 << 11  # pixels looked at together, so that a step is short where whole pictures differ
BLOCK = 1 << 15  # pixels looked at in one step, where that needs no rays


def blocks(shape: tuple[int, ...]) -> list[slice]:
    """Split a picture (h, w, ...) into whole rows of about BLOCK pixels."""
    rows = max(1, BLOCK // shape[1])
    return [slice(y, min(y + rows, shape[0])) for y in range(0, shape[0], rows)]


@dataclass(eq=False)
class OpenPixels:
    """What a check takes: it gives some of the open pixels their cause."""

    case: Case
    frame: Frame  # what was traced
    picture: Picture  # (h, w): the case's, as it is seen once a transform of its colours is found
    out: Causes  # what has been found
    open: NDArray[np.bool_]  # (h, w)
    band: NDArray[np.float64]  # (h, w) pixels: how far from its centre Blender's sample may lie

    def settle(
        self,
        where: NDArray[np.bool_],
        cause: Cause,
        figure: ArrayLike = np.nan,
        allowed: ArrayLike = np.nan,
        at: tuple[NDArray[np.intp], ...] | None = None,
    ) -> None:
        """Give pixels that have none a cause: those of `where`, (h, w), or (n,) of those `at`."""
        where = where & (self.out.cause[... if at is None else at] == Cause.AGREE)
        given = where if at is None else tuple(v[where] for v in at)
        self.out.cause[given], self.open[given] = cause, False
        for values, own in ((self.out.figure, figure), (self.out.allowed, allowed)):
            values[given] = np.broadcast_to(own, where.shape)[where]

    def rows(self, rows: slice) -> OpenPixels:
        """Return those of some rows; their causes are written into the whole."""
        o = self.out
        arrays = {name: getattr(o, name)[rows] for name in ("cause", "figure", "allowed", "blind")}
        out = replace(o, **arrays)
        open_, band = self.open[rows], self.band[rows]
        return replace(self, picture=self.picture.at(rows), out=out, open=open_, band=band)


@dataclass(frozen=True, eq=False)
class Probe:
    """Some pixels of a tile, with every triangle that rays near their centres may meet."""

    plan: Plan
    px: NDArray[np.float64]  # (n,) film positions of the centres, in pixels of the whole picture
    py: NDArray[np.float64]
    chunks: list[Pairs]  # `pixel` numbers the n pixels

    @classmethod
    def of(cls, plan: Plan, tile: Region, wanted: NDArray[np.bool_]) -> Work[Probe]:
        """Prepare n pixels of a tile, those where `wanted` (row by row from the lowest) is True.

        Yields the share of the work done; returns the probe.
        """
        chunks = []
        for share, some in candidates(plan, tile, wanted):
            if some is not None and len(some.pixel):
                chunks.append(some)
            yield share
        return cls(plan, *film_positions(tile, pixel=np.flatnonzero(wanted)), chunks)

    def points(self, hits: Hits) -> NDArray[np.float64]:
        """Return where the rays through the n centres end, (n, 3) world space."""
        return positions(camera_rays(self.plan.scene.camera, self.px, self.py), hits)

    def trace(
        self, dx: ArrayLike = 0.0, dy: ArrayLike = 0.0, after: Hits | None = None
    ) -> Work[Hits]:
        """Trace one ray a pixel, a chunk of pairs a step.

        It passes its pixel's centre at (dx, dy), a number or (n,) each, in pixels: at most the
        plan's reach. Only what lies behind the n hits `after` counts.
        """
        scene, settings = self.plan.scene, self.plan.settings
        rays = camera_rays(scene.camera, self.px + dx, self.py + dy, settings.precision.dtype)
        hits = Hits.none(len(self.px))
        test_planes(scene, rays, hits, after)
        for some in self.chunks:
            test_pairs(scene, settings, rays, some, hits, after)
            yield 0.0
        return hits


@dataclass(eq=False)
class Part:
    """The n open pixels of a part of the picture, and the probe that asks about them."""

    pixels: OpenPixels  # of the part's rows
    wanted: NDArray[np.bool_]  # (rows, w): where the n pixels are
    probe: Probe

    @cached_property
    def scene(self) -> Scene:
        """The scene that is asked, with its camera's own clip range."""
        return self.pixels.case.scene

    @cached_property
    def at(self) -> tuple[NDArray[np.intp], ...]:
        """The rows and columns of the n pixels."""
        return np.nonzero(self.wanted)

    @cached_property
    def picture(self) -> Picture:
        """What the n pixels show."""
        return self.pixels.picture.at(self.at)

    @cached_property
    def band(self) -> NDArray[np.float64]:
        """How far from the n centres Blender's samples may lie, in pixels."""
        return self.pixels.band[self.at]

    @property
    def settled(self) -> bool:
        """Whether no pixel is left."""
        return not self.pixels.open[self.at].any()

    def settle(
        self, where: NDArray[np.bool_], cause: Cause, figure: ArrayLike, allowed: ArrayLike
    ) -> None:
        """Give those of the n pixels a cause that have none yet."""
        self.pixels.settle(where, cause, figure, allowed, self.at)

    def resolution(self, hits: Hits) -> NDArray[np.float64]:
        """Return how near in depth Blender takes two surfaces for one, at n hits; 0 for no hit."""
        seen, out = np.flatnonzero(hits.instance != NOTHING), np.zeros(len(hits))
        found = hits.take(seen)
        view = view_error(self.scene, found, self.probe.points(hits)[seen])
        out[seen] = depth_resolution(self.scene.camera, found.t, view)
        return out


def by_parts(
    pixels: OpenPixels,
    plan: Plan,
    look: Callable[[Part], Work[None]],
    asked: NDArray[np.bool_] | bool = True,
) -> Work[None]:
    """Have `look` settle the open pixels of a whole picture, a part of it at a time.

    The scene of `plan` is what is asked: it may have another clip range than the case's. Only the
    pixels `asked` (h, w) are looked at, if given.
    """
    parts = parts_of(plan.scene, pixels.open & asked, FEW)
    for number, (tile, rows, wanted) in enumerate(parts):
        done, size = number / len(parts), 1 / len(parts)
        probe = yield from scaled(Probe.of(plan, tile, wanted.ravel()), done, 0.5 * size)
        for _ in look(Part(pixels.rows(rows), wanted, probe)):
            yield done + 0.5 * size


def may_be_seen(pixels: OpenPixels, plan: Plan) -> Work[NDArray[np.bool_]]:
    """Return which open pixels, (h, w), show the colour and the object of something near them.

    What the others show no ray sees that passes within the plan's reach, at whatever depth.
    """
    scene, out = plan.scene, pixels.open.copy()
    everywhere = (NOTHING, *range(len(scene.instances), len(scene.instances) + len(scene.planes)))
    parts = parts_of(scene, out, BLOCK)
    for number, (tile, rows, wanted) in enumerate(parts):
        picture, count = pixels.picture.at(rows).at(wanted), int(wanted.sum())
        seen = np.zeros((2, count), bool)
        for instance in everywhere:
            seen |= _shown(picture, scene, np.full(count, instance), np.full(count, NOTHING))
            yield number / len(parts)
        for share, some in candidates(plan, tile, wanted.ravel()):
            yield (number + share) / len(parts)
            if some is not None:
                shown = _shown(picture.at(some.pixel), scene, some.instance, some.triangle)
                for side, same in zip(seen, shown, strict=True):
                    side[some.pixel[same]] = True
        out[rows][wanted] = seen.all(axis=0)
    return out


def _shown(
    picture: Picture, scene: Scene, instance: NDArray[np.integer], triangle: NDArray[np.integer]
) -> NDArray[np.bool_]:
    """Return where n pixels show the colour of a triangle, and its object, (2, n).

    Between corners, a triangle may have any colour.
    """
    count = len(instance)
    hits = Hits.of(np.zeros(count), instance, triangle, np.zeros((3, count)))
    color = picture.same_color(scene, hits) | interpolated(scene, instance)
    return np.stack((color, ~picture.other_object(instance)))


def parts_of(
    scene: Scene, open_: NDArray[np.bool_], most: int
) -> list[tuple[Region, slice, NDArray[np.bool_]]]:
    """Return parts of whole rows with about `most` open pixels, as tiles and rows, and these."""
    r = scene.camera.region
    return [
        (Region(r.x0, r.y0 + y0, r.x1, r.y0 + y1), slice(y0, y1), open_[y0:y1].copy())
        for y0, y1 in groups(open_.sum(axis=1), most)
        if open_[y0:y1].any()
    ]

"""Why a pixel differs: each cause is a check that can fail, with its figure kept for the pixel.

In come two pictures of one scene and what was traced; out goes a cause for every pixel that
differs. A cause is only given where the tracer itself, asked again, sees what Blender shows, or
where the manifest names something in that place that the tracer does not model.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from ..manifest import Unmodelled
from ..scene import Camera, Scene
from ..tracer import shading
from ..tracer.camera import pixel_size, project
from ..tracer.frame import Frame
from ..tracer.probe import Probe
from ..tracer.progress import Work, scaled
from ..tracer.render import tiles
from ..tracer.settings import Settings
from ..tracer.visibility import NOTHING, Hits, plan
from .bounds import SNAPPING, depth_resolution, pixel_error, view_error
from .coverage import coverage

# Blender hands its viewport's colours over as half floats, 11 bits, and cuts off rather than
# rounds: 1 reads 0.9995. Next to an edge a window copies them once more, and up to three units in
# the last place are missing (measured in 4.3). Values are at most 1; four units are allowed.
TOLERANCE = 4 * 2.0**-11

DECIDABLE = 0.5  # pixels: within a larger band, what lies there explains nothing
# Where in the band the tracer is asked again, in widths of it: eight directions on three rings,
# and eight between them on the rim.
_EIGHT = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))
OFFSETS = (
    *((ring * x, ring * y) for ring in (0.3, 0.6, 1.0) for x, y in _EIGHT),
    *((a * x, b * y) for a, b in ((1, 0.5), (0.5, 1)) for x in (1, -1) for y in (1, -1)),
)

LAYERS = 4  # surfaces behind one another that a depth tie is looked for in


class Cause(IntEnum):
    """What is said of a pixel."""

    AGREE = 0
    EDGE = 1  # within Blender's own error of the centre, the tracer sees what Blender shows
    DEPTH_TIE = 2  # what Blender shows lies behind, by less than the depth buffer resolves
    NOT_MODELLED = 3  # something that the tracer does not model is drawn there
    NOT_DECIDABLE = 4  # float32 moves Blender's surfaces by more than half a pixel
    UNEXPLAINED = 5
    NOT_TRACED = 6  # a cancelled picture does not have it


@dataclass(eq=False)
class Causes:
    """`cause` (h, w) uint8, a `Cause` each; `figure` (h, w) float64, NaN where there is none.

    The figure of an edge is how far from the centre (pixels) the tracer sees what Blender shows; of
    a depth tie the gap between the surfaces (metres); of a pixel that is not decidable, how far
    (pixels) Blender's surfaces may be off; of an unmodelled feature its number in the manifest.
    `allowed` (h, w) is the bound that the figure was held against: pixels or metres.
    """

    cause: NDArray[np.uint8]
    figure: NDArray[np.float64]
    allowed: NDArray[np.float64]


def differing(first: NDArray, second: NDArray) -> NDArray[np.bool_]:
    """Return which pixels of two (..., c) pictures differ by more than TOLERANCE in a channel.

    What is not a number differs from everything.
    """
    return ~(np.abs(first.astype(np.float64) - second) <= TOLERANCE).all(axis=-1)


def find_causes(
    scene: Scene,
    settings: Settings,
    frame: Frame,
    picture: NDArray[np.float32],
    unmodelled: Sequence[Unmodelled] = (),
    sample_radius: float = 0.0,
) -> Work[Causes]:
    """Give every pixel of a picture its cause.

    Parameters
    ----------
    scene, settings, frame
        What was traced, how, and what it gave.
    picture : (h, w, 4) float32
        Blender's.
    unmodelled : sequence of Unmodelled
        From the manifest.
    sample_radius : float
        How far from a pixel's centre Blender samples it on purpose, in pixels.

    Yields
    ------
    float
        Share of the work done.
    """
    shape = frame.t.shape
    out = Causes(np.zeros(shape, np.uint8), np.full(shape, np.nan), np.full(shape, np.nan))
    band = sample_band(scene, frame) + sample_radius
    open_ = differing(frame.color, picture)
    settle = _Settler(out, open_)
    settle(~np.broadcast_to(frame.rows_done[:, None], shape), Cause.NOT_TRACED)
    # Not only where the pictures differ: a pixel that agrees by accident proves nothing.
    settle(band > DECIDABLE, Cause.NOT_DECIDABLE, band, DECIDABLE)
    yield from _look_again(scene, settings, frame, picture, band, settle)
    for number, feature in enumerate(unmodelled):
        if feature.bounds is not None:
            inside = open_ & covered(scene.camera, feature.bounds)
            settle(inside, Cause.NOT_MODELLED, np.full(shape, float(number)))
    settle(open_.copy(), Cause.UNEXPLAINED)
    return out


@dataclass(eq=False)
class _Settler:
    """Writes a cause and takes its pixels off the open ones."""

    out: Causes
    open: NDArray[np.bool_]

    def __call__(self, where, cause: Cause, figure=None, allowed=np.nan) -> None:
        where = where & (self.out.cause == Cause.AGREE)
        self.out.cause[where] = cause
        if figure is not None:
            self.out.figure[where] = np.broadcast_to(figure, where.shape)[where]
            self.out.allowed[where] = np.broadcast_to(allowed, where.shape)[where]
        self.open &= ~where

    def rows(self, rows: slice) -> _Settler:
        """Return the same for some rows; it writes into the whole."""
        out = Causes(self.out.cause[rows], self.out.figure[rows], self.out.allowed[rows])
        return _Settler(out, self.open[rows])


def sample_band(scene: Scene, frame: Frame) -> NDArray[np.float64]:
    """Return how far from each pixel's centre Blender's sample may lie, (h, w) pixels.

    It is that of the surfaces in the 3 x 3 pixels around, the largest. Where there is none, Blender
    may still show one that float32 moved there: then it is the largest of the picture.
    """
    seen = frame.instance_index != NOTHING
    band = np.full(frame.t.shape, SNAPPING)
    if not seen.any():
        return band
    view = view_error(scene, frame.position[seen], frame.instance_index[seen])
    band[seen] = pixel_error(scene.camera, frame.t[seen], view)
    around = _largest_around(np.where(seen, band, 0.0))
    return np.where(around > 0, around, band[seen].max())


def _largest_around(values: NDArray[np.float64]) -> NDArray[np.float64]:
    for axis in (0, 1):
        padded = np.pad(values, [(1, 1) if a == axis else (0, 0) for a in (0, 1)])
        size = values.shape[axis]
        values = np.max([padded.take(range(k, k + size), axis) for k in range(3)], axis=0)
    return values


def _look_again(
    scene: Scene,
    settings: Settings,
    frame: Frame,
    picture: NDArray,
    band: NDArray,
    settle: _Settler,
) -> Work[None]:
    """Trace the open pixels again, a tile at a time: around their centres, then in depth."""
    if not settle.open.any():
        return
    made = yield from plan(scene, settings, reach=float(band[settle.open].max()))
    region = scene.camera.region
    all_tiles = tiles(scene.camera)
    for number, tile in enumerate(all_tiles):
        rows = slice(tile.y0 - region.y0, tile.y1 - region.y0)
        wanted = settle.open[rows].copy()
        if not wanted.any():
            continue
        part = settle.rows(rows)
        preparing = Probe.of(made, tile, wanted.ravel())
        probe = yield from scaled(preparing, number / len(all_tiles), 0.5 / len(all_tiles))
        for _ in _edges(scene, probe, wanted, picture[rows], band[rows], part):
            yield (number + 0.5) / len(all_tiles)
        for _ in _depth_ties(scene, probe, wanted, picture[rows], frame, rows, part):
            yield (number + 0.9) / len(all_tiles)


def _edges(scene, probe: Probe, wanted, picture, band, settle: _Settler) -> Iterator[None]:
    """See whether within the band around a pixel's centre there is what Blender shows."""
    width, shown = band[wanted], picture[wanted]
    for x, y in OFFSETS:
        hits = probe.trace(x * width, y * width)
        same = ~differing(shading.colors(scene, hits), shown)
        settle(_set_out(same, wanted), Cause.EDGE, band * max(abs(x), abs(y)), band)
        yield
        if not settle.open.any():
            return
    # What no sample finds: a triangle that comes that near, before any that is surely covered.
    may = coverage(probe, width)
    visible = may.hits.t <= may.sure[may.pixel]
    same = visible & ~differing(shading.colors(scene, may.hits), shown[may.pixel])
    nearest = np.full(len(width), np.inf)
    np.minimum.at(nearest, may.pixel[same], may.distance[same])
    nothing = np.isinf(may.sure) & ~differing(np.broadcast_to(scene.background, shown.shape), shown)
    nearest[nothing] = np.minimum(nearest, width)[nothing]
    settle(_set_out(nearest < np.inf, wanted), Cause.EDGE, _set_out(nearest, wanted), band)


def _depth_ties(scene, probe: Probe, wanted, picture, frame: Frame, rows, settle) -> Iterator[None]:
    """See whether Blender shows what lies behind, nearer than its depth buffer can tell apart."""
    first = Hits(
        *(a[rows][wanted] for a in (frame.t, frame.instance_index, frame.triangle_index)),
        np.zeros((3, int(wanted.sum()))),
    )
    view = np.full(len(first.t), np.inf)
    seen = first.instance != NOTHING
    view[seen] = view_error(scene, frame.position[rows][wanted][seen], first.instance[seen])
    allowed = np.where(seen, depth_resolution(scene.camera, np.where(seen, first.t, 0), view), -1.0)
    hits, shown = first, picture[wanted]
    for _ in range(LAYERS):
        hits = probe.trace(after=hits)
        with np.errstate(invalid="ignore"):  # inf - inf, where nothing is hit
            gap = hits.t - first.t
            same = (gap <= allowed) & ~differing(shading.colors(scene, hits), shown)
        settle(
            _set_out(same, wanted),
            Cause.DEPTH_TIE,
            _set_out(gap, wanted),
            _set_out(allowed, wanted),
        )
        yield
        if not settle.open.any():
            return


def _set_out(values: NDArray, where: NDArray[np.bool_]) -> NDArray:
    out = np.zeros(where.shape, values.dtype)
    out[where] = values
    return out


def covered(camera: Camera, bounds: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    r = camera.region
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8)
    (x, y, depth), _ = project(camera, corners)
    out = np.zeros((r.height, r.width), bool)
    if depth.max() < camera.clip_start or depth.min() > camera.clip_end:
        return out
    if not camera.orthographic:
        if depth.min() <= camera.clip_start:
            return ~out  # around the eye: anywhere
        x, y = x / depth, y / depth
    (width, height), w = pixel_size(camera), camera.window
    px, py = (x - w.left) / width, (y - w.bottom) / height
    x0, x1 = int(max(np.floor(px.min()) - r.x0, 0)), int(np.ceil(min(px.max(), r.x1)) - r.x0)
    y0, y1 = int(max(np.floor(py.min()) - r.y0, 0)), int(np.ceil(min(py.max(), r.y1)) - r.y0)
    out[y0 : max(y1, 0), x0 : max(x1, 0)] = True
    return out

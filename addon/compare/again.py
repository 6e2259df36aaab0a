"""The tracer asked again about pixels that differ: around their centres, and behind their surface.

In come the pixels that are open; those where the tracer sees what Blender shows are settled.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..scene import Region, Scene
from ..tracer import shading
from ..tracer.frame import Frame
from ..tracer.probe import Probe
from ..tracer.progress import Work, scaled
from ..tracer.render import tiles
from ..tracer.settings import Settings
from ..tracer.visibility import NOTHING, Hits, plan
from .bounds import depth_resolution, view_error
from .cause import Cause, Settler, differing
from .coverage import coverage

# Where in the band the tracer is asked again, in widths of it: eight directions on three rings,
# and eight between them on the rim.
_EIGHT = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))
OFFSETS = (
    *((ring * x, ring * y) for ring in (0.3, 0.6, 1.0) for x, y in _EIGHT),
    *((a * x, b * y) for a, b in ((1, 0.5), (0.5, 1)) for x in (1, -1) for y in (1, -1)),
)

LAYERS = 4  # surfaces behind one another that a depth tie is looked for in

FEW = 1 << 13  # pixels looked at together, so that a step is short where whole pictures differ


def look_again(
    scene: Scene,
    settings: Settings,
    frame: Frame,
    picture: NDArray[np.float32],
    band: NDArray[np.float64],
    settle: Settler,
) -> Work[None]:
    """Settle open pixels, a part of the picture at a time.

    Parameters
    ----------
    scene, settings, frame
        What was traced, how, and what it gave.
    picture : (h, w, 4) float32
        Blender's.
    band : (h, w) float64
        How far from its pixel's centre Blender's sample may lie, in pixels.
    settle : Settler
        Of the whole picture.
    """
    if not settle.open.any():
        return
    made = yield from plan(scene, settings, reach=float(band[settle.open].max()))
    parts = list(_parts(scene, settle.open))
    for number, tile in enumerate(parts):
        rows = slice(tile.y0 - scene.camera.region.y0, tile.y1 - scene.camera.region.y0)
        wanted, part = settle.open[rows].copy(), settle.rows(rows)
        done, size = number / len(parts), 1 / len(parts)
        probe = yield from scaled(Probe.of(made, tile, wanted.ravel()), done, 0.5 * size)
        for _ in _edges(scene, probe, wanted, picture[rows], band[rows], part):
            yield done + 0.5 * size
        for _ in _depth_ties(scene, probe, wanted, picture[rows], frame, rows, part):
            yield done + 0.9 * size


def _parts(scene: Scene, open_: NDArray[np.bool_]) -> Iterator[Region]:
    """Yield tiles that have open pixels, cut into lower ones where these are many."""
    region = scene.camera.region
    for tile in tiles(scene.camera):
        many = int(open_[tile.y0 - region.y0 : tile.y1 - region.y0].sum())
        rows = max(1, tile.height * FEW // max(many, FEW))
        for y in range(tile.y0, tile.y1, rows):
            part = Region(tile.x0, y, tile.x1, min(y + rows, tile.y1))
            if open_[part.y0 - region.y0 : part.y1 - region.y0].any():
                yield part


def _edges(scene, probe: Probe, wanted, picture, band, settle: Settler) -> Iterator[None]:
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

"""The tracer asked again about pixels that differ: around their centres, and behind their surface.

In come the pixels that are open; those where the tracer sees what Blender shows are settled.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..scene import Region, Scene
from ..tracer.nearest import NOTHING, Hits, plan
from ..tracer.probe import Probe
from ..tracer.progress import Work, scaled
from ..tracer.render import tiles
from ..tracer.settings import Method, Precision, Settings
from .bounds import depth_resolution, view_error
from .cause import Cause, Settler
from .coverage import coverage
from .shown import Shown

# Where in the band the tracer is asked again, in widths of it: eight directions on three rings,
# and eight between them on the rim.
_EIGHT = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))
OFFSETS = (
    *((ring * x, ring * y) for ring in (0.3, 0.6, 1.0) for x, y in _EIGHT),
    *((a * x, b * y) for a, b in ((1, 0.5), (0.5, 1)) for x in (1, -1) for y in (1, -1)),
)

# A method that loses hits would find at some sample or other whatever Blender shows.
SOUND = Settings(Method.MOLLER_TRUMBORE, Precision.FLOAT64)

LAYERS = 4  # surfaces behind one another that a depth tie is looked for in

FEW = 1 << 13  # pixels looked at together, so that a step is short where whole pictures differ


def look_again(
    scene: Scene, shown: Shown, band: NDArray[np.float64], settle: Settler
) -> Work[None]:
    """Settle open pixels, a part of the picture at a time.

    Parameters
    ----------
    scene : Scene
        What was traced; it is asked by SOUND, however the picture was made.
    shown : Shown
        (h, w): Blender's picture.
    band : (h, w) float64
        How far from its pixel's centre Blender's sample may lie, in pixels.
    settle : Settler
        Of the whole picture.
    """
    if not settle.open.any():
        return
    made = yield from plan(scene, SOUND, reach=float(band[settle.open].max()))
    parts = list(parts_of(scene, settle.open))
    for number, tile in enumerate(parts):
        rows = slice(tile.y0 - scene.camera.region.y0, tile.y1 - scene.camera.region.y0)
        wanted, part = settle.open[rows].copy(), settle.rows(rows)
        done, size = number / len(parts), 1 / len(parts)
        probe = yield from scaled(Probe.of(made, tile, wanted.ravel()), done, 0.5 * size)
        centre, here = probe.trace(), shown.at(rows).at(wanted)
        lost = ~here.differ(scene, centre)  # by the picture's method: the centre itself shows it
        for _ in _edges(scene, probe, wanted, here, band[rows], centre, lost, part):
            yield done + 0.6 * size
        for _ in _depth_ties(scene, probe, wanted, here, centre, lost, part):
            yield done + 0.9 * size
        if part.open.any():
            _coverings(scene, probe, wanted, here, band[rows], lost, part)


def parts_of(scene: Scene, open_: NDArray[np.bool_]) -> Iterator[Region]:
    """Yield tiles that have open pixels, cut into lower ones where these are many."""
    region = scene.camera.region
    for tile in tiles(scene.camera):
        many = int(open_[tile.y0 - region.y0 : tile.y1 - region.y0].sum())
        rows = max(1, tile.height * FEW // max(many, FEW))
        for y in range(tile.y0, tile.y1, rows):
            part = Region(tile.x0, y, tile.x1, min(y + rows, tile.y1))
            if open_[part.y0 - region.y0 : part.y1 - region.y0].any():
                yield part


def _edges(
    scene, probe: Probe, wanted, shown: Shown, band, centre: Hits, lost, settle: Settler
) -> Iterator[None]:
    """See whether within the band around a pixel's centre there is what Blender shows.

    Where it is seen in the centre itself, the picture's method lost it: on an edge within the band,
    where rounding decides, that is no fault; elsewhere (as the literal test does it) it is.
    """
    width = band[wanted]
    for x, y in OFFSETS:
        hits = probe.trace(x * width, y * width)
        other = (hits.triangle != centre.triangle) | (hits.instance != centre.instance)
        same = np.where(lost, other, ~shown.differ(scene, hits))
        settle(set_out(same, wanted), Cause.EDGE, band * max(abs(x), abs(y)), band)
        yield
        if not settle.open.any():
            return


def _coverings(scene, probe: Probe, wanted, shown: Shown, band, lost, settle: Settler) -> None:
    """Find what no sample does: a triangle that comes that near, before any surely covered one."""
    width = band[wanted]
    may = coverage(probe, width)
    behind = may.behind + resolution(scene, probe, may.sure)[may.pixel]
    visible = (may.hits.t <= behind) & ~lost[may.pixel]
    same = visible & ~shown.at(may.pixel).differ(scene, may.hits)
    nearest = np.full(len(width), np.inf)
    np.minimum.at(nearest, may.pixel[same], may.distance[same])
    nothing = np.isinf(may.sure.t) & ~shown.differ(scene, Hits.none(len(width)))
    nothing &= ~lost
    nearest[nothing] = np.minimum(nearest, width)[nothing]
    settle(set_out(nearest < np.inf, wanted), Cause.EDGE, set_out(nearest, wanted), band)


def _depth_ties(
    scene, probe: Probe, wanted, shown: Shown, first: Hits, lost, settle: Settler
) -> Iterator[None]:
    """See whether Blender shows what lies behind, nearer than its depth buffer can tell apart.

    Colours and whose surfaces they are come from two drawings, in which a tie may go either way:
    each must be found among the surfaces that tie.
    """
    allowed = np.where(first.instance != NOTHING, resolution(scene, probe, first), -1.0)
    hits = first
    color, owner = shown.same_color(scene, first) & ~lost, ~shown.other_object(first.instance)
    for _ in range(LAYERS):
        hits = probe.trace(after=hits)
        with np.errstate(invalid="ignore"):  # inf - inf, where nothing is hit
            gap = hits.t - first.t
            tied = gap <= allowed
        color |= tied & shown.same_color(scene, hits)
        owner |= tied & ~shown.other_object(hits.instance)
        settle(
            set_out(tied & color & owner, wanted),
            Cause.DEPTH_TIE,
            set_out(gap, wanted),
            set_out(allowed, wanted),
        )
        yield
        if not settle.open.any():
            return


def resolution(scene: Scene, probe: Probe, hits: Hits) -> NDArray[np.float64]:
    """Return how near in depth Blender takes two surfaces for one, at n hits; 0 for no hit."""
    seen, out = hits.instance != NOTHING, np.zeros(len(hits.t))
    found = hits.take(seen)
    view = view_error(scene, found, probe.points(hits)[seen])
    out[seen] = depth_resolution(scene.camera, found.t, view)
    return out


def set_out(values: NDArray, where: NDArray[np.bool_]) -> NDArray:
    """Return values (n,) where a mask of n pixels is True, and 0 elsewhere."""
    out = np.zeros(where.shape, values.dtype)
    out[where] = values
    return out

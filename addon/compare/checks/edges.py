"""Edges and depth ties: the tracer asked again around the centres, and behind their surface.

Pixels are settled where the tracer sees, as near as Blender's float32 and its rasteriser may be
off, what Blender shows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...scene import Scene
from ...tracer.hits import NOTHING
from ...tracer.nearest import Hits, plan
from ...tracer.progress import Work
from ..cause import Cause
from ..picture import Picture
from .coverage import coverage
from .probe import LAYERS, SOUND, OpenPixels, Part, by_parts

# Where in the band the tracer is asked again, in widths of it: eight directions on three rings,
# and eight between them on the rim.
_EIGHT = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))
OFFSETS = (
    *((ring * x, ring * y) for ring in (0.3, 0.6, 1.0) for x, y in _EIGHT),
    *((a * x, b * y) for a, b in ((1, 0.5), (0.5, 1)) for x in (1, -1) for y in (1, -1)),
)


def check(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels at edges and depth ties, a part of the picture at a time."""
    if pixels.open.any():
        reach = float(pixels.band[pixels.open].max())
        yield from by_parts(pixels, (yield from plan(pixels.case.scene, SOUND, reach)), _look)


def _look(part: Part) -> Work[None]:
    """Ask at samples, then behind, then of the triangles themselves, while pixels are left."""
    centre = yield from part.probe.trace()
    # By the picture's method: the centre itself shows what Blender does.
    lost = ~part.picture.differ(part.scene, centre)
    found = _sides(part.scene, part.picture, centre, 0.0)
    for look in (_beside, _behind, _covering):
        if not part.settled:
            yield from look(part, centre, lost, found)


def _sides(scene: Scene, picture: Picture, hits: Hits, distance: ArrayLike) -> NDArray[np.float64]:
    """Return how far off n hits have the picture's colour, and its owner, (2, n) pixels.

    Infinitely far where they have not. The two come from two drawings, in which an edge or a tie
    may go either way: each is looked for on its own.
    """
    same = picture.same_color(scene, hits), ~picture.other_object(hits.instance)
    return np.where(same, distance, np.inf)


def _beside(part: Part, centre: Hits, lost: NDArray[np.bool_], found: NDArray) -> Work[None]:
    """See whether within the band around a pixel's centre there is what Blender shows.

    Where it is seen in the centre itself, the picture's method lost it: on an edge within the band,
    where rounding decides, that is no fault; elsewhere (as the literal test does it) it is.
    """
    for x, y in OFFSETS:
        hits = yield from part.probe.trace(x * part.band, y * part.band)
        distance = part.band * max(abs(x), abs(y))
        other = (hits.triangle != centre.triangle) | (hits.instance != centre.instance)
        np.minimum(found, _sides(part.scene, part.picture, hits, distance), out=found)
        off = np.where(lost, np.where(other, distance, np.inf), found.max(axis=0))
        part.settle(off < np.inf, Cause.EDGE, off, part.band)
        yield 0.0
        if part.settled:
            return


def _behind(part: Part, first: Hits, lost: NDArray[np.bool_], found: NDArray) -> Work[None]:
    """Settle open pixels that show a surface which ties with the first one.

    `first` are the hits of the n centres; `lost` (n,) is where the picture's own method lost what
    its centre shows.
    """
    scene, picture = part.scene, part.picture
    allowed = np.where(first.instance != NOTHING, part.resolution(first), -1.0)
    hits, (color, owner) = first, found < np.inf
    color &= ~lost
    for _ in range(LAYERS):
        hits = yield from part.probe.trace(after=hits)
        with np.errstate(invalid="ignore"):  # inf - inf, where nothing is hit
            gap = hits.t - first.t
            tied = gap <= allowed
        color |= tied & picture.same_color(scene, hits)
        owner |= tied & ~picture.other_object(hits.instance)
        part.settle(tied & color & owner, Cause.DEPTH_TIE, gap, allowed)
        yield 0.0
        if part.settled:
            return


def _covering(part: Part, _: Hits, lost: NDArray[np.bool_], found: NDArray) -> Work[None]:
    """Find what no sample does: a triangle that comes that near, before any surely covered one."""
    scene, width = part.scene, part.band
    may = yield from coverage(part.probe, width)
    farthest = may.behind + part.resolution(may.sure)[may.pixel]
    visible = may.hits.t <= farthest
    of = _sides(scene, part.picture.at(may.pixel), may.hits, may.distance)
    for side, off in zip(found, of, strict=True):
        np.minimum.at(side, may.pixel[visible], off[visible])
    nothing = _sides(scene, part.picture, Hits.none(len(width)), width)
    np.minimum(found, np.where(np.isinf(may.sure.t), nothing, np.inf), out=found)
    off = found.max(axis=0)
    part.settle((off < np.inf) & ~lost, Cause.EDGE, off, width)

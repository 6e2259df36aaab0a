"""Edges and depth ties: the tracer asked again around the centres, and behind their surface.

Pixels are settled where the tracer sees, as near as Blender's float32 and its rasteriser may be
off, what Blender shows.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...tracer.hits import NOTHING
from ...tracer.nearest import Hits, plan
from ...tracer.progress import Work
from ..cause import Cause
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
    for look in (_beside, _behind, _covering):
        if not part.settled:
            yield from look(part, centre, lost)


def _beside(part: Part, centre: Hits, lost: NDArray[np.bool_]) -> Work[None]:
    """See whether within the band around a pixel's centre there is what Blender shows.

    Where it is seen in the centre itself, the picture's method lost it: on an edge within the band,
    where rounding decides, that is no fault; elsewhere (as the literal test does it) it is.
    """
    for x, y in OFFSETS:
        hits = yield from part.probe.trace(x * part.band, y * part.band)
        other = (hits.triangle != centre.triangle) | (hits.instance != centre.instance)
        same = np.where(lost, other, ~part.picture.differ(part.scene, hits))
        part.settle(same, Cause.EDGE, part.band * max(abs(x), abs(y)), part.band)
        yield 0.0
        if part.settled:
            return


def _behind(part: Part, first: Hits, lost: NDArray[np.bool_]) -> Work[None]:
    """Settle open pixels that show a surface which ties with the first one.

    Colours and whose surfaces they are come from two drawings, in which a tie may go either way:
    each must be found among the surfaces that tie. `first` are the hits of the n centres; `lost`
    (n,) is where the picture's own method lost what its centre shows.
    """
    scene, picture = part.scene, part.picture
    allowed = np.where(first.instance != NOTHING, part.resolution(first), -1.0)
    hits = first
    color, owner = picture.same_color(scene, first) & ~lost, ~picture.other_object(first.instance)
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


def _covering(part: Part, _: Hits, lost: NDArray[np.bool_]) -> Work[None]:
    """Find what no sample does: a triangle that comes that near, before any surely covered one."""
    scene, width = part.scene, part.band
    may = yield from coverage(part.probe, width)
    farthest = may.behind + part.resolution(may.sure)[may.pixel]
    visible = (may.hits.t <= farthest) & ~lost[may.pixel]
    same = visible & ~part.picture.at(may.pixel).differ(scene, may.hits)
    nearest = np.full(len(width), np.inf)
    np.minimum.at(nearest, may.pixel[same], may.distance[same])
    nothing = np.isinf(may.sure.t) & ~part.picture.differ(scene, Hits.none(len(width)))
    nothing &= ~lost
    nearest[nothing] = np.minimum(nearest, width)[nothing]
    part.settle(nearest < np.inf, Cause.EDGE, nearest, width)

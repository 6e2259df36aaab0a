"""Checks edges and depth ties: traces again around the centres, and behind their surface.

A pixel gets its cause if the tracer sees what Blender shows so near to the centre, or so little
behind, that Blender's float32 and its rasteriser may be off by as much.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Bools, Floats, places
from ...pictures.picture import Picture
from ...scene import Scene
from ...tracer.camera import film_of
from ...tracer.hits import NOTHING, Hits
from ...tracer.nearest import within_clip
from ...tracer.progress import Work
from ...tracer.world import world_corners
from ..cause import Cause
from .coverage import coverage
from .parts import Part, near_surfaces
from .probe import LAYERS, OpenPixels

EDGE = Cause(
    1,
    "edge",
    "edge",
    "{figure:.3g} px from the centre the tracer sees what the picture shows "
    "(its renderer's rounding may be off by {allowed:.3g} px)",
    "px",
    (1.0, 0.3, 0.0),
    explains=True,
    rounding=True,
    place="at edges",
    why="Float32 and the rasteriser move corners a little, so a pixel with its centre very "
    "close to an edge may fall on its other side.",
    check="The tracer sees the shown colour, and the shown object, at a distance from the "
    "pixel's centre that the other side's error allows: a rasteriser's snapping of corners, and "
    "the bound of float32 for the surfaces around. Triangles that share an edge leave no gap.",
    never="A pixel farther from an edge; a colour or an object that is not seen within that "
    "distance; what lies behind a closed surface.",
    advice="ignore a few such pixels; if there are many, move the scene to the origin, or render "
    "a larger picture",
)
DEPTH_TIE = Cause(
    2,
    "depth_tie",
    "depth tie",
    "what the picture shows lies {figure:.3g} m behind what the tracer sees "
    "(surfaces {allowed:.3g} m apart are told apart there)",
    "m",
    (0.0, 0.7, 1.0),
    explains=True,
    rounding=True,
    place="at depth ties",
    why="Two surfaces are closer to each other than a depth buffer of 24 bits, or float32, "
    "can tell apart.",
    check="The shown colour and the shown object lie on the same ray, behind what the tracer "
    "sees, within the resolution of depth there: of float32, and of a rasteriser's depth buffer.",
    never="A surface that lies clearly behind.",
    advice="raise the clip start, move the surfaces apart, or remove one of two copies",
)


# Where rays are traced again, in widths of the band: in eight directions on three rings, and in
# eight between them on the rim.
_EIGHT = ((1, 0), (0, 1), (-1, 0), (0, -1), (1, 1), (-1, 1), (-1, -1), (1, -1))
OFFSETS = (
    *((ring * x, ring * y) for ring in (0.3, 0.6, 1.0) for x, y in _EIGHT),
    *((a * x, b * y) for a, b in ((1, 0.5), (0.5, 1)) for x in (1, -1) for y in (1, -1)),
)


def check(pixels: OpenPixels) -> Work[None]:
    """Find open pixels at depth ties and at edges."""
    if pixels.open.any():
        yield from pixels.band.find(pixels.open)
        reach = float(np.max(pixels.bands(places(pixels.open))))
        yield from near_surfaces(pixels, pixels.case.scene, reach, _look)


class _Asked(NamedTuple):
    """The results of the edge and tie tests so far, for the n pixels of a part."""

    centre: Hits
    resolution: Floats  # (n,) m: the resolution of depth there
    lost: Bools  # the picture's own method lost what the centre sees
    found: Floats  # (2, n) px: how far away the picture's colour is seen, and its object
    behind: list[tuple[Hits, Floats]]  # what may tie with the centre, and how far behind, (n,) m
    beside: list[Hits]  # at the samples in the band


def _look(part: Part) -> Work[None]:
    """Look behind the hits, beside the centres, then at triangles, until all have a cause.

    What is shown on the very same ray is a tie, even if an edge is near.
    """
    centre = yield from part.probe.trace()
    lost = ~part.picture.differ(part.scene, centre)
    found = _sides(part.scene, part.picture, centre, 0.0)
    asked = _Asked(centre, part.resolution(centre), lost, found, [], [])
    for look in (_behind, _beside, _mixed, _covering):
        if not part.done:
            yield from look(part, asked)


def _sides(scene: Scene, picture: Picture, hits: Hits, distance: ArrayLike) -> Floats:
    """Return the distance of n hits with the picture's colour, and with its object, (2, n) pixels.

    It is infinite for the others. The two come from two drawings, in which an edge or a tie may go
    either way, so each is looked for by itself.
    """
    same = picture.same_color(scene, hits), ~picture.other_object(hits.instance)
    return np.where(same, distance, np.inf)


def _beside(part: Part, asked: _Asked) -> Work[None]:
    """Look for what Blender shows within the band around a pixel's centre.

    If the centre itself sees it, the picture's method lost it. That is no fault if an edge lies
    within the band, where rounding decides; elsewhere it is one, as of the literal textbook test.
    """
    centre, found = asked.centre, asked.found
    for x, y in OFFSETS:
        hits = yield from part.probe.trace(x * part.band, y * part.band)
        asked.beside.append(hits)
        distance = part.band * max(abs(x), abs(y))
        other = (hits.triangle != centre.triangle) | (hits.instance != centre.instance)
        np.minimum(found, _sides(part.scene, part.picture, hits, distance), out=found)
        off = np.where(asked.lost, np.where(other, distance, np.inf), found.max(axis=0))
        part.give(off < np.inf, EDGE, off, part.band)
        yield None
        if part.done:
            return


def _behind(part: Part, asked: _Asked) -> Work[None]:
    """Look for what Blender shows in surfaces that tie with the first one.

    That may be the centre itself: these rays are float64's, and of surfaces that are nearer than
    its last place they may see another one than the frame, which is certified. Where what the frame
    met is shown as well, its colour is another for another reason, as of a mean of several samples.
    """
    first, frame = asked.centre, part.pixels.frame
    met = first  # where another scene is traced than the frame's
    if part.scene.instances is frame.scene.instances:
        met = frame.hits().take(np.ravel_multi_index(part.at, frame.shape))
    may = (first.instance != NOTHING) & part.picture.differ(part.scene, met)
    allowed = np.where(may, asked.resolution, -1.0)
    with np.errstate(invalid="ignore"):  # inf - inf, where nothing is hit
        moved = np.abs(first.t - met.t)
    part.give(asked.lost & (moved <= allowed), DEPTH_TIE, moved, allowed)
    hits = first
    for _ in range(LAYERS):
        hits = yield from part.probe.trace(after=hits)
        with np.errstate(invalid="ignore"):
            gap = hits.t - first.t
        if not (gap <= allowed).any():
            break
        asked.behind.append((hits, np.where(gap <= allowed, gap, np.inf)))
    yield from _mixed(part, asked)


def _mixed(part: Part, asked: _Asked) -> Work[None]:
    """Give a tie to pixels with the colour or the object behind, and the other where it was found.

    An edge may have decided one of the two drawings, a tie the other.
    """
    scene, picture = part.scene, part.picture
    color, owner = asked.found < np.inf
    color = color & ~asked.lost
    for hits, gap in asked.behind:
        tied = gap < np.inf
        color |= tied & picture.same_color(scene, hits)
        owner = owner | (tied & ~picture.other_object(hits.instance))
        part.give(tied & color & owner, DEPTH_TIE, gap, asked.resolution)
        yield None


def _covering(part: Part, asked: _Asked) -> Work[None]:
    """Look for triangles that no sample hits, but that come near before any surely covered one."""
    scene, width = part.scene, part.band
    found = asked.found
    may = yield from coverage(part.probe, width)
    farthest = may.behind + part.resolution(may.sure)[may.pixel]
    of = _sides(scene, part.picture.at(may.pixel), may.hits, may.distance)
    nothing = _sides(scene, part.picture, Hits.none(len(width)), width)
    nothing[:, np.isfinite(may.sure.t)] = np.inf
    asks = (nothing < np.inf).any(axis=0)
    asks[may.pixel[(of < np.inf).any(axis=0) & (may.hits.t <= farthest)]] = True
    closed = np.full(len(width), np.inf)
    if part.picture.sampling.renderer.closed:
        closed = _closed(scene, asked.beside, asks & ~asked.lost)
    farthest = np.minimum(farthest, (closed + asked.resolution)[may.pixel])
    visible = may.hits.t <= farthest
    for side, off in zip(found, of, strict=True):
        np.minimum.at(side, may.pixel[visible], off[visible])
    np.minimum(found, np.where(np.isinf(closed), nothing, np.inf), out=found)
    off = found.max(axis=0)
    part.give((off < np.inf) & ~asked.lost, EDGE, off, width)


def _closed(scene: Scene, beside: list[Hits], asks: Bools) -> Floats:
    """Return the depth at which n pixels surely see a closed surface of several triangles, (n,).

    It is infinite where there is none. Triangles that share an edge, or a corner all around it,
    leave no gap between them, as a rasteriser rounds what they share alike. But a clipped triangle
    gets corners of its own. Only these pixels are tested.
    """
    instance = np.stack([h.instance for h in beside])
    on_one = (instance == instance[0]).all(axis=0) & (instance[0] < len(scene.instances))
    asked = np.flatnonzero(asks & on_one & (instance[0] != NOTHING))
    names = np.stack([h.triangle[asked] for h in beside])  # (samples, pixels)
    corners = world_corners(scene, instance[:, asked].ravel(), names.ravel())
    depth = film_of(scene.camera, corners.swapaxes(0, 1).reshape(3, -1))[2].reshape(3, *names.shape)
    whole = within_clip(scene.camera, depth).all(axis=(0, 1))
    corners = corners.reshape(3, 3, *names.shape)
    same = (corners[:, None, :, :1] == corners).all(axis=2)  # with those of the first sample
    shared = same.any(axis=1).all(axis=1).sum(axis=0)
    several = 1 + (np.diff(np.sort(names, axis=0), axis=0) > 0).sum(axis=0)
    closed = asked[whole & (shared >= np.maximum(4 - several, 1))]
    out = np.full(len(asks), np.inf)
    out[closed] = np.max([hits.t[closed] for hits in beside], axis=0)
    return out

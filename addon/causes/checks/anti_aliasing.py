"""Anti-aliasing: a colour that is a mix of what the tracer sees within the filter's radius.

A filter with weights that are not negative gives a point of the convex hull of the colours that it
mixes. Its weights are nearly the same on opposite sides of the centre, so that no side has all of
the weight. One colour alone is no mix, and the object that a pixel shows must be one that is seen.

Workbench mixes log2(1 + colour) in place of RGB; before Blender 5.0 log2(1/2 + colour), of alpha,
too. So the hulls of these are tried as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from ...arrays import Array, Bools, Floats, Places, parts
from ...tracer import shading
from ...tracer.hits import NOTHING
from ...tracer.nearest import plan
from ...tracer.progress import Work
from ...tracer.vector import grouped
from .. import hull
from ..cause import Cause
from .coverage import coverage
from .parts import Part, by_parts
from .probe import SOUND, OpenPixels

ANTI_ALIASING = Cause(
    8,
    "anti_aliasing",
    "anti-aliasing",
    "the colour is a mix of what the tracer sees within {figure:.3g} px "
    "(the filter reaches {allowed:.3g} px)",
    "px",
    (0.7, 0.4, 0.2),
    explains=True,
    warns=True,
    place="by anti-aliasing",
    why="The picture was filtered, which mixes the colours at an edge; the tracer shows what "
    "the pixel's centre sees.",
    check="The colour lies in the convex hull of the colours that the tracer sees within the "
    "filter's radius, linear or as Workbench mixes them, each with no less than a tenth of the "
    "weight of the sample opposite. A known object must be seen at the centre, or within its "
    "error. The figure is the radius that suffices.",
    never="An object that is not seen there; another shade of a surface of one colour; a colour "
    "outside the range of those that are mixed.",
    advice="compare like for like, or render one sample in each pixel's centre",
)


# Rings within the radius, and directions on each, where rays are traced. The denser ones are
# for the pixels that are left: a sliver may pass between the first samples.
DENSITIES = ((2, 8), (4, 16), (12, 32))
# Half of the pixels around; the others lie opposite.
_PIXELS = [(x, y) for x in range(-2, 3) for y in range(3) if y or x > 0]
# The least weight of the opposite side. A filter's own is a half, but a pixel has only a few
# samples, which may lie on one side of the centre by chance.
OPPOSITE = 0.1
# A mix is stored in half floats after some twenty roundings, and its samples lie between ours.
NEAR = 2.0**-7


def check(pixels: OpenPixels) -> Work[None]:
    """Find open pixels with a colour that is a mix of the colours within the filter's radius.

    Their figure is the radius of the smallest ring that is enough.
    """
    radius = pixels.picture.sampling.filter_radius
    if not pixels.open.any() or radius <= 0 or pixels.picture.lit:
        return
    made = yield from plan(pixels.case.scene, SOUND, reach=np.sqrt(2) * radius)
    for density in DENSITIES:
        look = partial(_look, radius=radius, density=density)
        yield from by_parts(pixels, made, look)


def _look(part: Part, radius: float, density: tuple[int, int]) -> Work[None]:
    """Sample ring after ring around the pixels; at the end, test the triangles themselves."""
    rings = density[0]
    picture = part.picture
    owner = yield from _owner_seen(part)
    found = np.zeros(len(owner), bool)
    mixed: list[Array] = []
    for ring in range(rings + 1):
        reach = radius * ring / rings
        for x, y in _ring(ring, density, radius):
            hits = yield from part.probe.trace(x, y)
            mixed.append(picture.made_of(shading.colors(part.scene, hits)))
            yield None
        seen = np.stack(mixed)
        rest = np.flatnonzero(~found & owner & (seen != seen[0]).any(axis=(0, 2)))
        seen = seen[:, rest]
        color = picture.color[rest, : seen.shape[-1]]
        found[rest] = yield from is_mix(
            color, seen, picture.storage.sums, np.arange(len(mixed)) ^ 1
        )
        part.give(found, ANTI_ALIASING, reach, radius)
    if density == DENSITIES[-1] and not found.all():
        left = np.flatnonzero(~found & owner)
        found[left] = yield from _through_cracks(part, radius, np.stack(mixed), left)
        part.give(found, ANTI_ALIASING, radius, radius)


def _ring(ring: int, density: tuple[int, int], radius: float) -> Iterator[tuple[float, float]]:
    """Yield the offsets of a ring in opposite pairs; ring 0 is the centre, twice.

    So the sample opposite to number n has the number n ^ 1.
    """
    rings, spokes = density
    reach = radius * ring / rings
    angles = 2 * np.pi * (np.arange(spokes // 2 if ring else 1) + ring / rings) / spokes
    half = [(reach * np.cos(a), reach * np.sin(a)) for a in angles]
    if ring == rings:  # what smooths edges takes in whole pixels
        half += [(x, y) for x, y in _PIXELS if max(abs(x), abs(y)) <= radius]
    for x, y in half:
        yield x, y
        yield -x, -y


def _owner_seen(part: Part) -> Work[Bools]:
    """Return where the tracer sees the shown object, at the centre or within its band."""
    hits = yield from part.probe.trace()
    seen = ~part.picture.other_object(hits.instance)
    if not seen.all():
        may = yield from coverage(part.probe, part.band)
        near = may.hits.t <= may.behind + part.resolution(may.sure)[may.pixel]
        own = ~part.picture.at(may.pixel).other_object(may.hits.instance)
        seen[may.pixel[near & own]] = True
        none = np.full(len(seen), NOTHING)
        seen |= np.isinf(may.sure.t) & ~part.picture.other_object(none)
    return seen


def _through_cracks(part: Part, radius: float, mixed: Array, left: Places) -> Work[Bools]:
    """Return which of the pixels `left` are a mix if float32's cracks let through what is behind.

    Some of the filter's samples may hit a crack of float32's, and show any triangle that comes
    within the radius. At most half of the weight is theirs; the rest sees what the centre does.
    What comes within the band of the centre may be what Blender sees there. If all that is seen is
    one colour, there is no edge.
    """
    picture = part.picture
    found = np.zeros(len(left), bool)
    may = yield from coverage(part.probe, np.full(len(part.band), radius))
    behind = picture.made_of(shading.colors(part.scene, may.hits))
    half = (may.distance > part.band[may.pixel])[:, None] / 2
    behind = (1 - half) * behind + half * mixed[0, may.pixel]
    near = grouped(may.pixel, len(part.band))
    opposite = np.arange(len(mixed)) ^ 1
    for n, pixel in enumerate(left):
        seen = mixed[:, pixel]
        if (seen != seen[0]).any():
            pairs = np.unique(np.hstack((seen, seen[opposite])), axis=0)
            one, other = np.split(pairs, 2, axis=1)
            every = np.concatenate((one, other, np.unique(behind[near[pixel]], axis=0)))
            across = np.arange(len(every))
            across[: 2 * len(pairs)] = np.roll(across[: 2 * len(pairs)], len(pairs))
            color = picture.color[pixel : pixel + 1, : every.shape[1]]
            [found[n]] = yield from is_mix(color, every[:, None], picture.storage.sums, across)
        yield None
    return found


def is_mix(
    color: Array, mixed: Array, sums: int = 0, opposite: Places | None = None
) -> Work[Bools]:
    """Return which colours (n, c) are a mix of those of (k, n, c), or near to one.

    Each of `sums` additions in half floats may lose as much as half a unit of every channel. With
    `opposite` (k,), each colour only comes with a part of the colour of that index.
    """
    count = len(color)
    color = np.nan_to_num(color).astype(np.float64)
    allowed = (NEAR + sums * 2.0**-11) * np.maximum(1, np.abs(color).max(axis=-1, initial=0))
    bright = color.min(axis=-1, initial=0) >= -allowed
    found = np.zeros(count, bool)
    together = max(1, hull.STEP * count // max(mixed.size, 1))
    for part in parts(count, together):
        some = part.start + np.flatnonzero(bright[part])
        older = partial(_logarithm, offset=0.5, channels=4)
        for of, slack in ((lambda v: v, 1), (_logarithm, 2), (older, 4)):
            rest = some[~found[some]]
            points = of(mixed[:, rest].astype(np.float64))
            if opposite is not None:
                points = (1 - OPPOSITE) * points + OPPOSITE * points[opposite]
            found[rest] = yield from hull.in_hull(of(color[rest]), points, slack * allowed[rest])
        yield None
    return found


def _logarithm(color: Array, offset: float = 1.0, channels: int = 3) -> Floats:
    """Return the values that Workbench averages: the logarithm of RGB, and alpha unchanged.

    It makes a colour's error up to 1.44 / offset times as large, and is a half float itself.
    """
    logarithms = np.log2(offset + np.maximum(color[..., :channels], 0))
    return np.concatenate((logarithms, color[..., channels:]), axis=-1)

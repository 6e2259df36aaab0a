"""Anti-aliasing: whether a colour is a mix of what the tracer sees within the filter's radius.

A filter with weights that are not negative gives a point of the convex hull of the colours that it
mixes; `hull.py` looks for it.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import NDArray

from ...tracer import shading
from ...tracer.nearest import plan
from ...tracer.progress import Work, scaled
from ..cause import Cause
from .coverage import coverage
from .hull import is_mix
from .open_pixels import OpenPixels
from .probe import SOUND, Part, by_parts

# Rings within the radius and directions on each, where the tracer is asked; later ones only of
# what is left: a sliver passes between the samples.
DENSITIES = ((2, 8), (4, 16), (12, 32))
_PIXELS = [(x, y) for x in (-2, -1, 0, 1, 2) for y in (-2, -1, 0, 1, 2) if x or y]


def check(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels whose colour is a mix of what is seen within the filter's radius.

    The figure is the radius of the smallest ring that is enough.
    """
    radius = pixels.picture.filter_radius
    if not pixels.open.any() or radius <= 0 or pixels.picture.lit:
        return
    made = yield from plan(pixels.case.scene, SOUND, reach=np.sqrt(2) * radius)
    share = 1 / len(DENSITIES)
    for number, density in enumerate(DENSITIES):
        look = partial(_look, radius=radius, density=density)
        yield from scaled(by_parts(pixels, made, look), number * share, share)


def _look(part: Part, radius: float, density: tuple[int, int]) -> Work[None]:
    """Ask on ring after ring; after the last of the densest, ask the triangles themselves."""
    (rings, spokes), picture = density, part.picture
    mixed = [(yield from _seen(part, 0.0, 0.0))]
    color, found = picture.color[:, : mixed[0].shape[-1]], np.zeros(len(part.band), bool)
    for ring in range(1, rings + 1):
        reach = radius * ring / rings
        angles = 2 * np.pi * (np.arange(spokes) + ring / rings) / spokes
        offsets = [(reach * np.cos(a), reach * np.sin(a)) for a in angles]
        if ring == rings:  # what smooths edges takes in whole pixels
            offsets += [(x, y) for x, y in _PIXELS if max(abs(x), abs(y)) <= radius]
        for offset in offsets:
            mixed.append((yield from _seen(part, *offset)))
            yield 0.0
        rest = np.flatnonzero(~found)
        seen = np.stack([some[rest] for some in mixed])
        found[rest] = yield from is_mix(color[rest], seen, picture.sums)
        part.settle(found, Cause.ANTI_ALIASING, reach, radius)
    if density == DENSITIES[-1] and not found.all():
        left = np.flatnonzero(~found)
        found[left] = yield from _through_cracks(part, radius, np.stack(mixed), left)
        part.settle(found, Cause.ANTI_ALIASING, radius, radius)


def _through_cracks(
    part: Part, radius: float, mixed: NDArray, left: NDArray[np.intp]
) -> Work[NDArray[np.bool_]]:
    """Return which of the pixels `left` are a mix, if what lies behind an edge shines through.

    Each of the filter's samples may meet a crack of float32's, and show any triangle that comes
    within the radius. Where all that is seen is one colour, there is no edge.
    """
    picture, found = part.picture, np.zeros(len(left), bool)
    may = yield from coverage(part.probe, np.full(len(part.band), radius))
    order = np.argsort(may.pixel, kind="stable")
    behind = picture.made_of(shading.colors(part.scene, may.hits))[order]
    ends = np.searchsorted(may.pixel[order], (left, left + 1))
    for n, (pixel, first, last) in enumerate(zip(left, *ends, strict=True)):
        seen = np.unique(mixed[:, pixel], axis=0)
        if len(seen) > 1:
            near = np.unique(np.concatenate((seen, behind[first:last])), axis=0)
            color = picture.color[pixel : pixel + 1, : near.shape[1]]
            found[n] = (yield from is_mix(color, near[:, None], picture.sums))[0]
        yield 0.0
    return found


def _seen(part: Part, dx: float, dy: float) -> Work[NDArray]:
    """Return the colours (n, c) that the picture would have of what lies beside the centres."""
    hits = yield from part.probe.tracing(dx, dy)
    return part.picture.made_of(shading.colors(part.scene, hits))

"""Anti-aliasing: is a colour a mix of what the tracer sees within the filter's radius?

A filter with weights that are not negative gives a point of the convex hull of the colours that it
mixes. Workbench mixes log2(0.5 + colour) in place of the colour, so the hull is looked for among
those, too. The nearest point of a hull is found by Gilbert's algorithm, in the form of Frank and
Wolfe: the farthest colour along the way to the target, the best point between, and again.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..tracer import shading
from ..tracer.probe import Probe
from ..tracer.progress import Work, result_of
from ..tracer.visibility import plan
from .again import SOUND, parts_of, set_out
from .cause import Cause, Settler
from .shown import Shown, transformed

RINGS = (1 / 3, 2 / 3, 1.0)  # of the radius, where the tracer is asked
SPOKES = 16  # directions on each ring
STEPS = 64  # of Gilbert's algorithm: colours of an edge or a corner need a few
# A mix is stored in half floats after some twenty roundings, and its samples lie between ours.
NEAR = 2.0**-7


def look_around(scene: Scene, shown: Shown, radius: float, settle: Settler) -> Work[None]:
    """Settle open pixels whose colour is a mix of what is seen within `radius` pixels.

    The figure is the radius of the smallest ring that is enough. Yields the share that is done.
    """
    if not settle.open.any() or radius <= 0 or shown.lit:
        return
    made = result_of(plan(scene, SOUND, reach=radius))
    region = scene.camera.region
    parts = list(parts_of(scene, settle.open))
    for number, tile in enumerate(parts):
        rows = slice(tile.y0 - region.y0, tile.y1 - region.y0)
        part, wanted = settle.rows(rows), settle.open[rows].copy()
        probe = result_of(Probe.of(made, tile, wanted.ravel()))
        here = shown.at(rows).at(wanted)
        mixed = [_seen(scene, probe, here, 0.0, 0.0)]
        for ring in RINGS:
            for angle in 2 * np.pi * (np.arange(SPOKES) + ring) / SPOKES:
                dx, dy = ring * radius * np.cos(angle), ring * radius * np.sin(angle)
                mixed.append(_seen(scene, probe, here, dx, dy))
            found = set_out(
                is_mix(here.color[:, : 3 if here.opaque else 4], np.stack(mixed)), wanted
            )
            part(found, Cause.ANTI_ALIASING, ring * radius, radius)
            yield number / len(parts)


def _seen(scene: Scene, probe: Probe, shown: Shown, dx: float, dy: float) -> NDArray:
    colors = shading.colors(scene, probe.trace(dx, dy))
    if shown.transform:
        colors = transformed(colors, shown.transform)
    return colors[:, : 3 if shown.opaque else 4]


def is_mix(color: NDArray, mixed: NDArray) -> NDArray[np.bool_]:
    """Return which colours (n, c) lie in the convex hull of those of (k, n, c), or near it."""
    color, mixed = np.nan_to_num(color).astype(np.float64), mixed.astype(np.float64)
    allowed = NEAR * np.maximum(1, np.abs(color).max(axis=-1))
    found = distance_to_hull(color, mixed) <= allowed
    logs = [np.log2(0.5 + np.maximum(v, 0)) for v in (color, mixed)]
    # A colour's own error is up to 1.44 / 0.5 as large in the logarithm.
    return found | (distance_to_hull(*logs) <= 3 * allowed)


def distance_to_hull(target: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray:
    """Return how far targets (n, c) are from the hulls of points (k, n, c), (n,), from above."""
    nearest = np.argmin(((points - target) ** 2).sum(axis=-1), axis=0)
    index = np.arange(len(target))
    at = points[nearest, index]
    for _ in range(STEPS):
        way = target - at
        end = points[np.argmax((points * way).sum(axis=-1), axis=0), index]
        step = end - at
        size = (step**2).sum(axis=-1)
        share = (way * step).sum(axis=-1) / np.where(size > 0, size, 1)
        at = at + np.clip(share, 0, 1)[:, None] * step
    return np.sqrt(((target - at) ** 2).sum(axis=-1))

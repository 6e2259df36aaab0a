"""Where float32 decides on which side of a clip plane a surface lies.

In come the pixels that are open; those are settled where Blender shows what the tracer would see
had it taken, or left out, a surface as near to a clip plane as Blender's arithmetic can tell.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Scene
from ..tracer.nearest import NOTHING, Hits, plan
from ..tracer.probe import Probe
from ..tracer.progress import Work, scaled
from .again import LAYERS, SOUND, parts_of, set_out
from .bounds import depth_resolution, view_error
from .cause import Cause, Settler
from .shown import Shown

# The clip range is widened by so many times what it may be off for a point right before the camera.
WIDENED = 64


def look_beyond(scene: Scene, shown: Shown, settle: Settler) -> Work[None]:
    """Settle open pixels, a part of the picture at a time; yields the share that is done."""
    if not settle.open.any():
        return
    camera = _widened(scene.camera)
    wide = replace(scene, camera=camera)
    made = yield from plan(wide, SOUND, reach=0.0)
    region = scene.camera.region
    parts = list(parts_of(scene, settle.open))
    for number, tile in enumerate(parts):
        rows = slice(tile.y0 - region.y0, tile.y1 - region.y0)
        wanted, done = settle.open[rows].copy(), number / len(parts)
        probe = yield from scaled(Probe.of(made, tile, wanted.ravel()), done, 0.0)
        _clipped(scene, probe, wanted, shown.at(rows).at(wanted), settle.rows(rows))
        yield done


def _clipped(
    scene: Scene, probe: Probe, wanted: NDArray[np.bool_], shown: Shown, settle: Settler
) -> None:
    """Go from the front to the back as far as a surface may be clipped."""
    count = len(probe.px)
    hits, after = Hits.none(count), None
    going, near = np.ones(count, bool), np.zeros(count, bool)
    figure, allowed = np.zeros(count), np.zeros(count)
    for _ in range(LAYERS):
        hits = probe.trace(after=after)
        after = hits
        distance, bound = _to_clip(scene, probe, hits)
        at_clip = (hits.instance != NOTHING) & (distance <= bound)
        inside = (hits.t >= scene.camera.clip_start) & (hits.t <= scene.camera.clip_end)
        # What is surely clipped is passed; what is surely not ends the way.
        seen = going & (inside | at_clip | (hits.instance == NOTHING))
        may = seen & at_clip
        figure, allowed = np.where(may, distance, figure), np.where(may, bound, allowed)
        near |= may
        same = seen & near & ~shown.differ(scene, hits)
        settle(
            set_out(same, wanted),
            Cause.CLIP_PLANE,
            set_out(figure, wanted),
            set_out(allowed, wanted),
        )
        going &= ~seen | at_clip
        if not (going & (hits.instance != NOTHING)).any():
            return


def _to_clip(scene: Scene, probe: Probe, hits: Hits) -> tuple[NDArray, NDArray]:
    """Return how far n hits are from the nearer clip plane and how far Blender may be off, (n,)."""
    camera = scene.camera
    start, end = np.abs(hits.t - camera.clip_start), np.abs(hits.t - camera.clip_end)
    distance = np.minimum(start, end)
    bound = np.zeros(len(hits.t))
    met = np.flatnonzero(hits.instance != NOTHING)
    found = hits.take(met)
    view = view_error(scene, found, probe.points(hits)[met])
    bound[met] = depth_resolution(camera, found.t, view)
    return distance, bound


def _widened(camera: Camera) -> Camera:
    """Return a camera that also sees what Blender may take to be within its clip range."""
    ends = np.array((camera.clip_start, camera.clip_end))
    view = 2.0**-24 * WIDENED * (np.abs(camera.origin).sum() + ends)
    off = depth_resolution(camera, ends, view)
    start = camera.clip_start - off[0]
    if not camera.projection.is_parallel:
        start = max(start, camera.clip_start / 2)
    return replace(camera, clip_start=start, clip_end=camera.clip_end + off[1])

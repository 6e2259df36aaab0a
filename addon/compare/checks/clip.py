"""Where float32 decides on which side of a clip plane a surface lies.

Open pixels are settled where Blender shows what the tracer would see had it taken, or left out, a
surface as near to a clip plane as Blender's arithmetic can tell.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...scene import Camera
from ...tracer.hits import NOTHING
from ...tracer.nearest import Hits, plan
from ...tracer.progress import Work, scaled
from ..bounds import U32, depth_resolution
from ..cause import Cause
from .probe import LAYERS, SOUND, OpenPixels, Part, by_parts, may_be_seen

# The clip range is widened by so many times what it may be off for a point right before the camera.
WIDENED = 64


def check(pixels: OpenPixels) -> Work[None]:
    """Settle open pixels at the clip planes, a part of the picture at a time."""
    if pixels.open.any():
        scene = pixels.case.scene
        wide = replace(scene, camera=_widened(scene.camera))
        made = yield from plan(wide, SOUND, reach=0.0)
        asked = yield from scaled(may_be_seen(pixels, made), 0.0, 0.5)
        yield from scaled(by_parts(pixels, made, _clipped, asked), 0.5, 0.5)


def _clipped(part: Part) -> Work[None]:
    """Go from the front to the back as far as a surface may be clipped."""
    camera, count = part.scene.camera, len(part.probe.px)
    after: Hits | None = None
    going, near = np.ones(count, bool), np.zeros(count, bool)
    figure, allowed = np.zeros(count), np.zeros(count)
    for _ in range(LAYERS):
        after = hits = yield from part.probe.trace(after=after)
        start, end = np.abs(hits.t - camera.clip_start), np.abs(hits.t - camera.clip_end)
        distance, bound = np.minimum(start, end), part.resolution(hits)
        at_clip = (hits.instance != NOTHING) & (distance <= bound)
        inside = (hits.t >= camera.clip_start) & (hits.t <= camera.clip_end)
        # What is surely clipped is passed; what is surely not ends the way.
        seen = going & (inside | at_clip | (hits.instance == NOTHING))
        may = seen & at_clip
        figure, allowed = np.where(may, distance, figure), np.where(may, bound, allowed)
        near |= may
        same = seen & near & ~part.picture.differ(part.scene, hits)
        part.settle(same, Cause.CLIP_PLANE, figure, allowed)
        yield 0.0
        going &= ~seen | at_clip
        if not (going & (hits.instance != NOTHING)).any():
            return


def _widened(camera: Camera) -> Camera:
    """Return a camera that also sees what Blender may take to be within its clip range."""
    ends = np.array((camera.clip_start, camera.clip_end))
    view = U32 * WIDENED * (np.abs(camera.origin).sum() + np.abs(ends))
    off = depth_resolution(camera, ends, view)
    start = camera.clip_start - off[0]
    if not camera.projection.sees_behind:
        start = max(start, camera.clip_start / 2)
    return replace(camera, clip_start=start, clip_end=camera.clip_end + off[1])

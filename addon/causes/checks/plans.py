"""Finds which triangles rays near the pixels of a picture may meet: once for several checks.

A plan holds for rays that pass farther from the centres, and for a wider clip range, than a check
may ask for: it then has triangles that none of its rays meets.
"""

from __future__ import annotations

from dataclasses import replace
from weakref import WeakKeyDictionary

import numpy as np

from ...methods import Method
from ...pictures.bounds import U32
from ...pictures.renderers import Renderer
from ...scene import Camera, Scene
from ...tracer.candidates import Plan
from ...tracer.nearest import plan
from ...tracer.progress import Work
from ...tracer.settings import Precision, Settings

# How the checks trace. A method that loses hits would find whatever Blender shows at some sample.
SOUND = Settings(Method.MOLLER_TRUMBORE, Precision.FLOAT64)

# How much wider the clip range is made than what float32 may move a point right before the camera.
WIDENED = 64

# The last plan alone, as it may be large, and for as long as its scene is there.
_LAST: WeakKeyDictionary[Scene, tuple[Renderer, Plan]] = WeakKeyDictionary()


def shared_plan(scene: Scene, renderer: Renderer, reach: float) -> Work[Plan]:
    """Return a plan of a scene for rays that pass at most `reach` pixels from the centres.

    It holds for the camera's own clip range, and for the :func:`widened` one.
    """
    yield None
    known = _LAST.get(scene)
    if known is None or known[0] is not renderer or known[1].reach < reach:
        wide = replace(scene, camera=widened(scene.camera, renderer))
        made = yield from plan(wide, SOUND, reach)
        _LAST.clear()
        known = _LAST[scene] = renderer, made
    return known[1]


def widened(camera: Camera, renderer: Renderer) -> Camera:
    """Return the camera with its clip range widened by what a renderer's rounding may include."""
    ends = np.array((camera.clip_start, camera.clip_end), np.float64)
    view = U32 * WIDENED * (float(np.abs(camera.origin).sum()) + np.abs(ends))
    before, behind = renderer.resolution(camera, ends, view)
    start = camera.clip_start - before
    if not camera.projection.sees_behind:
        start = max(start, camera.clip_start / 2)
    return replace(camera, clip_start=start, clip_end=camera.clip_end + behind)

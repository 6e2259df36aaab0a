"""Clip planes: float32 decides on which side of them a surface lies.

A pixel gets this cause if Blender shows what the tracer would see with, or without, a surface that
lies nearer to a clip plane than Blender's arithmetic can tell.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...tracer.hits import NOTHING, Hits
from ...tracer.nearest import within_clip
from ...tracer.progress import Work
from ..cause import Cause
from .parts import Part, near_surfaces
from .plans import widened
from .probe import LAYERS, OpenPixels

CLIP_PLANE = Cause(
    7,
    "clip_plane",
    "clip plane",
    "a surface lies {figure:.3g} m from a clip plane, and float32 clips to within {allowed:.3g} m",
    "m",
    (1.0, 1.0, 0.4),
    explains=True,
    rounding=True,
    place="at clip planes",
    why="A surface is so close to a clip plane that float32 decides whether it is drawn.",
    check="What the picture shows is what the tracer sees with that surface, or without it.",
    never="A surface that is clipped at another depth.",
    advice="move the clip plane away from the surface",
)


def check(pixels: OpenPixels) -> Work[None]:
    """Find open pixels at which a surface lies on a clip plane."""
    if pixels.open.any():
        scene = pixels.case.scene
        wide = replace(scene, camera=widened(scene.camera, pixels.picture.sampling.renderer))
        yield from near_surfaces(pixels, wide, 0.0, _clipped)


def _clipped(part: Part) -> Work[None]:
    """Test the surfaces that may be clipped, from front to back."""
    camera = part.scene.camera
    after: Hits | None = None
    near = np.zeros(len(part.probe.px), bool)
    going = ~near
    figure = allowed = np.zeros(len(near))
    for _ in range(LAYERS):
        after = hits = yield from part.probe.trace(after=after)
        with np.errstate(invalid="ignore"):  # inf - inf, where nothing is hit and nothing ends
            ends = np.abs(hits.t - camera.clip_start), np.abs(hits.t - camera.clip_end)
        distance = np.minimum(*ends)
        bound = part.resolution(hits)
        at_clip = (hits.instance != NOTHING) & (distance <= bound)
        inside = within_clip(camera, hits.t)
        # A surface that is surely clipped is passed; one that is surely not ends the way.
        seen = going & (inside | at_clip | (hits.instance == NOTHING))
        may = seen & at_clip
        figure = np.where(may, distance, figure)
        allowed = np.where(may, bound, allowed)
        near |= may
        same = seen & near & ~part.picture.differ(part.scene, hits)
        part.give(same, CLIP_PLANE, figure, allowed)
        yield None
        going &= ~seen | at_clip
        if not (going & (hits.instance != NOTHING)).any():
            return

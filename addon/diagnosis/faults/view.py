"""Faults of the camera's clip range."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from ...arrays import Bools
from ...causes.case import Case
from ...scene import Camera
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import Example, Fault, Numbers, Values, of_camera
from .search import Search

FEW = (0.0, 0.001, 0.01, 0.05)  # shares of unexplained pixels that may have another cause
STEPS = 32  # first steps of a fit in the range of visible depths
BESIDE = 2.0**-40  # of a depth: before what is clipped
LEFT_OUT = "left out: nothing is clipped"
FAR = 1e6  # factor by which a clip distance is moved to clip nothing


def _start(camera: Camera, start: float) -> Camera | None:
    return replace(camera, clip_start=start) if start < camera.clip_end else None


def _end(camera: Camera, end: float) -> Camera | None:
    return replace(camera, clip_end=end) if end > camera.clip_start else None


def _halfway(case: Case, frame: Frame) -> Numbers | None:
    """Pick a clip start halfway between the nearest and the farthest visible surface."""
    nearest, farthest = frame.depths()
    return Numbers(((nearest + farthest) / 2,)) if nearest < farthest else None


def _found(
    changed: Callable[[Camera, float], Camera | None], sign: float, evidence: Evidence
) -> Work[list[Numbers]]:
    """Guess the clip start (sign -1) or end (1) with the most right pixels, and none.

    It is the best depth near those that separate unexplained pixels from the others.
    """
    camera = evidence.case.scene.camera
    own = camera.clip_end if sign > 0 else camera.clip_start
    none = own * FAR**sign if own > 0 else own  # with this depth, nothing is clipped
    out = [Numbers((none,), words=LEFT_OUT)]
    widest = changed(camera, none)
    nearest, farthest = evidence.frame.depths()
    if widest is None or nearest == farthest:
        return out
    # The rays are the same with each clip depth: their candidates are found once.
    probe = yield from evidence.probe(evidence.case.scene.seen_by(widest))

    def right(values: Values) -> Work[Bools | None]:
        other = changed(camera, *values) if values[0] > 0 else None
        if other is None:
            return None
        clipped = replace(probe, scene=probe.scene.seen_by(other))
        hits = yield from clipped.trace()
        return evidence.agrees(clipped.scene, hits)

    starts = []
    for depth in _parting(evidence, sign):
        # If most pixels are wrong with it, so they are with depths near it.
        found = yield from right(depth)
        if found is not None and found.sum() >= evidence.least_right():
            starts.append(depth)
    search = Search(right, np.eye(1) * (farthest - nearest) / STEPS, least=evidence.least_right())
    if starts and (guess := (yield from search.guess(starts))):
        beyond = "nearer" if sign < 0 else "farther"
        words = f"at {guess.values[0]:.4g} m: what is {beyond} is not shown"
        out = [replace(guess, words=words), *out]
    return out


def _parting(evidence: Evidence, sign: float) -> list[Values]:
    """Return depths beyond which (sign 1), or before which (-1), nearly all unexplained pixels lie.

    Some may have another cause. Pixels that agree may lie there, too: what is behind may have the
    same colour.
    """
    t = sign * evidence.frame.t
    wrong = np.sort(t[np.isfinite(t) & evidence.unexplained])
    found = {float(wrong[int(share * len(wrong))]) for share in FEW if len(wrong)}
    return [(abs(nearest) * (1 - sign * BESIDE),) for nearest in sorted(found)]


VIEW_FAULTS = (
    Fault(
        "clip_start",
        "the clip start is {words}",
        "Many ray tracers have no clip start, or one of their own, or the exporter leaves it out.",
        "take the camera's own clip start; it is a depth along the view axis",
        of_camera(_start),
        partial(_found, _start, -1.0),
        ("start",),
        examples=(Example("clip_start", "the clip start halfway into the scene", _halfway),),
        words="at another depth, or left out",
        witness="appleseedhq/blenderseed#119",
    ),
    Fault(
        "clip_end",
        "the clip end is {words}",
        "Many ray tracers have no clip end; a large scene may reach beyond a rasteriser's default.",
        "take the camera's own clip end; it is a depth along the view axis",
        of_camera(_end),
        partial(_found, _end, 1.0),
        ("end",),
        words="at another depth, or left out",
        witness="RenderKit/ospray#118",
    ),
)

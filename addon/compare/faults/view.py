"""Faults of what the camera lets be seen: its clip range, and how it projects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...scene import Camera
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..evidence import Evidence
from .fault import Example, Fault, Guess, of_camera
from .search import rounded

FEW = (0.0, 0.001, 0.01, 0.05)  # shares of unexplained pixels that may have another cause
FAR = 1e6  # how many times farther is looked for what should have been clipped


def _start(camera: Camera, start: float) -> Camera | None:
    return replace(camera, clip_start=start) if start < camera.clip_end else None


def _end(camera: Camera, end: float) -> Camera | None:
    return replace(camera, clip_end=end) if end > camera.clip_start else None


def _halfway(case: Case, frame: Frame) -> Guess | None:
    """Pick a clip start halfway between the nearest and the farthest surface that is seen."""
    t = frame.t[np.isfinite(frame.t)]
    if not len(t) or np.ptp(t) == 0:
        return None
    return Guess((float(np.min(t) + np.max(t)) / 2,))


def _find_start(evidence: Evidence) -> Work[list[Guess]]:
    """Return clip starts that part unexplained surfaces from those behind, and none."""
    camera = evidence.case.scene.camera
    yield 0.0
    least = camera.clip_start / FAR if camera.clip_start > 0 else camera.clip_start
    nearer = Guess((least,), words="nearly 0")
    return [*_parting(evidence, -1.0), nearer]


def _find_end(evidence: Evidence) -> Work[list[Guess]]:
    """Return clip ends that part unexplained surfaces from those before, and none."""
    yield 0.0
    return [*_parting(evidence, 1.0), Guess((evidence.case.scene.camera.clip_end * FAR,))]


def _parting(evidence: Evidence, sign: float) -> list[Guess]:
    """Return depths beyond which (sign 1), or before which (-1), the unexplained pixels lie.

    All of them do, or nearly all: some may have another cause. Pixels that agree may lie there,
    too, as they show what is behind in the same colour.
    """
    t = sign * evidence.frame.t
    seen = np.isfinite(t)
    depth, wrong = np.unique(t[seen & ~evidence.open]), np.sort(t[seen & evidence.open])
    out = []
    for share in FEW if len(wrong) else ():
        nearest = float(wrong[int(share * len(wrong))])
        before = depth[depth < nearest]
        if len(before):
            low, high = sorted((sign * nearest, sign * float(before[-1])))
            out.append(Guess(rounded((low,), (high,)), (low,), (high,)))
    return out


VIEW_FAULTS = (
    Fault(
        "clip_start",
        "the clip start is at {start:.4g} m: what is nearer is not shown",
        "take the camera's own clip start; it is a depth along the view axis",
        of_camera(_start),
        _find_start,
        ("start",),
        examples=(Example("clip_start", "the clip start halfway into the scene", _halfway),),
    ),
    Fault(
        "clip_end",
        "the clip end is at {end:.4g} m: what is farther is not shown",
        "take the camera's own clip end; it is a depth along the view axis",
        of_camera(_end),
        _find_end,
        ("end",),
    ),
)

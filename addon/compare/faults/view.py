"""Faults of what the camera lets be seen: its clip range, and how it projects."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...arrays import Bools, Floats
from ...scene import Camera
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..case import Case
from ..evidence import Evidence
from .fault import Example, Fault, Guess, of_camera
from .search import rounded

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
    """Return the clip start that parts unexplained surfaces from those that agree, and none."""
    camera = evidence.case.scene.camera
    yield 0.0
    least = camera.clip_start / FAR if camera.clip_start > 0 else camera.clip_start
    nearer = Guess((least,), words="nearly 0")
    return [*_parting(evidence, -1.0), nearer]


def _find_end(evidence: Evidence) -> Work[list[Guess]]:
    """Return the clip end that parts unexplained surfaces from those that agree, and none."""
    yield 0.0
    return [*_parting(evidence, 1.0), Guess((evidence.case.scene.camera.clip_end * FAR,))]


def _parting(evidence: Evidence, sign: float) -> list[Guess]:
    """Return the depth beyond which (sign 1), or before which (-1), most pixels are unexplained."""
    t = sign * evidence.frame.t
    seen = np.isfinite(t) & (evidence.open | evidence.judged)
    depth, wrong = t[seen], evidence.open[seen]
    if not wrong.any() or wrong.all():
        return []
    low, high = sorted(sign * v for v in _between(depth, wrong))
    return [Guess(rounded((low,), (high,)), (low,), (high,))]


def _between(depth: Floats, wrong: Bools) -> tuple[float, float]:
    """Return the two depths (n,) between which a threshold has the most wrong pixels beyond it."""
    order = np.argsort(depth)
    gain = np.append(np.cumsum(np.where(wrong[order], 1, -1)[::-1])[::-1], 0)
    k = int(np.argmax(gain))
    own = depth[order]
    above = float(own[min(k, len(own) - 1)])
    return float(own[max(k - 1, 0)]), above


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

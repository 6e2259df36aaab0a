"""Finds advice where rounding excuses too much: the least change after which it no longer does.

Each advice is tried on the pixels themselves, with the bounds that excused them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import product

import numpy as np

from ..arrays import Bools, Floats
from ..pictures.bounds import SNAPPING
from ..pictures.renderers import Renderer
from ..scene import Camera
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from .case import Case
from .cause import NOT_DECIDABLE, Cause, Causes
from .checks.clip import CLIP_PLANE
from .checks.edges import DEPTH_TIE, EDGE

_ROUND = 1.0, 2.0, 5.0  # the first digits of what is advised
_NEAR = 0.01  # of the way to what is seen nearest: where a clip start is best, if that is enough
_ROOM = 0.5  # a clip plane stays this share of the way from what is seen nearest


def advise(
    case: Case, frame: Frame, causes: Causes, where: Mapping[Cause, Bools], most: float
) -> Iterator[str]:
    """Yield what would help, for pixels (h, w) of each cause.

    `most` is the share of the picture that may rest on rounding.
    """
    deep = {cause: found for cause, found in where.items() if cause in (DEPTH_TIE, CLIP_PLANE)}
    allowed = most * causes.cause.size / 2
    if sum(int(found.sum()) for found in deep.values()) > allowed:
        yield from _of_depths(case, frame, causes, deep, allowed)
    if EDGE in where and where[EDGE].sum() > allowed:
        yield _of_edges(causes, where[EDGE], allowed)
    if NOT_DECIDABLE in where:
        yield NOT_DECIDABLE.advice


def _of_depths(
    case: Case, frame: Frame, causes: Causes, where: Mapping[Cause, Bools], allowed: float
) -> Iterator[str]:
    """Yield the clip range that separates the depths; else how far apart surfaces must be."""
    camera, renderer = case.scene.camera, case.picture.sampling.renderer
    none = np.zeros(causes.cause.shape, bool)
    tied, clipped = (where.get(cause, none) for cause in (DEPTH_TIE, CLIP_PLANE))
    gap, off = causes.figure[tied], causes.figure[clipped]
    bound = np.concatenate((causes.allowed[tied], causes.allowed[clipped]))
    at_clip = _clipped_depth(camera, renderer, off, bound[len(gap) :])
    depth = np.concatenate((frame.t[tied], at_clip))
    # What rounding adds to the buffer's step is the same in any clip range.
    rest = np.maximum(bound - renderer.step(camera, depth), 0)
    for other in _cameras(camera, frame):
        told = renderer.step(other, depth) + rest
        ends = np.abs(at_clip - np.array([[other.clip_start], [other.clip_end]]))
        if (np.append(gap, ends.min(axis=0)) <= told).sum() <= allowed:
            yield _clip_range(camera, other, float(np.median(told)))
            return
    if DEPTH_TIE in where:
        apart = _up(2 * float(np.max(bound[: len(gap)])))
        yield (
            f"move surfaces that lie {np.median(gap):.2g} m behind one another at least "
            f"{apart:.2g} m apart, or leave one of them out"
        )


def _clipped_depth(camera: Camera, renderer: Renderer, off: Floats, bound: Floats) -> Floats:
    """Return the depths of surfaces `off` (n,) metres from a clip plane, (n,) metres.

    Of the four places that are, it is the one with the bound nearest to the pixel's.
    """
    start, end = camera.clip_start, camera.clip_end
    places = np.array([start + off, start - off, end - off, end + off])
    apart = np.abs(renderer.step(camera, places) - bound)
    return places[apart.argmin(axis=0), np.arange(len(off))]


def _cameras(camera: Camera, frame: Frame) -> Iterator[Camera]:
    """Yield the camera with other clip ranges that hide nothing visible, the best first."""
    if (frame.instance_index == NOTHING).all():
        return
    nearest, farthest = frame.depths()
    ends = [camera.clip_end, _up(2 * camera.clip_end), _up(20 * camera.clip_end)]
    if 0 < (lower := _up(farthest / _ROOM)) < camera.clip_end:
        ends.insert(1, lower)
    starts = [camera.clip_start]
    if camera.clip_start > 0:
        low, high = np.floor(np.log10(camera.clip_start)), np.log10(max(nearest, 1e-30))
        decades = 10.0 ** np.arange(low, high + 1)
        raised = np.outer(decades, _ROUND).ravel()
        raised = raised[(camera.clip_start < raised) & (raised <= _ROOM * nearest)]
        starts += [*raised[raised <= _NEAR * nearest][-1:], *raised]
        starts += [float(f"{camera.clip_start * share:.1g}") for share in (0.5, 0.1)]
    for end, start in product(ends, starts):
        if (start, end) != (camera.clip_start, camera.clip_end):
            yield replace(camera, clip_start=start, clip_end=end)


def _clip_range(camera: Camera, other: Camera, told: float) -> str:
    """Return the advice to change one or both clip planes."""
    changes = []
    for name in ("start", "end"):
        before, after = (getattr(c, f"clip_{name}") for c in (camera, other))
        if before != after:
            verb = "raise" if after > before else "lower"
            changes.append(f"{verb} the clip {name} from {before:.6g} m to {after:.6g} m")
    return f"{' and '.join(changes)}: surfaces {told:.2g} m apart are then told apart"


def _of_edges(causes: Causes, where: Bools, allowed: float) -> str:
    """Return the advice for edges: move the scene to the origin, or draw it larger."""
    band = float(np.median(causes.allowed[where]))
    if band > 2 * SNAPPING:
        return (
            f"move the scene to the origin: float32 moves its edges by up to {band:.2g} px where "
            "it is"
        )
    times = int(np.ceil(where.sum() / allowed))
    return (
        f"draw the picture {times} times as wide and high: then fewer of its pixels lie near edges"
    )


def _up(value: float) -> float:
    """Return the next larger number with one digit of `_ROUND`; 0 for none."""
    if value <= 0:
        return 0.0
    decade = 10.0 ** np.floor(np.log10(value))
    return float(next(d * decade for d in (*_ROUND, 10.0) if d * decade >= value))

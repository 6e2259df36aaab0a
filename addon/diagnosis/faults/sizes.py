"""The fault of another size: a picture that was rendered small, or shrunk, and enlarged.

What is traced goes through the same, and is held against the picture; of the ways to do so, those
are tried that are right in most of the sampled pixels.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product

import numpy as np

from ...arrays import Array, Colors
from ...causes.case import Case
from ...causes.checks.probe import SOUND
from ...rendering import steps
from ...scene import Region, ViewWindow
from ...tracer.camera import pixel_size
from ...tracer.frame import Frame
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import AnyFault, Effort, Fault, Guess, Values

SHARES = {2: "half", 3: "a third of", 4: "a quarter of"}  # of the size, by the factor
RIGHT = 0.8  # of the sampled pixels that are unexplained, for a guess to be tried


class Way(StrEnum):
    """How a picture is resampled, in words."""

    NEAREST = "by the nearest pixel"
    LINEAR = "linearly"
    MEAN = "by the mean of pixels"


def sampled_right(evidence: Evidence, colors: Array) -> bool:
    """Return whether most sampled pixels, and most unexplained ones, show colours (n, 4)."""
    right = ~evidence.shown.other_color(colors)
    return bool(right[evidence.unexplained_sampled].mean() > RIGHT and right.mean() > RIGHT)


def at_size(case: Case, size: float) -> Case:
    """Return the case with its region, which may be a border's, traced at another size."""
    camera = case.scene.camera
    r, w = camera.region, camera.window
    across, up = pixel_size(camera)
    window = ViewWindow(
        w.left + r.x0 * across, w.left + r.x1 * across, w.bottom + r.y0 * up, w.bottom + r.y1 * up
    )
    width, height = (max(1, round(size * n)) for n in (r.width, r.height))
    whole = Region(0, 0, width, height)
    camera = replace(camera, window=window, width=width, height=height, region=whole)
    return case.with_scenes(lambda scene: scene.seen_by(camera))


@dataclass(frozen=True, eq=False)
class Small(Guess):
    """A picture smaller by a factor of n, enlarged again."""

    n: int
    down: Way | None  # how it was shrunk; None if it was rendered so small
    up: Way
    corner: tuple[int, int] = (0, 0)  # which pixel of each n x n is taken if one is: row, column

    @property
    def values(self) -> Values:
        """The factor."""
        return (float(self.n),)


def _rendered(case: Case, guess: Small) -> Case:
    return at_size(case, 1 / guess.n) if guess.down is None else case


def _shrunk(colors: Array, guess: Small) -> Array:
    """Shrink a picture (h, w, 4) by n, from its top row: one pixel of each n x n, or the mean."""
    n = guess.n
    out = np.asarray(colors, np.float64)[::-1]
    if guess.down is Way.NEAREST:
        rows, columns = (
            np.minimum(np.arange(0, size, n) + at, size - 1)
            for size, at in zip(out.shape[:2], guess.corner, strict=True)
        )
        return out[rows][:, columns][::-1]
    for axis in (0, 1):
        starts = np.arange(0, out.shape[axis], n)
        count = np.diff(np.append(starts, out.shape[axis]))
        shares = [-1 if k == axis else 1 for k in range(out.ndim)]
        out = np.add.reduceat(out, starts, axis=axis) / count.reshape(shares)
    return out[::-1]


def _enlarged(colors: Colors, guess: Small, evidence: Evidence) -> Colors:
    """Enlarge a picture to the evidence's size; shrink it before, unless it was rendered small."""
    small = colors if guess.down is None else _shrunk(colors, guess)
    height, width = evidence.unexplained.shape
    if guess.up is Way.LINEAR:
        return resized(small, (height, width))
    rows, columns = (  # counted from above: a last block may be smaller
        np.minimum(((np.arange(size) + 0.5) / step).astype(int), have - 1)
        for size, have in zip((height, width), small.shape[:2], strict=True)
        for step in [guess.n if guess.down else size / have]
    )
    return small[::-1][rows][:, columns][::-1].astype(np.float32)


def resized(colors: Array, shape: tuple[int, ...]) -> Colors:
    """Resample a picture (h', w', 4) linearly to another size (h, w)."""
    out: Array = np.asarray(colors, np.float64)
    for axis, size in enumerate(shape):
        have = out.shape[axis]
        place = (np.arange(size) + 0.5) * have / size - 0.5
        low = np.clip(np.floor(place), 0, have - 1).astype(int)
        share = np.clip(place - low, 0, 1).reshape([-1 if n == axis else 1 for n in range(3)])
        first, second = (out.take(at, axis=axis) for at in (low, np.minimum(low + 1, have - 1)))
        out = first * (1 - share) + second * share
    return out.astype(np.float32)


def _find(evidence: Evidence) -> Work[list[Small]]:
    """Guess by what factor the picture is smaller, and how, by the sampled pixels."""
    out = []
    for n, name in SHARES.items():
        small = Frame.empty(at_size(evidence.case, 1 / n).scene)
        yield from steps(small.scene, SOUND, small)
        places = sorted({0, n // 2, n - 1})
        downs: list[tuple[Way | None, tuple[int, int]]] = [(None, (0, 0)), (Way.MEAN, (0, 0))]
        downs += [(Way.NEAREST, corner) for corner in product(places, places)]
        for (down, corner), up in product(downs, (Way.NEAREST, Way.LINEAR)):
            made = f"shrunk to {name} its size {down}" if down else f"rendered at {name} its size"
            guess = Small(n, down, up, corner, words=f"{made}, and enlarged {up}")
            colors = evidence.frame.color if down else small.color
            if sampled_right(evidence, _enlarged(colors, guess, evidence)[evidence.sample]):
                out.append(guess)
    return out


SIZE_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "resampled",
        "the picture was {words}",
        "A preview, a thumbnail or a screenshot was rendered or stored small, and enlarged.",
        "compare the picture as it was rendered, at the size at which it was",
        _rendered,
        _find,
        ("n",),
        everywhere=True,
        sampled=False,
        after=_enlarged,
        effort=Effort.PIXELS,
        words="rendered at, or shrunk to, a part of its size, and enlarged",
        witness="mozilla-services/screenshots#1006",
    ),
)

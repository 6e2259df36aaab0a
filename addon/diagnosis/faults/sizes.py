"""Faults of another size: a picture that was rendered smaller or larger, or shrunk and enlarged.

What is traced goes through the same, and is held against the picture; of the ways to do so, those
are tried that are right in most of the sampled pixels.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product

import numpy as np

from ...arrays import Array, Colors, Floats, Places
from ...causes.case import Case
from ...scene import Region, ViewWindow
from ...tracer import shading
from ...tracer.camera import pixel_size
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import AnyFault, Effort, Fault, Guess, Values, unchanged

# Of what may have been resampled, and how they are called. Larger ones are means of several
# samples, or, by the nearest pixel, offsets of the camera.
SIZES = {
    1 / 2: "half",
    0.9: "nine tenths of",
    0.8: "four fifths of",
    1 / 3: "a third of",
    1 / 4: "a quarter of",
    2 / 3: "two thirds of",
    3 / 4: "three quarters of",
}
SHARES = {2: "half", 3: "a third of", 4: "a quarter of"}  # to which a picture may be shrunk
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


# ---- rendered at another size


@dataclass(frozen=True, eq=False)
class Resampled(Guess):
    """A picture rendered at another size, relative to the one compared."""

    size: float
    way: Way

    @property
    def values(self) -> Values:
        """The size."""
        return (self.size,)


Mix = list[tuple[Places, Floats]]  # for each of n places, which pixels are taken, and their weights


def _mix(have: int, size: int, way: Way) -> Mix:
    """Return the weights with which a row of `have` pixels is resampled to `size` pixels."""
    place = (np.arange(size) + 0.5) * have / size - 0.5
    if way is Way.NEAREST:
        return [(np.clip(np.floor(place + 0.5), 0, have - 1).astype(int), np.ones(size))]
    low = np.clip(np.floor(place), 0, have - 1).astype(int)
    share = np.clip(place - low, 0, 1)
    return [(low, 1 - share), (np.minimum(low + 1, have - 1), share)]


def _resampled(colors: Colors, guess: Resampled, evidence: Evidence) -> Colors:
    """Resample a picture (h', w', 4) to the size of the evidence's."""
    return resized(colors, evidence.unexplained.shape, guess.way)


def resized(colors: Array, shape: tuple[int, ...], way: Way) -> Colors:
    """Resample a picture (h', w', 4) to another size (h, w)."""
    out: Array = np.asarray(colors, np.float64)
    for axis, size in enumerate(shape):
        shares = [-1 if n == axis else 1 for n in range(out.ndim)]
        parts = _mix(out.shape[axis], size, way)
        out = np.sum([out.take(at, axis=axis) * weight.reshape(shares) for at, weight in parts], 0)
    return out.astype(np.float32)


def _find_size(evidence: Evidence) -> Work[list[Resampled]]:
    """Guess the sizes and ways that are right in most sampled pixels, by tracing these.

    A pixel of the other size is a ray beside the centre of one of the sampled pixels.
    """
    scene, region = evidence.case.scene, evidence.case.scene.camera.region
    rows, columns = evidence.sample
    probe = yield from evidence.probe(scene, reach=np.sqrt(2) / min(SIZES))
    out = []
    for (size, name), way in product(SIZES.items(), (Way.NEAREST, Way.LINEAR)):
        wide, high = (max(1, round(size * n)) for n in (region.width, region.height))
        total = np.zeros((len(rows), 4))
        for (y, up), (x, across) in product(
            _mix(high, region.height, way), _mix(wide, region.width, way)
        ):
            dx = (x[columns] + 0.5) * region.width / wide - columns - 0.5
            dy = (y[rows] + 0.5) * region.height / high - rows - 0.5
            hits = yield from probe.trace(dx, dy)
            weight = (up[rows] * across[columns])[:, None]
            total += weight * shading.colors(scene, hits)
        if sampled_right(evidence, total):
            out.append(Resampled(size, way, words=f"{name} its size, and resampled {way}"))
    return out


# ---- shrunk, and enlarged again


@dataclass(frozen=True, eq=False)
class Shrunk(Guess):
    """A picture shrunk by a factor of n, and enlarged again."""

    n: int
    down: Way
    up: Way
    corner: tuple[int, int]  # which pixel of each n x n is taken if one is: row, column

    @property
    def values(self) -> Values:
        """The factor."""
        return (float(self.n),)


def _shrunk(colors: Array, guess: Shrunk) -> Array:
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


def _enlarged(colors: Colors, guess: Shrunk, evidence: Evidence) -> Colors:
    """Shrink a picture (h, w, 4) and enlarge it again."""
    small, n = _shrunk(colors, guess), guess.n
    height, width = colors.shape[:2]
    if guess.up is Way.NEAREST:  # counted from above: a last block may be smaller
        rows = small.shape[0] - 1 - np.arange(height)[::-1] // n
        return small[rows][:, np.arange(width) // n].astype(np.float32)
    return resized(small, (height, width), Way.LINEAR)


def _find_shrunk(evidence: Evidence) -> Work[list[Shrunk]]:
    """Guess by what factor the picture was shrunk, and how, by the sampled pixels."""
    at, out = evidence.sample, []
    for n, name in SHARES.items():
        places = sorted({0, n // 2, n - 1})
        downs = [*((Way.NEAREST, corner) for corner in product(places, places)), (Way.MEAN, (0, 0))]
        for (down, corner), up in product(downs, (Way.NEAREST, Way.LINEAR)):
            words = f"{name} its size {down}, and enlarged again {up}"
            guess = Shrunk(n, down, up, corner, words=words)
            if sampled_right(evidence, _enlarged(evidence.frame.color, guess, evidence)[at]):
                out.append(guess)
            yield 0.0
    return out


SIZE_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "resampled",
        "the picture was rendered at {words}",
        "A screenshot, or the scaling of a screen or a program, changes the size after rendering.",
        "render it at the size at which it is compared",
        lambda case, guess: at_size(case, guess.size),
        _find_size,
        ("size",),
        everywhere=True,
        sampled=False,
        after=_resampled,
        effort=Effort.PIXELS,
        words="another size, and resampled",
        witness="ctrl-freaks/freezeframe.js#158",
    ),
    Fault(
        "shrunk",
        "the picture was shrunk to {words}",
        "A preview or a thumbnail was rendered or stored small, and enlarged to be compared.",
        "compare the picture as it was rendered",
        unchanged,
        _find_shrunk,
        ("n",),
        everywhere=True,
        sampled=False,
        after=_enlarged,
        effort=Effort.PIXELS,
        words="a part of its size, and enlarged again",
        witness="OneZoom/OZtree#891",
    ),
)

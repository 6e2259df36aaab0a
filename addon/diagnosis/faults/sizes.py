"""Faults of another size: a picture that was rendered smaller or larger, or shrunk and enlarged.

What is traced goes through the same, and is held against the picture; of the ways to do so, those
are tried that are right in most of the sampled pixels.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial
from itertools import product
from typing import NamedTuple

import numpy as np

from ...arrays import Array, Colors, Floats, Places
from ...causes.case import Case
from ...images import decoded, encoded
from ...scene import Region, ViewWindow
from ...tracer import shading
from ...tracer.camera import pixel_size
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import AnyFault, Effort, Fault, Guess, Values
from .recolor import with_slack

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
    MEAN = "by the mean of pixels"
    LINEAR = "linearly"
    CUBIC = "bicubically"
    SHARP = "bicubically, sharply"
    LANCZOS = "by Lanczos' filter"


def _cubic(a: float, x: Floats) -> Floats:
    """Return Keys' cubic kernel (1981): a is -0.5 in Pillow, -0.75 in OpenCV."""
    x = np.abs(x)
    near = ((a + 2) * x - (a + 3)) * x * x + 1
    return np.where(x < 1, near, np.where(x < 2, a * (((x - 5) * x + 8) * x - 4), 0))


# How many pixels each reaches, and its weight of one that is x pixels away.
_KERNELS: dict[Way, tuple[int, Callable[[Floats], Floats]]] = {
    Way.LINEAR: (1, lambda x: np.maximum(1 - np.abs(x), 0)),
    Way.CUBIC: (2, partial(_cubic, -0.5)),
    Way.SHARP: (2, partial(_cubic, -0.75)),
    Way.LANCZOS: (3, lambda x: np.where(np.abs(x) < 3, np.sinc(x) * np.sinc(x / 3), 0)),
}


class Coding(NamedTuple):
    """The values in which colours (..., 4) are mixed."""

    into: Callable[[Array], Array]  # from linear, premultiplied ones
    back: Callable[[Array], Array]
    words: str


# As a renderer mixes them; and as programs do that have a file's values.
CODINGS = (
    Coding(np.asarray, np.asarray, ""),
    Coding(encoded, lambda c: decoded(np.clip(c, 0, 1)), ", in sRGB values"),
)


def as_stored(case: Case, guess: Guess) -> Case:
    """Return the case with a level more for what was rounded before it was mixed, in a file."""
    levels = case.picture.storage.levels
    return replace(case, picture=with_slack(case.picture, 1.0)) if levels else case


def sampled_right(evidence: Evidence, colors: Array) -> bool:
    """Return whether most sampled pixels, and most unexplained ones, show colours (n, 4)."""
    shown = evidence.shown
    if shown.storage.levels:
        shown = with_slack(shown, 1.0)
    right = ~shown.other_color(colors)
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
    coding: Coding

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
    reach, kernel = _KERNELS[way]
    pixels = np.floor(place).astype(int) - reach + 1 + np.arange(2 * reach)[:, None]
    weights = np.where((pixels >= 0) & (pixels < have), kernel(place - pixels), 0)
    return [*zip(pixels.clip(0, have - 1), weights / weights.sum(axis=0), strict=True)]


def _resampled(colors: Colors, guess: Resampled, evidence: Evidence) -> Colors:
    """Resample a picture (h', w', 4) to the size of the evidence's."""
    mixed = resized(guess.coding.into(colors), evidence.unexplained.shape, guess.way)
    return guess.coding.back(mixed).astype(np.float32)


At = tuple[Places, Places]  # rows and columns


def _everywhere(shape: tuple[int, ...]) -> At:
    rows, columns = np.ogrid[: shape[0], : shape[1]]
    return rows, columns


def resized(colors: Array, shape: tuple[int, ...], way: Way, at: At | None = None) -> Array:
    """Resample a picture (h', w', 4) to another size (h, w); return all pixels, or some."""
    rows, columns = at or _everywhere(shape)
    ups, acrosses = (_mix(*sizes, way) for sizes in zip(colors.shape[:2], shape[:2], strict=True))
    parts = (
        (up[rows] * across[columns])[..., None] * colors[y[rows], x[columns]]
        for (y, up), (x, across) in product(ups, acrosses)
    )
    return np.asarray(sum(parts))


def _find_size(evidence: Evidence) -> Work[list[Resampled]]:
    """Guess the sizes and ways that are right in most sampled pixels, by tracing these.

    A pixel of the other size is a ray beside the centre of one of the sampled pixels.
    """
    evidence = evidence.few
    scene, region = evidence.case.scene, evidence.case.scene.camera.region
    rows, columns = evidence.sample
    reach = _KERNELS[Way.CUBIC][0] * np.sqrt(2) / min(SIZES)
    probe = yield from evidence.probe(scene, reach)
    out = []
    for size, name in SIZES.items():
        wide, high = (max(1, round(size * n)) for n in (region.width, region.height))
        traced: dict[tuple[bytes, bytes], Colors] = {}  # by where, as ways share their pixels
        for way in (Way.NEAREST, Way.LINEAR, Way.CUBIC, Way.SHARP):
            totals = [np.zeros((len(rows), 4)) for _ in CODINGS]
            for (y, up), (x, across) in product(
                _mix(high, region.height, way), _mix(wide, region.width, way)
            ):
                at = y[rows].tobytes(), x[columns].tobytes()
                if at not in traced:
                    dx = (x[columns] + 0.5) * region.width / wide - columns - 0.5
                    dy = (y[rows] + 0.5) * region.height / high - rows - 0.5
                    traced[at] = shading.colors(scene, (yield from probe.trace(dx, dy)))
                for total, coding in zip(totals, CODINGS, strict=True):
                    total += (up[rows] * across[columns])[:, None] * coding.into(traced[at])
            for total, coding in zip(totals, CODINGS, strict=True):
                if sampled_right(evidence, coding.back(total)):
                    words = f"{name} its size, and resampled {way}{coding.words}"
                    out.append(Resampled(size, way, coding, words=words))
    return out


# ---- shrunk, and enlarged again


@dataclass(frozen=True, eq=False)
class Shrunk(Guess):
    """A picture shrunk by a factor of n, and enlarged again."""

    n: int
    down: Way
    up: Way
    corner: tuple[int, int]  # which pixel of each n x n is taken if one is: row, column
    coding: Coding
    hues: bool = False  # whether these alone were, and not the brightness

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


def _grown(small: Array, guess: Shrunk, shape: tuple[int, ...], at: At) -> Array:
    """Return some pixels of a picture that is enlarged again."""
    rows, columns = at
    if guess.up is Way.NEAREST:  # counted from above: a last block may be smaller
        return small[(rows - shape[0]) // guess.n + len(small), columns // guess.n]
    return resized(small, shape, guess.up, at)


def _enlarged(colors: Colors, guess: Shrunk, evidence: Evidence) -> Colors:
    """Shrink a picture (h, w, 4) and enlarge it again."""
    coded = guess.coding.into(colors)
    at = _everywhere(colors.shape)
    return _recoded(coded, _grown(_shrunk(coded, guess), guess, colors.shape, at), guess)


def _recoded(coded: Array, large: Array, guess: Shrunk) -> Colors:
    """Return linear colours; with their own brightness (Rec. 601) if the hues alone were shrunk."""
    if guess.hues:
        large[..., :3] += ((coded - large)[..., :3] @ (0.299, 0.587, 0.114))[..., None]
    return guess.coding.back(large).astype(np.float32)


def _find_shrunk(evidence: Evidence) -> Work[list[Shrunk]]:
    """Guess by what factor the picture was shrunk, and how, by the sampled pixels."""
    at, out = evidence.sample, []
    for coding in CODINGS:
        coded = coding.into(evidence.frame.color)
        for downs in _downs(coding):
            small = _shrunk(coded, downs[0])
            for guess in downs:
                large = _grown(small, guess, coded.shape, at)
                if sampled_right(evidence, _recoded(coded[at], large, guess)):
                    out.append(guess)
            yield 0.0
    return out


def _downs(coding: Coding) -> Iterator[list[Shrunk]]:
    """Yield the guesses of each way to shrink a picture."""
    for n, name in SHARES.items():
        places = sorted({0, n // 2, n - 1})
        downs = [*((Way.NEAREST, corner) for corner in product(places, places)), (Way.MEAN, (0, 0))]
        for down, corner in downs:
            hues = [False, True] if down is Way.MEAN and coding.words else [False]
            yield [
                Shrunk(n, down, up, corner, coding, alone, words=words)
                for alone, up in product(hues, (Way.NEAREST, *_KERNELS))
                for whose in (("'s hues alone were" if alone else " was"),)
                for words in (f"{whose} shrunk to {name} the size {down}, and enlarged again {up}",)
            ]


SIZE_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "resampled",
        "the picture was rendered at {words}",
        "A screenshot, or the scaling of a screen or a program, changes the size after rendering.",
        "render it at the size at which it is compared",
        lambda case, guess: at_size(as_stored(case, guess), guess.size),
        _find_size,
        ("size",),
        everywhere=True,
        sampled=False,
        after=_resampled,
        effort=Effort.PIXELS,
        words="another size, and resampled",
    ),
    Fault(
        "shrunk",
        "the picture{words}",
        "A preview or a thumbnail was rendered or stored small, and enlarged to be compared; a "
        "JPEG and a video have the hues (chroma) at half the size: 4:2:0.",
        "compare the picture as it was rendered",
        as_stored,
        _find_shrunk,
        ("n",),
        everywhere=True,
        sampled=False,
        after=_enlarged,
        effort=Effort.PIXELS,
        words=" was shrunk to a part of its size, and enlarged again, or its hues alone were",
    ),
)

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
from ...camera_files.frame import part
from ...causes.case import Case
from ...causes.checks.probe import SOUND
from ...files.images import decoded, encoded
from ...pictures.picture import Picture
from ...rendering import frame_of
from ...scene import Region
from ...tracer.progress import Work
from ..evidence import Evidence
from .fault import AnyFault, Effort, Fault, Guess

SHARES = {2: "half", 3: "a third of", 4: "a quarter of"}  # of the size, by the factor
ROUNDING = 1e-9  # of a row
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


def _rounded_before(picture: Picture) -> Picture:
    """Return a picture with a level more in a file: what is mixed in it was rounded before."""
    storage = picture.storage
    return replace(picture, storage=replace(storage, dither=storage.dither + (storage.levels > 0)))


def sampled_right(evidence: Evidence, colors: Array) -> bool:
    """Return whether most sampled pixels, and most unexplained ones, show colours (n, 4)."""
    right = ~_rounded_before(evidence.shown).other_color(colors)
    return bool(right[evidence.unexplained_sampled].mean() > RIGHT and right.mean() > RIGHT)


def at_size(case: Case, size: float) -> Case:
    """Return the case with its region, which may be a border's, traced at another size."""
    own = part(case.scene.camera)
    width, height = (max(1, round(size * n)) for n in (own.width, own.height))
    camera = replace(own, width=width, height=height, region=Region(0, 0, width, height))
    return case.with_scenes(lambda scene: scene.seen_by(camera))


Mix = list[tuple[Places, Floats]]  # for each of n places, which pixels are taken, and their weights


def _mix(have: int, size: int, way: Way) -> Mix:
    """Return the weights with which a row of `have` pixels is resampled to `size` pixels."""
    place = (np.arange(size) + 0.5) * have / size - 0.5
    reach, kernel = _KERNELS[way]
    pixels = np.floor(place).astype(int) - reach + 1 + np.arange(2 * reach)[:, None]
    weights = np.where((pixels >= 0) & (pixels < have), kernel(place - pixels), 0)
    return [*zip(pixels.clip(0, have - 1), weights / weights.sum(axis=0), strict=True)]


At = tuple[Places, ...]  # rows and columns


def resized(colors: Array, shape: tuple[int, ...], way: Way, at: At) -> Array:
    """Resample a picture (h', w', 4) to another size (h, w); return some pixels."""
    rows, columns = at
    ups, acrosses = (_mix(*sizes, way) for sizes in zip(colors.shape[:2], shape[:2], strict=True))
    parts = (
        (up[rows] * across[columns])[..., None] * colors[y[rows], x[columns]]
        for (y, up), (x, across) in product(ups, acrosses)
    )
    return np.asarray(sum(parts))


@dataclass(frozen=True, eq=False)
class Small(Guess):
    """A picture smaller by a factor of n, enlarged again."""

    n: int
    down: Way | None  # how it was shrunk; None if it was rendered so small
    up: Way
    coding: Coding
    # Which pixel of each n x n is taken if one is: row and column, as shares of n.
    corner: tuple[float, float] = (0.0, 0.0)
    spans: bool = True  # the whole picture; else a last row or column may span more than it shows
    hues: bool = False  # whether these alone were, and not the brightness


def _shrunk(colors: Array, guess: Small) -> Array:
    """Shrink a picture (h, w, 4) by n, from its top row: one pixel of each n x n, or the mean."""
    n = guess.n
    out = np.asarray(colors, np.float64)[::-1]
    if guess.down is Way.NEAREST:
        rows, columns = (
            _taken(size, guess, at) for size, at in zip(out.shape[:2], guess.corner, strict=True)
        )
        return out[rows][:, columns][::-1]
    for axis in (0, 1):
        starts = np.arange(0, out.shape[axis], n)
        count = np.diff(np.append(starts, out.shape[axis]))
        shares = [-1 if k == axis else 1 for k in range(out.ndim)]
        out = np.add.reduceat(out, starts, axis=axis) / count.reshape(shares)
    return out[::-1]


def _taken(size: int, guess: Small, corner: float) -> Places:
    """Return which of so many rows or columns are left."""
    count = max(1, size // guess.n) if guess.spans else -(-size // guess.n)
    step = size / count if guess.spans else guess.n
    return np.minimum((np.arange(count) + corner + ROUNDING) * step, size - 1).astype(int)


def _grown(small: Array, guess: Small, shape: tuple[int, ...], at: At) -> Array:
    """Return some pixels of a picture that is enlarged again."""
    if guess.up is not Way.NEAREST:
        return resized(small, shape, guess.up, at)
    blocks = (  # counted from above: a last one may be smaller
        np.minimum(((place + 0.5) / step).astype(int), have - 1)
        for place, size, have in zip(
            (shape[0] - 1 - at[0], at[1]), shape, small.shape, strict=False
        )
        for step in [size / have if guess.spans else guess.n]
    )
    return small[::-1][tuple(blocks)]


def _enlarged(colors: Colors, guess: Small, evidence: Evidence) -> Colors:
    """Enlarge a picture to the evidence's size; shrink it before, unless it was rendered small."""
    shape, coded = evidence.unexplained.shape, guess.coding.into(colors)
    small = _shrunk(coded, guess) if guess.down else coded
    everywhere = tuple(np.ogrid[: shape[0], : shape[1]])
    return _recoded(coded, _grown(small, guess, shape, everywhere), guess)


def _recoded(coded: Array, large: Array, guess: Small) -> Colors:
    """Return linear colours; with their own brightness (Rec. 601) if the hues alone were shrunk."""
    if guess.hues:
        luma = (coded - large)[..., :3] @ (0.299, 0.587, 0.114)
        large = np.concatenate((large[..., :3] + luma[..., None], coded[..., 3:]), axis=-1)
    return guess.coding.back(large).astype(np.float32)


def _find(evidence: Evidence) -> Work[list[Small]]:
    """Guess by what factor the picture is smaller, and how, by the sampled pixels."""
    at, shape, out = evidence.sample, evidence.unexplained.shape, []
    for n, name in SHARES.items():
        rendered = yield from frame_of(at_size(evidence.case, 1 / n).scene, SOUND)
        for guesses in _downs(n, name, any(size % n for size in shape)):
            first = guesses[0]
            coded = first.coding.into((evidence.frame if first.down else rendered).color)
            small = _shrunk(coded, first) if first.down else coded
            for guess in guesses:
                own = coded[at] if guess.hues else coded
                large = _recoded(own, _grown(small, guess, shape, at), guess)
                if sampled_right(evidence, large):
                    out.append(guess)
            yield None
    return out


def _downs(n: int, name: str, remains: bool) -> Iterator[list[Small]]:
    """Yield the guesses of each way to come to a picture smaller by n; a row may remain."""
    places = sorted({0.0, 0.5, 1 - 1 / n})  # the last: counted from the lowest row
    corners = [*product(places, places)]
    downs: list[tuple[Way | None, tuple[float, float], bool]] = [
        (None, (0.0, 0.0), True),
        (Way.MEAN, (0.0, 0.0), False),
        *((Way.NEAREST, corner, spans) for corner in corners for spans in {False, remains}),
    ]
    for coding, (down, corner, spans) in product(CODINGS, downs):
        made = f"shrunk to {name} its size {down}" if down else f"rendered at {name} its size"
        whose = {False: f" was {made}"}
        if down is Way.MEAN and coding.words:
            whose[True] = f"'s hues alone were shrunk to {name} the size {down}"
        yield [
            Small(
                n,
                down,
                up,
                coding,
                corner,
                spans,
                hues,
                words=f"{words}, and enlarged {up}",
                values=(float(n),),
            )
            for hues, words in whose.items()
            for up in (Way.NEAREST, *_KERNELS)
        ]


def _rendered(case: Case, guess: Small) -> Case:
    """Return the case at the size at which it was rendered, with a level more in a file."""
    case = at_size(case, 1 / guess.n) if guess.down is None else case
    return replace(case, picture=_rounded_before(case.picture))


SIZE_FAULTS: tuple[AnyFault, ...] = (
    Fault(
        "resampled",
        "the picture{words}",
        "A preview, a thumbnail or a screenshot is small, and enlarged; a JPEG and a "
        "video have the hues (chroma) at half the size.",
        "compare the picture as it was rendered, at the size at which it was",
        _rendered,
        _find,
        ("n",),
        everywhere=True,
        sampled=False,
        after=_enlarged,
        effort=Effort.PIXELS,
        words=" was rendered at, or shrunk to, a part of its size, and enlarged, or its hues were",
        witness="mozilla-services/screenshots#1006",
    ),
)

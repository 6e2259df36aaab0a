"""Measures how far two pictures differ: RMSE, PSNR, SSIM, the largest difference.

Pictures are (h, w, c) of any real type; the data range is given, not guessed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import Array, Bools, Colors, Floats
from ..tracer.frame import Frame
from ..tracer.progress import Work
from .bounds import largest_within


class Largest(NamedTuple):
    """The largest absolute difference of two pictures, and where it is."""

    value: float
    pixel: tuple[int, int]  # x, y; row 0 first
    channel: int


@dataclass(frozen=True)
class Metrics:
    """How far two pictures differ, as images."""

    rmse: float
    ssim: float
    largest_difference: Largest

    @property
    def psnr(self) -> float:
        """The peak signal-to-noise ratio in decibels; infinite for equal pictures."""
        return psnr(self.rmse)

    def to_dict(self) -> dict[str, object]:
        """Return them as JSON can hold them: no ratio where it is infinite."""
        largest = self.largest_difference
        return {
            "rmse": self.rmse,
            "psnr": self.psnr if self.rmse else None,
            "ssim": self.ssim,
            "largest_difference": largest._asdict() | {"pixel": list(largest.pixel)},
        }


_ROWS, _COLUMNS = 32, 64  # compared together, so that a step is short
_WINDOW = 7  # pixels


def rmse(first: Array, second: Array) -> float:
    """Return the root of the mean squared difference over all pixels and channels of (h, w, c).

    Raises
    ------
    ValueError
        If the pictures differ in shape.
    """
    _same_shape(first, second)
    return float(np.sqrt(np.mean((first.astype(np.float64) - second) ** 2)))


def psnr(error: float) -> float:
    """Return the peak signal-to-noise ratio in decibels of an RMSE; infinite for equal pictures."""
    return float("inf") if error == 0 else float(20 * np.log10(1 / error))


def ssim(first: Array, second: Array) -> Work[float]:
    """Return the mean structural similarity of two pictures (h, w, c), 1 for equal ones.

    The window is uniform, _WINDOW pixels wide and high, or in smaller pictures the largest odd one
    that fits. Covariances are of samples, K1 = 0.01 and K2 = 0.03, and values are from 0 to 1. The
    mean is over the windows that lie inside the picture, and over the channels.

    References
    ----------
    Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to
    structural similarity", 2004.
    """
    _same_shape(first, second)
    shortest = min(first.shape[:2])
    size = min(_WINDOW, shortest - (1 - shortest % 2))
    height = first.shape[0] - size + 1
    width = first.shape[1] - size + 1
    total = 0.0
    alike: dict[bytes, float] = {}

    def mean(one: Array, other: Array) -> float:
        return float(_similarity(one, other, size).mean(axis=(0, 1)).sum())

    for y in range(0, height, _ROWS):
        for x in range(0, width, _COLUMNS):
            rows, columns = min(_ROWS, height - y), min(_COLUMNS, width - x)
            part = np.s_[y : y + rows + size - 1, x : x + columns + size - 1]
            one, other = first[part], second[part]
            if (one == one[0, 0]).all() and (other == other[0, 0]).all():
                # All windows are alike: one is enough, and the same as in other such blocks.
                one, other = one[:size, :size], other[:size, :size]
                key = one[0, 0].tobytes() + other[0, 0].tobytes()
                if key not in alike:
                    alike[key] = mean(one, other)
                similarity = alike[key]
            else:
                similarity = mean(one, other)
            total += rows * columns * similarity
        yield None
    return float(total / (height * width * first.shape[2]))


def _similarity(first: Array, second: Array, size: int) -> Floats:
    """Return the similarity of every window and channel."""
    x = first.astype(np.float64)
    y = second.astype(np.float64)
    samples = size * size
    unbiased = samples / max(samples - 1, 1)
    ux, uy, xx, yy, xy = _window_means(np.stack((x, y, x * x, y * y, x * y)), size)
    vx = unbiased * (xx - ux * ux)
    vy = unbiased * (yy - uy * uy)
    vxy = unbiased * (xy - ux * uy)
    c1 = 0.01**2
    c2 = 0.03**2
    return ((2 * ux * uy + c1) * (2 * vxy + c2)) / ((ux**2 + uy**2 + c1) * (vx + vy + c2))


def largest_difference(first: Array, second: Array) -> Largest:
    """Return the largest absolute difference, with the pixel (x, y; row 0 first) and channel."""
    _same_shape(first, second)
    difference = np.abs(first.astype(np.float64) - second)
    y, x, channel = np.unravel_index(int(np.argmax(difference)), difference.shape)
    return Largest(float(difference[y, x, channel]), (int(x), int(y)), int(channel))


def image_metrics(traced: Colors, picture: Colors) -> Work[Metrics]:
    """Measure how far two pictures (h, w, 4) of linear RGBA differ; NaN counts as 0."""
    a, b = (p if np.isfinite(p).all() else np.nan_to_num(p) for p in (traced, picture))
    height = len(a)
    squares = 0.0
    largest = []  # of each block of rows
    for start in range(0, height, _ROWS):
        rows = slice(start, start + _ROWS)
        squares += rmse(a[rows], b[rows]) ** 2 * len(a[rows])
        found = largest_difference(a[rows], b[rows])
        x, y = found.pixel
        largest.append(found._replace(pixel=(x, start + y)))
        yield None
    error = float(np.sqrt(squares / height))
    similarity = yield from ssim(a, b)
    return Metrics(error, similarity, max(largest, key=lambda found: found.value))


def _window_means(pictures: Floats, size: int) -> Floats:
    """Return the mean over every window of size x size pixels of pictures (k, h, w, c)."""
    for axis in (1, 2):
        lines = pictures.swapaxes(axis, 0)
        count = len(lines) - size + 1
        total = lines[:count].copy("K")
        for first in range(1, size):
            total += lines[first : first + count]
        total /= size
        pictures = total.swapaxes(axis, 0)
    return pictures


def _same_shape(first: Array, second: Array) -> None:
    if first.shape != second.shape or first.ndim != 3:
        raise ValueError(
            f"Pictures must be (h, w, c) of one size, not {first.shape} and {second.shape}."
        )


def boundary(frame: Frame) -> Bools:
    """Return which pixels (h, w) see another instance than one of the eight pixels around them.

    The background counts as an instance.
    """
    seen = frame.instance_index
    return (largest_within(seen, 1) != seen) | (largest_within(-seen, 1) != -seen)


def beside_edges(color: Array, least: float) -> Bools:
    """Return which pixels of a picture (h, w, c) have another colour than one of the eight around.

    By more than `least` in a channel.
    """
    apart = [largest_within(v, 1) + largest_within(-v, 1) for v in np.moveaxis(color, -1, 0)]
    out: Bools = np.max(apart, axis=0) > least
    return out

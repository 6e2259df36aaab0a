"""Measures how far two pictures differ: RMSE, PSNR, SSIM, the largest difference.

Pictures are (h, w, c) of any real type; the data range is given, not guessed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import Array, Bools, Colors, Floats, parts
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
        return float("inf") if self.rmse == 0 else float(20 * np.log10(1 / self.rmse))

    def to_dict(self) -> dict[str, object]:
        """Return them as JSON can hold them: no ratio where it is infinite."""
        largest = self.largest_difference
        return {
            "rmse": self.rmse,
            "psnr": self.psnr if self.rmse else None,
            "ssim": self.ssim,
            "largest_difference": largest._asdict() | {"pixel": list(largest.pixel)},
        }


_ROWS, _COLUMNS = 32, 256  # compared together, in a processor's cache and a short step
_WINDOW = 7  # pixels


def _ssim(first: Array, second: Array) -> Work[float]:
    """Return the mean structural similarity of two pictures (h, w, c), 1 for equal ones.

    The window is uniform, _WINDOW pixels wide and high, or in smaller pictures the largest odd one
    that fits. Covariances are of samples, K1 = 0.01 and K2 = 0.03, and values are from 0 to 1. The
    mean is over the windows that lie inside the picture, and over the channels.

    References
    ----------
    Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to
    structural similarity", 2004.
    """
    shortest = min(first.shape[:2])
    size = min(_WINDOW, shortest - (1 - shortest % 2))
    height = first.shape[0] - size + 1
    width = first.shape[1] - size + 1
    total = 0.0
    for rows in parts(height, _ROWS):
        for columns in parts(width, _COLUMNS):
            part = np.s_[rows.start : rows.stop + size - 1, columns.start : columns.stop + size - 1]
            total += float(_similarity(first[part], second[part], size).sum())
        yield None
    return total / (height * width * first.shape[2])


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


def image_metrics(traced: Colors, picture: Colors) -> Work[Metrics]:
    """Measure how far two pictures (h, w, c) of one size differ; NaN counts as 0."""
    a, b = (p if np.isfinite(p).all() else np.nan_to_num(p) for p in (traced, picture))
    height = len(a)
    squares = 0.0
    largest = []  # of each block of rows
    for rows in parts(height, _ROWS):
        apart = np.abs(a[rows].astype(np.float64) - b[rows])
        squares += float(np.sqrt(np.mean(apart**2))) ** 2 * len(apart)
        y, x, channel = map(int, np.unravel_index(np.argmax(apart), apart.shape))
        largest.append(Largest(float(apart[y, x, channel]), (x, rows.start + y), channel))
        yield None
    error = float(np.sqrt(squares / height))
    similarity = yield from _ssim(a, b)
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
    return np.max(apart, axis=0) > least

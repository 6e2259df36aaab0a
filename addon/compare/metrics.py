"""Measures how far two pictures differ: RMSE, PSNR, SSIM, the largest difference.

Pictures are (h, w, c) of any real type; the data range is given, not guessed.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Array, Colors, Floats, Mask
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from .bounds import largest_within

_ROWS, _COLUMNS = 32, 64  # looked at together, so that a step is short


def rmse(first: Array, second: Array) -> float:
    """Return the root of the mean squared difference over all pixels and channels.

    Raises
    ------
    ValueError
        If the pictures differ in shape.
    """
    _same_shape(first, second)
    return float(np.sqrt(np.mean((first.astype(np.float64) - second) ** 2)))


def psnr(error: float, data_range: float = 1.0) -> float:
    """Return the peak signal-to-noise ratio in decibels of an RMSE; infinite for equal pictures."""
    return float("inf") if error == 0 else float(20 * np.log10(data_range / error))


def ssim(first: Array, second: Array, data_range: float = 1.0, size: int = 7) -> Work[float]:
    """Return the mean structural similarity of two pictures, 1 for equal ones.

    Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to
    structural similarity", 2004; with a uniform window of `size` x `size` pixels, sample
    covariances, K1 = 0.01 and K2 = 0.03, averaged over the windows that lie inside the picture and
    over the channels. Smaller pictures take the largest odd window that fits.
    """
    _same_shape(first, second)
    shortest = min(first.shape[:2])
    size = min(size, shortest - (1 - shortest % 2))
    height, width, total = first.shape[0] - size + 1, first.shape[1] - size + 1, 0.0
    for y in range(0, height, _ROWS):
        for x in range(0, width, _COLUMNS):
            rows, columns = min(_ROWS, height - y), min(_COLUMNS, width - x)
            part = np.s_[y : y + rows + size - 1, x : x + columns + size - 1]
            sides = first[part], second[part]
            if all((side == side[0, 0]).all() for side in sides):  # each window is as the others
                sides = tuple(side[:size, :size] for side in sides)
            total += rows * columns * _similarity(*sides, data_range, size).mean(axis=(0, 1)).sum()
        yield y / height
    return float(total / (height * width * first.shape[2]))


def _similarity(first: Array, second: Array, data_range: float, size: int) -> Array:
    """Return the similarity of every window and channel."""
    x, y = first.astype(np.float64), second.astype(np.float64)
    samples = size * size
    unbiased = samples / (samples - 1) if samples > 1 else 1.0
    ux, uy = _window_mean(x, size), _window_mean(y, size)
    vx = unbiased * (_window_mean(x * x, size) - ux * ux)
    vy = unbiased * (_window_mean(y * y, size) - uy * uy)
    vxy = unbiased * (_window_mean(x * y, size) - ux * uy)
    c1, c2 = (0.01 * data_range) ** 2, (0.03 * data_range) ** 2
    return ((2 * ux * uy + c1) * (2 * vxy + c2)) / ((ux**2 + uy**2 + c1) * (vx + vy + c2))


def largest_difference(first: Array, second: Array) -> dict[str, Any]:
    """Return the largest absolute difference, with the pixel (x, y; row 0 first) and channel."""
    _same_shape(first, second)
    difference = np.abs(first.astype(np.float64) - second)
    y, x, channel = np.unravel_index(int(difference.argmax()), difference.shape)
    value = float(difference[y, x, channel])
    return {"value": value, "pixel": [int(x), int(y)], "channel": int(channel)}


def image_metrics(traced: Colors, picture: Colors) -> Work[dict[str, Any]]:
    """Measure how far two pictures of linear RGBA differ; what is not a number counts as 0.

    RMSE, PSNR in decibels (None for infinite), SSIM, and the largest difference.
    """
    a, b = np.empty_like(traced), np.empty_like(picture)
    height, squares, largest = len(a), 0.0, {"value": -1.0}
    for start in range(0, height, _ROWS):
        rows = slice(start, min(start + _ROWS, height))
        for made, of in ((a, traced), (b, picture)):
            made[rows] = of[rows] if np.isfinite(of[rows]).all() else np.nan_to_num(of[rows])
        squares += rmse(a[rows], b[rows]) ** 2 * (rows.stop - start)
        found = largest_difference(a[rows], b[rows])
        if found["value"] > largest["value"]:
            largest = found | {"pixel": [found["pixel"][0], found["pixel"][1] + start]}
        yield 0.2 * start / height
    error = float(np.sqrt(squares / height))
    similarity = yield from scaled(ssim(a, b), 0.2, 0.8)
    told = {"rmse": error, "psnr": psnr(error) if error else None, "ssim": similarity}
    return told | {"largest_difference": largest}


def _window_mean(picture: Floats, size: int) -> Floats:
    """Return the mean over every size x size window; sums of 1, 2, 4... make up those of `size`."""
    for axis in (0, 1):
        picture = picture.swapaxes(axis, 0)
        count, sums, done, total = len(picture) - size + 1, picture, 0, 0.0
        for bit in range(size.bit_length()):
            step = 1 << bit
            if size & step:
                total = total + sums[done : done + count]
                done += step
            sums = sums[:-step] + sums[step:]
        picture = (total / size).swapaxes(axis, 0)
    return picture


def _same_shape(first: Array, second: Array) -> None:
    if first.shape != second.shape or first.ndim != 3:
        raise ValueError(
            f"Pictures must be (h, w, c) of one size, not {first.shape} and {second.shape}."
        )


def boundary(frame: Frame) -> Mask:
    """Return which pixels see, with the eight around them, more than one appearance of an object.

    The background is one, too. Beyond the picture's rim is what its outermost pixels see.
    """
    seen = frame.instance_index
    return (largest_within(seen, 1) != seen) | (largest_within(-seen, 1) != -seen)

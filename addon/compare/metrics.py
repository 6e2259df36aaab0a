"""How far two pictures differ, and in how many pixels: RMSE, PSNR, SSIM, and counts by cause.

Pictures are (h, w, c) of any real type; the data range is given, not guessed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from .bounds import largest_within
from .cause import Cause, Causes
from .identity import Identity

_ROWS, _COLUMNS = 32, 64  # looked at together, so that a step is short
EXAMPLES = 10  # pixels named of each cause


def rmse(first: NDArray, second: NDArray) -> float:
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


def ssim(first: NDArray, second: NDArray, data_range: float = 1.0, size: int = 7) -> Work[float]:
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


def _similarity(first: NDArray, second: NDArray, data_range: float, size: int) -> NDArray:
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


def largest_difference(first: NDArray, second: NDArray) -> dict[str, Any]:
    """Return the largest absolute difference, with the pixel (x, y; row 0 first) and channel."""
    _same_shape(first, second)
    difference = np.abs(first.astype(np.float64) - second)
    y, x, channel = np.unravel_index(int(difference.argmax()), difference.shape)
    value = float(difference[y, x, channel])
    return {"value": value, "pixel": [int(x), int(y)], "channel": int(channel)}


def image_metrics(
    traced: NDArray[np.float32], picture: NDArray[np.float32]
) -> Work[dict[str, Any]]:
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


def _window_mean(picture: NDArray[np.float64], size: int) -> NDArray[np.float64]:
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


def _same_shape(first: NDArray, second: NDArray) -> None:
    if first.shape != second.shape or first.ndim != 3:
        raise ValueError(
            f"Pictures must be (h, w, c) of one size, not {first.shape} and {second.shape}."
        )


def boundary(frame: Frame) -> NDArray[np.bool_]:
    """Return which pixels see, with the eight around them, more than one appearance of an object.

    The background is one, too. Beyond the picture's rim is what its outermost pixels see.
    """
    seen = frame.instance_index
    return (largest_within(seen, 1) != seen) | (largest_within(-seen, 1) != -seen)


def count_pixels(
    causes: Causes,
    at_boundary: NDArray[np.bool_],
    identity: Identity | None = None,
    features: Sequence[str] = (),
) -> dict[str, Any]:
    """Count pixels by what is said of them, and those at boundaries and inside apart.

    total = agree + differ + not_decidable + not_traced, and differ = explained + unexplained. The
    `examples` are some pixels of each cause, spread over them, [x, y] of the region from its
    lower left. Where it is known whose surfaces are shown, `unexplained_shows` says whether what is
    unexplained is a wrong colour (the same object) or a wrong object. `not_judged` counts pixels
    in which a fault would be excused, and by which of the unmodelled features excuses it.
    """
    cause = causes.cause
    out = _counts(cause)
    out["interior"] = _counts(cause[~at_boundary])
    out["boundary"] = _counts(cause[at_boundary])
    out["examples"] = {
        c.key: _positions(cause == c) for c in sorted(Cause) if out["by_cause"].get(c.key)
    }
    blind = causes.blind[causes.blind >= 0]
    found, count = np.unique(blind, return_counts=True)
    by_feature: Counter[str] = Counter()
    for n, many in zip(found, count, strict=True):
        by_feature[features[n]] += int(many)
    out["not_judged"] = {
        "pixels": len(blind),
        "share": len(blind) / max(cause.size, 1),
        "by_feature": dict(by_feature.most_common()),
    }
    if identity is not None:
        out["unexplained_shows"] = identity.counts(cause == Cause.UNEXPLAINED)
    return out


def _counts(cause: NDArray[np.uint8]) -> dict[str, Any]:
    count = {c: int((cause == c).sum()) for c in sorted(Cause)}
    explained = sum(n for c, n in count.items() if c.explains)
    return {
        "total": cause.size,
        "agree": count[Cause.AGREE],
        "differ": explained + count[Cause.UNEXPLAINED],
        "explained": explained,
        "unexplained": count[Cause.UNEXPLAINED],
        "not_decidable": count[Cause.NOT_DECIDABLE],
        "not_traced": count[Cause.NOT_TRACED],
        "by_cause": {c.key: n for c, n in count.items() if c.differs or c is Cause.NOT_DECIDABLE},
    }


def _positions(where: NDArray[np.bool_]) -> list[list[int]]:
    """Return some pixels, spread evenly over all, as [x, y] from the lower left."""
    found = np.flatnonzero(where)
    chosen = np.linspace(0, len(found) - 1, min(len(found), EXAMPLES)).astype(int)
    return [[int(i % where.shape[1]), int(i // where.shape[1])] for i in found[chosen]]

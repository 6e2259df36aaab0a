"""Faults of the picture, each by its own formula in linear premultiplied RGBA."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from PIL import Image

from .description import Description
from .making import (
    LEVELS,
    Change,
    Fault,
    Made,
    afterwards,
    decoded,
    encoded,
    once,
    through_file,
)

BOX = 0.75  # pixels: a box filter reaches a pixel's corner, 0.707 from its centre
Colors = Callable[[np.ndarray], np.ndarray]


def of_straight(change: Colors) -> Colors:
    """Return what changes straight RGB."""

    def changed(picture: np.ndarray) -> np.ndarray:
        alpha = picture[..., 3:]
        straight = picture[..., :3] / np.where(alpha > 0, alpha, 1)
        return np.concatenate((change(straight) * alpha, alpha), axis=-1)

    return changed


def colors(key: str, label: str, change: Colors, **numbers: float) -> Fault:
    """Return a fault that changes straight RGB."""
    return Fault(key, label, afterwards(of_straight(change)), numbers)


def _divided(picture: np.ndarray) -> np.ndarray:
    """Return the picture with its alpha divided out, told as if it were multiplied in."""
    return np.concatenate((picture[..., :3] / picture[..., 3:], picture[..., 3:]), axis=-1)


def _again(picture: np.ndarray) -> np.ndarray:
    """Return the picture with its alpha multiplied in once more."""
    return np.concatenate((picture[..., :3] * picture[..., 3:], picture[..., 3:]), axis=-1)


def smooth(change: Colors) -> Change:
    """Return what changes a picture of 8 x 8 samples a pixel, and says so.

    Of one sample a pixel alpha is 1, but for the background: a picture may have its own.
    """

    def make(_: Description, made: Made) -> Made:
        draw = partial(once, samples=8)
        return replace(made, draw=draw, after=change, filter_radius=BOX)

    return make


def in_file(key: str, label: str, change: Colors, **numbers: float) -> Fault:
    """Return a fault of what is stored in eight bits; a picture with alpha keeps that apart."""

    def make(_: Description, made: Made) -> Made:
        return replace(made, after=change, levels=LEVELS)

    return Fault(key, label, make, numbers)


def jpeg(quality: int) -> Fault:
    """Return the picture after a JPEG, without its alpha."""

    def change(picture: np.ndarray) -> np.ndarray:
        straight = picture[..., :3] / np.maximum(picture[..., 3:], 1e-9)
        coded = np.rint(LEVELS * encoded(straight)).astype(np.uint8)
        held = io.BytesIO()
        Image.fromarray(coded).save(held, "JPEG", quality=quality)
        read = decoded(np.asarray(Image.open(held), np.float64) / LEVELS)
        return np.concatenate((read * picture[..., 3:], picture[..., 3:]), axis=-1)

    return in_file("jpeg", f"quality {quality}", change, quality=quality)


def resized(picture: np.ndarray, width: int, height: int, nearest: bool) -> np.ndarray:
    """Return a picture (h, w, 4) at another size, each pixel's centre kept in its place."""
    rows, columns = picture.shape[:2]
    v = (np.arange(height) + 0.5) * rows / height - 0.5
    u = (np.arange(width) + 0.5) * columns / width - 0.5
    if nearest:
        v = np.clip(np.rint(v), 0, rows - 1).astype(int)
        u = np.clip(np.rint(u), 0, columns - 1).astype(int)
        return picture[v][:, u]
    for axis, at, count in ((0, v, rows), (1, u, columns)):
        at = np.clip(at, 0, count - 1)
        low = np.minimum(np.floor(at).astype(int), count - 2)
        share = np.expand_dims(at - low, (1, 2) if axis == 0 else (0, 2))
        first, second = (np.take(picture, low + n, axis=axis) for n in (0, 1))
        picture = first * (1 - share) + second * share
    return picture


def resampled(ratio: float, nearest: bool) -> Fault:
    """Return a picture rendered at another size, then brought to this one."""

    def draw(made: Made) -> np.ndarray:
        own = made.camera
        width, height = round(own.width * ratio), round(own.height * ratio)
        k = np.diag((width / own.width, height / own.height, 1.0)) @ own.k
        other = replace(own, k=k, width=width, height=height)
        small = once(replace(made, camera=other))
        return resized(small, own.width, own.height, nearest)

    label = f"from {ratio:g} times the size, {'nearest' if nearest else 'bilinear'}"
    return Fault("resampled", label, lambda _, m: replace(m, draw=draw), {"n": 1 / ratio})


def filtered(radius: float, gauss: bool = False) -> Fault:
    """Return a picture of many samples a pixel, by a filter that reaches `radius` pixels."""
    n = 8  # samples a pixel, each way

    def draw(made: Made) -> np.ndarray:
        own = made.camera
        edge = int(np.ceil(radius))
        k = np.diag((n, n, 1.0)) @ np.array([[1.0, 0, edge], [0, 1, edge], [0, 0, 1]]) @ own.k
        size = {"width": (own.width + 2 * edge) * n, "height": (own.height + 2 * edge) * n}
        picture = once(replace(made, camera=replace(own, k=k, **size)))
        for axis, count in ((0, own.height), (1, own.width)):
            picture = _mixed(picture, axis, count, edge)
        return picture

    def _mixed(picture: np.ndarray, axis: int, count: int, edge: int) -> np.ndarray:
        steps = np.arange(-edge * n, (edge + 1) * n)
        away = (steps + 0.5) / n - 0.5  # of a sample from the pixel's centre, in pixels
        weight = np.exp(-2 * (away / radius * 1.5) ** 2) if gauss else np.ones(len(away))
        weight = np.where(np.abs(away) < radius, weight, 0.0)
        first = np.arange(count) * n
        parts = (
            w * np.take(picture, first + k, axis=axis)
            for k, w in enumerate(weight / weight.sum())
            if w
        )
        return sum(parts)

    label = f"{'gauss' if gauss else 'box'}, {radius:g} px"
    return Fault("filter_radius", label, lambda _, m: replace(m, draw=draw), {"radius": radius})


def means(picture: np.ndarray, n: int) -> np.ndarray:
    """Return the mean of each n x n pixels from above, in all of them."""
    for axis in (0, 1):
        blocks = np.arange(picture.shape[axis]) // n
        starts, counts = np.unique(blocks, return_index=True, return_counts=True)[1:]
        shape = (-1, 1, 1) if axis == 0 else (1, -1, 1)
        sums = np.add.reduceat(picture, starts, axis=axis) / counts.reshape(shape)
        picture = np.take(sums, blocks, axis=axis)
    return picture


def corners(picture: np.ndarray, n: int) -> np.ndarray:
    """Return the first of each n x n pixels from above, in all of them."""
    rows, columns = (np.arange(size) // n * n for size in picture.shape[:2])
    return picture[rows][:, columns]


def shrunk(n: int, nearest: bool) -> Fault:
    """Return the picture with one pixel, or the mean, of each n x n from above, n x n large."""
    change = partial(corners if nearest else means, n=n)
    label = f"1/{n} of the size, {'nearest' if nearest else 'mean'}, and back"
    return Fault("resampled", label, afterwards(change), {"n": n})


def supersampled(n: int, coded: bool = False) -> Fault:
    """Return a picture with the mean of n x n samples in each pixel, of linear or coded values."""

    def draw(made: Made) -> np.ndarray:
        own = made.camera
        k = np.diag((n, n, 1.0)) @ own.k
        many = replace(own, k=k, width=n * own.width, height=n * own.height)
        picture = once(replace(made, camera=many))
        picture = in_code(picture) if coded else picture
        mean = picture.reshape(own.height, n, own.width, n, 4).mean(axis=(1, 3))
        return out_of_code(mean) if coded else mean

    label = f"{n} x {n}{', coded' if coded else ''}"
    return Fault("supersampled", label, lambda _, m: replace(m, draw=draw), {"n": n})


def in_code(picture: np.ndarray) -> np.ndarray:
    """Return straight RGB in sRGB's curve, and alpha."""
    alpha = picture[..., 3:]
    straight = picture[..., :3] / np.where(alpha > 0, alpha, 1)
    return np.concatenate((encoded(straight), alpha), axis=-1)


def out_of_code(coded: np.ndarray) -> np.ndarray:
    """Return linear RGB with alpha multiplied in."""
    return np.concatenate((decoded(coded[..., :3]) * coded[..., 3:], coded[..., 3:]), axis=-1)


def saturated(share: float, coded: bool) -> Fault:
    """Return colours farther from their grey, or nearer: by Rec. 709 of linear, 601 of coded."""
    weights = np.array((0.299, 0.587, 0.114) if coded else (0.2126, 0.7152, 0.0722))

    def change(straight: np.ndarray) -> np.ndarray:
        c = encoded(straight) if coded else straight
        gray = (c @ weights)[..., None]
        c = np.clip(gray + share * (c - gray), 0, None)
        return decoded(np.clip(c, 0, 1)) if coded else c

    label = f"x {share:g}, {'coded' if coded else 'linear'}"
    return colors("saturation", label, change, share=share)


def _noisy(picture: np.ndarray) -> np.ndarray:
    """Add noise of up to two levels before it is rounded to eight bits."""
    rng = np.random.default_rng(27)
    return through_file(picture, lambda v: np.rint(v + rng.uniform(-2, 2, v.shape)))


def eight(values: np.ndarray, read: Colors = lambda v: v) -> np.ndarray:
    """Return what is read of values rounded to eight bits."""
    return read(np.rint(LEVELS * np.clip(values, 0, 1)) / LEVELS)


def _few_bits(straight: np.ndarray) -> np.ndarray:
    """Return colours of 5, 6 and 5 bits."""
    levels = np.array((31, 63, 31))
    return decoded(np.rint(levels * encoded(straight)) / levels)


def _half_chroma(straight: np.ndarray) -> np.ndarray:
    """Return colours whose Cb and Cr (Rec. 601) are the mean of 2 x 2 pixels."""
    weights = np.array((0.299, 0.587, 0.114))
    coded = encoded(straight)
    luma = (coded @ weights)[..., None]
    chroma = coded - luma
    return decoded(np.clip(luma + means(chroma, 2), 0, 1))


def enlarged(n: int) -> Fault:
    """Return the picture shrunk by the nearest pixel, and enlarged linearly."""

    def change(picture: np.ndarray) -> np.ndarray:
        rows, columns = picture.shape[:2]
        small = resized(picture, columns // n, rows // n, nearest=True)
        return resized(small, columns, rows, nearest=False)

    label = f"1/{n} of the size, nearest, and back linearly"
    return Fault("resampled", label, afterwards(change), {"n": n})


PICTURE_FAULTS = (
    Fault("rows", "from the top", afterwards(np.flipud)),
    Fault("row_off", "one down", afterwards(lambda p: np.roll(p, 1, axis=0))),
    Fault("row_off", "one up", afterwards(lambda p: np.roll(p, -1, axis=0))),
    Fault("row_off", "one to the left", afterwards(lambda p: np.roll(p, -1, axis=1))),
    Fault("picture_turned", "by 180 degrees", afterwards(lambda p: p[::-1, ::-1])),
    colors("exposure", "+0.6 stops", lambda c: c * 2**0.6, stops=0.6),
    colors("exposure", "-0.15 stops", lambda c: c * 2**-0.15, stops=-0.15),
    colors("gamma", "1.6", lambda c: c ** (1 / 1.6), gamma=1.6),
    colors("gamma", "0.9", lambda c: c ** (1 / 0.9), gamma=0.9),
    colors("channels", "blue and red swapped", lambda c: c[..., ::-1]),
    Fault("premultiplied", "alpha divided out", smooth(_divided), only=(2,)),
    Fault("premultiplied", "alpha multiplied in twice", smooth(_again), only=(2,)),
    colors("srgb_for_linear", "the curve applied once more", encoded),
    colors("srgb_for_linear", "the curve left out", decoded),
    colors(
        "srgb_for_linear", "the curve applied once more, in 8 bits", lambda c: eight(encoded(c))
    ),
    colors("srgb_for_linear", "the curve left out, in 8 bits", lambda c: eight(c, decoded)),
    colors("power_for_srgb", "of 8 bits", lambda c: eight(c ** (1 / 2.2), decoded)),
    colors(
        "power_for_srgb",
        "of 8 bits, rounded before",
        lambda c: eight(eight(encoded(c), decoded) ** (1 / 2.2), decoded),
    ),
    colors("rounding_level", "of linear values", eight),
    colors("rounding_level", "of 5, 6 and 5 bits", _few_bits),
    in_file("resampled", "hues at half the size", of_straight(_half_chroma)),
    enlarged(2),
    saturated(1.25, coded=False),
    saturated(0.6, coded=True),
    colors("white_balance", "warmer", lambda c: c * (1.12, 1.0, 0.85)),
    colors("rounding_level", "once, read as floats", lambda c: eight(encoded(c), decoded)),
    in_file("dithered", "2 levels", _noisy, levels=2),
    in_file("rounding_level", "cut off", lambda p: through_file(p, np.floor)),
    jpeg(92),
    jpeg(75),
    resampled(0.5, nearest=True),
    resampled(0.5, nearest=False),
    filtered(0.5),
    filtered(1.5, gauss=True),
    shrunk(2, nearest=True),
    shrunk(2, nearest=False),
    supersampled(2),
    supersampled(4),
    supersampled(2, coded=True),
)

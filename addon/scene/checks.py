"""Checks what a scene is made of, and stores it read-only."""

from __future__ import annotations

import numpy as np

from ..arrays import Array, Colors, Floats, Integers


class SceneError(ValueError):
    """The scene cannot be traced; the message names the thing and what to do about it."""


def store(instance: object, name: str, value: object) -> None:
    """Set a field of a frozen dataclass, while it is made."""
    object.__setattr__(instance, name, value)


def shaped(array: Array, shape: tuple[int, ...], what: str) -> Array:
    """Return an array of this shape, read-only."""
    if array.shape != shape:
        raise SceneError(f"{what} must have the shape {shape}, not {array.shape}.")
    if array.flags.writeable:
        array = array.view()
        array.flags.writeable = False
    return array


def finite(value: object, shape: tuple[int, ...], what: str) -> Floats:
    """Return a copy in float64 of this shape, read-only; its numbers must be finite."""
    array = shaped(np.array(value, np.float64), shape, what)
    if not np.isfinite(array).all():
        raise SceneError(f"{what} must be finite numbers.")
    return array


def indices(array: Array, shape: tuple[int, ...], end: int, what: str) -> Integers:
    """Return integers from 0 to below `end` as int32, of this shape, read-only."""
    if array.size:
        if array.dtype.kind not in "iu":
            raise SceneError(f"{what} must be integers, not {array.dtype}.")
        if array.min() < 0 or array.max() >= end:
            raise SceneError(f"{what} must be at least 0 and below {end}.")
    return shaped(array.astype(np.int32, copy=False), shape, what)


def colors(value: object, what: str) -> Colors:
    """Return a copy of one linear RGBA or more, (k, 4), read-only."""
    colors = np.array(value, np.float32, ndmin=1)
    return shaped(colors, (max(1, len(colors)), 4), f"The linear RGBA of {what}")

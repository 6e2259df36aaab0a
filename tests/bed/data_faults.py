"""Faults of data in place of colours: depths along the view axis, and objects' ids."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from .description import Description
from .making import Fault, Made, once

Change = Callable[[np.ndarray], np.ndarray]  # of values (h, w, 1)


def held(key: str, label: str, holds: str, change: Change) -> Fault:
    """Return a fault that changes finished data."""

    def make(_: Description, made: Made) -> Made:
        return replace(made, holds=holds, after=change)

    return Fault(key, label, make, only=(1, 2, 4, 5, 6))


def normalised(depth: np.ndarray) -> np.ndarray:
    """Return depths as shares of a range beyond that of what is seen."""
    seen = depth[np.isfinite(depth)]
    return (depth - 0.8 * seen.min()) / (1.1 * seen.max() - 0.8 * seen.min())


def by_columns(values: np.ndarray) -> np.ndarray:
    """Return values that were stored column by column, read row by row."""
    return values.ravel(order="F").reshape(values.shape)


def exchanged(ids: np.ndarray) -> np.ndarray:
    """Return ids in which the two objects with the most pixels have one another's."""
    every, count = np.unique(ids[ids > 0], return_counts=True)
    first, second = every[np.argsort(-count)[:2]]
    return np.where(ids == first, second, np.where(ids == second, first, ids))


def _mixed(_: Description, made: Made) -> Made:
    """Return ids that were smoothed at edges, as colours are: the mean of 2 x 2 samples."""
    n, own = 2, made.camera
    size = {"width": n * own.width, "height": n * own.height}
    many = replace(made, holds="ids", camera=replace(own, k=np.diag((n, n, 1.0)) @ own.k, **size))

    def draw(_: Made) -> np.ndarray:
        ids = once(many).reshape(own.height, n, own.width, n, 1)
        return np.rint(ids.mean(axis=(1, 3)))

    return replace(made, holds="ids", draw=draw)


DATA_FAULTS = (
    held("depth_normalised", "plain", "depth", normalised),
    held("depth_normalised", "reversed", "depth", lambda d: 1 - normalised(d)),
    held("background_value", "80 m", "depth", lambda d: np.minimum(d, 80.0)),
    held("column_order", "depths", "depth", by_columns),
    held("column_order", "ids", "ids", by_columns),
    held("id_exchanged", "", "ids", exchanged),
    Fault("id_mixed", "", _mixed, only=(1, 2, 4, 5, 6)),
)

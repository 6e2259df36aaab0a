"""Depths: how far the first surface lies along the view axis, or along the ray, in metres."""

from __future__ import annotations

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.tracer.vector import dot

from .kind import Kind
from .seen import Seen


def ray_length(seen: Seen) -> Floats:
    """Return the length of each ray's direction, by which its t is a distance, (n,)."""
    d = np.broadcast_to(seen.rays.directions, (3, len(seen.t)))
    return np.asarray(np.sqrt(dot(d, d)))


def depth(seen: Seen) -> Floats:
    """Return depths along the view axis, (n, 1): t, as directions are one unit deep."""
    return seen.t[:, None]


def distance(seen: Seen) -> Floats:
    """Return distances along the rays, from where they begin, (n, 1)."""
    return (seen.t * ray_length(seen))[:, None]


# Where nothing is hit, files have 0, -1, an infinity, the largest integer, or Blender's 1e10.
EMPTY = (0.0, -1.0)
DEPTH = Kind(
    "depth",
    "depths along the view axis",
    1,
    depth,
    ("depth", "z", "t"),
    "m",
    empty=EMPTY,
)
DISTANCE = Kind(
    "distance",
    "distances along the ray",
    1,
    distance,
    ("distance", "depth", "z"),
    "m",
    empty=EMPTY,
)

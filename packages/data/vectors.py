"""Normals and positions, in world or camera space; normals also as colours from 0 to 1."""

from __future__ import annotations

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.pictures.bounds import U32, corner_errors
from reference_tracer.tracer.vector import cross, dot
from reference_tracer.tracer.world import world_corners

from .kind import Kind
from .seen import Seen

SPACES = ("world", "camera")
RANGES = ("signed", "unit")  # -1 to 1, or 0 to 1 as colours are
# The roundings of a float32 normal: differences (2), the cross product (3), its length (4).
_NORMAL = 9 * U32
_POSITION = 4 * U32  # of o + t d: the product, the sum, and the change to camera space


def _normal_error(seen: Seen) -> Floats:
    """Return by what angle float32 may turn normals, (n,) radians.

    A triangle turns by the error of its corners over its height.
    """
    out = np.full(len(seen.t), _NORMAL)
    own = np.flatnonzero(seen.instance < len(seen.scene.instances))
    moved = corner_errors(seen.scene, seen.hits, seen.positions, lambda e, s: e.max(axis=0))
    p1, p2, p3 = world_corners(seen.scene, seen.instance[own], seen.triangle[own])
    normal = cross(p2 - p1, p3 - p1)
    area = np.sqrt(dot(normal, normal))
    longest = np.sqrt(np.max([dot(e, e) for e in (p2 - p1, p3 - p2, p1 - p3)], axis=0))
    with np.errstate(divide="ignore", invalid="ignore"):
        out[own] += 2 * moved[own] * longest / area
    return out


def normals(space: str, range_: str) -> Kind:
    """Return the kind of geometric unit normals in a space of SPACES, in a range of RANGES."""

    def made(seen: Seen) -> Floats:
        out = seen.normals
        if space == "camera":
            out = seen.in_camera(out, from_origin=False)
        return out / 2 + 0.5 if range_ == "unit" else out

    return Kind(
        "normals",
        "normals",
        3,
        made,
        ("normal", "normals", "n", "nn"),
        follows_t=False,
        loose=_normal_error,
        empty=(0.0, 0.5),  # neither, nor what it is stored as, is of unit length
        space=space,
        range=range_,
    )


def _position_error(seen: Seen) -> Floats:
    size = np.abs(seen.positions).sum(axis=1) + 2 * np.abs(seen.scene.camera.origin).sum()
    return np.asarray(_POSITION * size, np.float64)


def positions(space: str) -> Kind:
    """Return the kind of positions in a space of SPACES, in metres."""

    def made(seen: Seen) -> Floats:
        world = seen.positions
        return world if space == "world" else seen.in_camera(world, from_origin=True)

    return Kind(
        "positions",
        "positions",
        3,
        made,
        ("position", "positions", "p", "world"),
        "m",
        loose=_position_error,
        space=space,
    )

"""What a ray sees, decided with Python's whole numbers: no rounding anywhere.

Every float is a whole number times a power of two. Scaled by one power for the whole scene, rays
and vertices become integers, and the signs that decide a hit are exact. Plain and slow: about ten
microseconds a pair, for pictures small enough to judge every pair.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..tracer.camera import camera_rays
from ..tracer.progress import result_of
from ..tracer.render import tiles
from ..tracer.settings import Settings
from ..tracer.visibility import NOTHING, candidates, film_positions, plan

MOST_PAIRS = 2_000_000  # half a minute


class TooLargeError(ValueError):
    """The picture has more pairs than whole numbers can judge in reasonable time."""


def judge(scene: Scene) -> Iterator[list[set[tuple[int, int]]]]:
    """Yield what may be seen through the centres of the pixels, tile by tile from the lowest row.

    For each pixel that is a set of (instance, triangle), (NOTHING, NOTHING) for nothing. It has
    more than one member where the ray meets an edge or an exact tie: there the textbook leaves the
    answer open.

    Infinite planes are judged by the same means.

    Raises
    ------
    TooLargeError
        If there are more than MOST_PAIRS pairs.
    """
    made = result_of(plan(scene, Settings(), reach=0.0))
    tested = 0
    for tile in tiles(scene.camera):
        count = tile.width * tile.height
        rays = camera_rays(scene.camera, *film_positions(tile, 0.0, 0.0))
        origins, directions = (
            np.broadcast_to(v, (3, count)).T for v in (rays.origins, rays.directions)
        )
        hits: list[list] = [[] for _ in range(count)]
        for index, plane in enumerate(scene.planes):
            name = (len(scene.instances) + index, NOTHING)
            for pixel in range(count):
                t = _plane(origins[pixel], directions[pixel], plane.point, plane.normal)
                if t is not None:
                    hits[pixel].append((t, False, name))
        for _, some in candidates(made, tile):
            if some is None:
                continue
            tested += len(some.pixel)
            if tested > MOST_PAIRS:
                raise TooLargeError(
                    f"more than {MOST_PAIRS:,} pairs of a pixel and a triangle to judge: "
                    "choose a smaller --width"
                )
            for k, pixel in enumerate(some.pixel):
                found = _triangle(origins[pixel], directions[pixel], some.corners[:, :, k])
                if found is not None:
                    hits[pixel].append((*found, (int(some.instance[k]), int(some.triangle[k]))))
        yield [_nearest(found, scene.camera.clip_start, scene.camera.clip_end) for found in hits]


def _nearest(hits: list, clip_start: float, clip_end: float) -> set[tuple[int, int]]:
    inside = [h for h in hits if clip_start <= h[0] <= clip_end]  # a Fraction compares exactly
    sure = min((t for t, at_edge, _ in inside if not at_edge), default=None)
    if sure is None:
        return {name for _, _, name in inside} | {(NOTHING, NOTHING)}
    return {name for t, at_edge, name in inside if t == sure or (at_edge and t < sure)}


def integers(*vectors: NDArray[np.float64]) -> tuple[list[list[int]], int]:
    """Return vectors of floats as integers and an exponent e: each float is integer * 2^e."""
    mantissa, exponent = np.frexp(np.stack(vectors))
    whole = (mantissa * 2.0**53).astype(np.int64)
    least = int(exponent.min())
    shifted = [
        [int(m) << int(e) for m, e in zip(row, by, strict=True)]
        for row, by in zip(whole, exponent - least, strict=True)
    ]
    return shifted, least - 53


def _triangle(o, d, corners) -> tuple[Fraction, bool] | None:
    """Return t and whether the ray meets the triangle on its edge; None where it misses."""
    (origin, *points), lengths = integers(o, *corners)
    (direction,), scale = integers(d)  # a scale of its own: it cancels out of every sign
    a, b, c = (_sub(p, origin) for p in points)
    edges = [_dot(direction, _cross(p, _sub(q, p))) for p, q in ((a, b), (b, c), (c, a))]
    if min(edges) < 0 < max(edges):
        return None
    n = _cross(_sub(b, a), _sub(c, a))
    towards = _dot(direction, n)
    if towards == 0:
        return None
    return Fraction(_dot(a, n), towards) * Fraction(2) ** (lengths - scale), 0 in edges


def _plane(o, d, point, normal) -> Fraction | None:
    """Return t, or None where the ray is parallel."""
    (origin, p), lengths = integers(o, point)
    ((n,), _), ((direction,), scale) = integers(normal), integers(d)
    towards = _dot(direction, n)
    if towards == 0:
        return None
    return Fraction(_dot(_sub(p, origin), n), towards) * Fraction(2) ** (lengths - scale)


def _sub(a: list[int], b: list[int]) -> list[int]:
    return [x - y for x, y in zip(a, b, strict=True)]


def _dot(a: list[int], b: list[int]) -> int:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: list[int], b: list[int]) -> list[int]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

"""Finds the triangles that may cover a pixel's sample, and those that surely do.

The sample may lie off its centre, as a rasteriser rounds each triangle's corners by themselves. So
a sliver of a thousandth of a pixel may be drawn although it lies between any samples that one could
try; and where a triangle was clipped, a crack may open along an edge that it shared. Therefore the
triangles themselves are looked at.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...arrays import Array, Bools, Floats, Index
from ...tracer import plane, shading
from ...tracer.camera import film_beside
from ...tracer.hits import NOTHING, Hits
from ...tracer.nearest import test_pairs, test_planes
from ...tracer.progress import Work
from ...tracer.world import Pairs
from .plans import SOUND
from .probe import Probe

# An aimed ray goes this share of the way to the triangle's middle, so that it does not pass the
# rim; in a large triangle less, so that it stays within the band.
INWARD = 2.0**-20

# A sample can only miss a triangle near its edge if the triangle is higher than this, in widths of
# the band. Otherwise every triangle of a fine mesh, or of a fan of needles, would be near its edge,
# and a fault could hide behind that. (The samples around the centre see that a sliver was missed.)
LEAST_HEIGHT = 16


class Coverage(NamedTuple):
    """The k triangles that may cover some of n pixels, with what they would show there."""

    pixel: Index  # (k,) of the n
    distance: Floats  # (k,) pixels, from the centre to the triangle's nearest point
    hits: Hits  # k: of each triangle at this point
    sure: Hits  # n: the nearest hits that Blender's sample cannot miss
    behind: Floats  # (k,) depth of the sure surface where each of `hits` is


def coverage(probe: Probe, band: Floats) -> Work[Coverage]:
    """Find the triangles that may cover samples within `band` (n,) pixels of the centres."""
    sure = Hits.none(len(band))
    centres = probe.rays()
    test_planes(probe.scene, centres, sure)
    none = np.zeros(0, int), np.zeros(0), np.zeros((2, 0)), Hits.none(0)
    found: list[tuple[Index, Floats, Floats, Hits]] = [none]
    for some in probe.chunks:
        corners = _around_centre(probe, some)
        nearest, rim = nearest_to_origin(corners)
        own = band[some.pixel]
        with np.errstate(invalid="ignore"):
            certain = (rim > own) | np.isnan(rim) | _thin(corners, own)
            near = np.flatnonzero(np.abs(nearest).max(axis=0) <= own)
        test_pairs(probe.scene, SOUND, centres, some.take(np.flatnonzero(certain)), sure)
        yield None
        middle = corners[..., near].mean(axis=0)
        found.append(_aim(probe, some.take(near), nearest[:, near], middle, own[near]))
        yield None
    pixels, distances, offsets, hits = zip(*found, strict=True)
    pixel, offset = np.concatenate(pixels), np.concatenate(offsets, axis=1)
    depth = _depth_of(sure, probe, pixel, offset)
    return Coverage(pixel, np.concatenate(distances), Hits.joined(hits), sure, depth)


def _around_centre(probe: Probe, some: Pairs) -> Floats:
    """Return corners on the film, (3, 2, p) pixels from the pixel's centre; NaN behind the eye."""
    out = np.empty((3, 2, len(some.pixel)))
    for corner, place in zip(some.corners, out, strict=True):
        px, py = probe.px[some.pixel], probe.py[some.pixel]
        place[:] = film_beside(probe.scene.camera, corner.astype(np.float64), px, py)
    return out


def _thin(corners: Floats, band: Floats) -> Bools:
    """Return which triangles (3, 2, p) are so thin that rounding near an edge may miss them."""
    edges = corners - np.roll(corners, 1, axis=0)
    longest = np.hypot(edges[:, 0], edges[:, 1]).max(axis=0)
    ux, uy = corners[1] - corners[0]
    vx, vy = corners[2] - corners[0]
    area = np.abs(ux * vy - uy * vx)  # twice the triangle's
    return area < LEAST_HEIGHT * band * longest


def _aim(
    probe: Probe, some: Pairs, nearest: Floats, middle: Floats, band: Floats
) -> tuple[Index, Floats, Floats, Hits]:
    """Trace a ray to the nearest point (2, p) of each of p triangles.

    Return, of the k that are hit, the pixel, how far from its centre, the ray's offset (2, k), and
    the hits.
    """
    inward = middle - nearest
    share = np.minimum(INWARD, band / 64 / np.maximum(np.hypot(*inward), 1e-300))
    x, y = offset = nearest + share * inward
    hits = Hits.none(len(some.pixel))
    own = replace(some, pixel=np.arange(len(hits)))  # a ray for each triangle
    test_pairs(probe.scene, SOUND, probe.rays(x, y, some.pixel), own, hits)
    there = np.flatnonzero(hits.instance != NOTHING)
    distance = np.abs(nearest[:, there]).max(axis=0)
    return some.pixel[there], distance, offset[:, there], hits.take(there)


def _depth_of(sure: Hits, probe: Probe, pixel: Index, offset: Floats) -> Floats:
    """Return the depth of k pixels' sure surfaces at an offset (2, k) from their centres.

    A surface seen at a slant is nearer on one side of the pixel than on the other.
    """
    own = sure.take(pixel)
    points, normals = probe.points(sure)[pixel].T, shading.normals(probe.scene, own).T
    x, y = offset
    there = plane.intersect(probe.rays(x, y, pixel), points, normals)
    depth = np.where(own.instance != NOTHING, there, np.inf)
    return np.where(np.isnan(depth), own.t, depth)


def nearest_to_origin(corners: Array) -> tuple[Array, Array]:
    """Return the point of each triangle (3, 2, n) that lies nearest to the origin.

    Returns
    -------
    point : (2, n) float64
    rim : (n,) float64
        Distance of the origin from the triangle's edges; negative where it lies outside. NaN where
        a corner is.
    """
    ends = np.roll(corners, -1, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        edges = ends - corners
        length = (edges * edges).sum(axis=1)
        along = np.where(length > 0, -(corners * edges).sum(axis=1) / length, 0.0)
        points = corners + np.clip(along, 0, 1)[:, None] * edges
        square = np.nan_to_num((points * points).sum(axis=1), nan=np.inf, posinf=np.inf)
        sides = corners[:, 0] * ends[:, 1] - corners[:, 1] * ends[:, 0]
        inside = (np.min(sides, axis=0) > 0) | (np.max(sides, axis=0) < 0)
    best, nearest = square.min(axis=0), square.argmin(axis=0)
    point = np.nan_to_num(np.take_along_axis(points, nearest[None, None], axis=0)[0])
    unknown = np.isnan(corners).any(axis=(0, 1))
    rim = np.sqrt(best) * np.where(inside, 1, -1)
    return np.where(unknown, np.nan, np.where(inside, 0.0, point)), np.where(unknown, np.nan, rim)

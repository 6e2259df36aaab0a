"""Which triangles may cover a pixel's sample, and which surely do, if that sample may lie off.

A rasteriser rounds each triangle's corners on its own. A sliver of a thousandth of a pixel lies
between any samples that one could try, and is drawn all the same; and where a triangle has been
clipped, a crack may open along an edge that it shared. So the triangles themselves are asked.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...tracer import plane, shading
from ...tracer.camera import camera_rays, film_beside
from ...tracer.hits import NOTHING
from ...tracer.nearest import Hits, Pairs, test_pairs, test_planes, within_clip
from ...tracer.progress import Work
from ...tracer.triangle import TESTS
from .probe import Probe

# An aimed ray goes this share of the way to the triangle's middle, so that it does not pass the
# rim; in a large triangle less, so that it stays within the band.
INWARD = 2.0**-20

# A triangle is only taken to have been missed near its edge where it is higher than this, in widths
# of the band. Else every triangle of a fine mesh, or of a fan of needles, would be near its edge,
# and a fault could hide behind that. (That a sliver was missed is seen by the samples around it.)
LEAST_HEIGHT = 16


class Coverage(NamedTuple):
    """What k triangles that may cover one of n pixels would show there.

    `hits` are theirs, each where the triangle comes nearest to the centre, at `distance` (k,)
    pixels; `pixel` (k,) says of which pixel. `sure` are the n nearest hits that Blender's sample
    cannot miss.
    """

    pixel: NDArray[np.integer]
    distance: NDArray[np.float64]
    hits: Hits
    sure: Hits
    behind: NDArray[np.float64]  # (k,) depth of the sure surface where each of `hits` is


def coverage(probe: Probe, band: NDArray[np.float64]) -> Work[Coverage]:
    """Return what may cover the pixels of a probe, whose samples lie within `band` (n,) pixels."""
    scene, settings = probe.plan.scene, probe.plan.settings
    dtype = settings.precision.dtype
    sure = Hits.none(len(band))
    centres = camera_rays(scene.camera, probe.px, probe.py, dtype)
    test_planes(scene, centres, sure)
    found = []
    for some in probe.chunks:
        corners = _around_centre(probe, some)
        nearest, rim = nearest_to_origin(*corners)
        own = band[some.pixel]
        longest = np.max([np.hypot(*(corners[i] - corners[i - 1])) for i in range(3)], axis=0)
        (ux, uy), (vx, vy) = corners[1] - corners[0], corners[2] - corners[0]
        with np.errstate(invalid="ignore"):
            thin = np.abs(ux * vy - uy * vx) < LEAST_HEIGHT * own * longest  # its least height is
            certain = np.flatnonzero((rim > own) | thin | np.isnan(rim))
            near = np.flatnonzero(np.abs(nearest).max(axis=0) <= own)
        test_pairs(scene, settings, centres, some.take(certain), sure)
        inward = sum(corners)[:, near] / 3 - nearest[:, near]
        share = np.minimum(INWARD, own[near] / 64 / np.maximum(np.hypot(*inward), 1e-300))
        x, y = nearest[:, near] + share * inward
        pixel = some.pixel[near]
        rays = camera_rays(scene.camera, probe.px[pixel] + x, probe.py[pixel] + y, dtype)
        hit, t, s = TESTS[settings.method](rays, *some.corners[..., near])
        hit = np.flatnonzero(hit & within_clip(scene.camera, t))
        of, offset = some.take(near[hit]), np.stack((x, y))[:, hit]
        distance = np.abs(nearest[:, near[hit]]).max(axis=0)
        found.append((of.pixel, distance, offset, t[hit], of.instance, of.triangle, s[:, hit]))
        yield 0.0
    if not found:
        return Coverage(np.zeros(0, int), np.zeros(0), Hits.none(0), sure, np.zeros(0))
    pixel, distance, offset, t, instance, triangle, s = (
        np.concatenate(c, axis=-1) for c in zip(*found, strict=True)
    )
    # A surface seen at a slant is nearer on one side of the pixel than on the other.
    own = sure.take(pixel)
    rays = camera_rays(scene.camera, probe.px[pixel] + offset[0], probe.py[pixel] + offset[1])
    points, normals = probe.points(sure)[pixel].T, shading.normals(scene, own).T
    behind = np.where(own.instance != NOTHING, plane.intersect(rays, points, normals), np.inf)
    behind = np.where(np.isnan(behind), own.t, behind)
    return Coverage(pixel, distance, Hits.of(t, instance, triangle, s), sure, behind)


def _around_centre(probe: Probe, some: Pairs) -> list[NDArray[np.float64]]:
    """Corners on the film, each (2, p) pixels from the pixel's centre; NaN behind the eye."""
    out = []
    for corner in some.corners:
        px, py = probe.px[some.pixel], probe.py[some.pixel]
        out.append(film_beside(probe.plan.scene.camera, corner.astype(np.float64), px, py))
    return out


def nearest_to_origin(a: NDArray, b: NDArray, c: NDArray) -> tuple[NDArray, NDArray]:
    """Return the point of each triangle (a, b, c), (2, n) each, that lies nearest to the origin.

    Returns
    -------
    point : (2, n) float64
    rim : (n,) float64
        Distance of the origin from the triangle's edges; negative where it lies outside. NaN where
        a corner is.
    """
    best, best_square = np.zeros_like(a), np.full(a.shape[1], np.inf)
    sides = []
    with np.errstate(divide="ignore", invalid="ignore"):
        for p, q in ((a, b), (b, c), (c, a)):
            edge = q - p
            length = (edge * edge).sum(axis=0)
            along = np.where(length > 0, -(p * edge).sum(axis=0) / length, 0.0)
            point = p + np.clip(along, 0, 1) * edge
            square = (point * point).sum(axis=0)
            nearer = square < best_square
            best = np.where(nearer, point, best)
            best_square = np.where(nearer, square, best_square)
            sides.append(p[0] * q[1] - p[1] * q[0])
        inside = (np.min(sides, axis=0) > 0) | (np.max(sides, axis=0) < 0)
    unknown = np.isnan(a + b + c).any(axis=0)
    rim = np.sqrt(best_square) * np.where(inside, 1, -1)
    return np.where(unknown, np.nan, np.where(inside, 0.0, best)), np.where(unknown, np.nan, rim)

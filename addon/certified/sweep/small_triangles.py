"""Culls triangles that cover no pixel's centre, where there are many, before they are expanded.

A dense instance has more triangles than pixels. A triangle is culled if its box on the film,
widened by all errors, contains the centre of no pixel of the region; or if it contains one, which
surely lies outside the triangle: one edge function is surely positive there, another one surely
negative. The tighter bounds of `small_boxes.py` and `edge_functions.py` would leave it out, too, so
culling changes no result.

The film position of a vertex v of an instance is (p / w, q / w), where (p, q, w) = A v, with a
matrix A (3, 4) for each instance. In float32 they are off by at most 8 2^-24 S, S = |A| |v|: by the
roundings of A, v, their product and three sums. Where that is less than a sixteenth of w, which is
at least W in the instance's box, p / w is off by at most

    9 2^-24 (1 + S_w / W) S_p / W + 2^-21 S_p / W + 2^-22

with the roundings of 1 / w, of the product and of two sums. The errors of float64, in A, in the
vertices and in the box itself, are bounded by `place` and `weight` of `film.py`. With all of this
at most m, both coordinates of a corner that is seen from the one pixel of a box are less than 1 + m
and off by at most m: an edge function there by 4 m (1 + m) + 2 m^2, and 2^-20 for its roundings.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from typing import NamedTuple

import numpy as np

from ...arrays import Colors, Floats, Index, Integers
from ...scene import Mesh, Region
from ...tracer.camera import pixel_size
from ...tracer.vector import gather, largest, occurring, parts
from .film import Film

_PER_PIXEL = 2  # an instance with more triangles per pixel of its box is dense
_TRIANGLES = 1 << 14  # triangles at a time: their temporaries stay in a core's cache
_ROUNDING = 2.0**-24  # the relative error of one rounding in float32
_RANGE = 2.0**40  # no factor, sum or 1 / w is larger: far from where float32 loses digits
_FARTHEST = 1 << 20  # pixels: film positions are nearer
_MARGIN = 0.25  # pixels: instances with a wider margin are not dense


class Visible(NamedTuple):
    """Triangles of k instances of a mesh that may cover a pixel."""

    instances: Integers  # (k,)
    counts: Index  # (k,) how many triangles of each
    corners: Integers  # (3, m) which of `used` their vertices are
    # (v,) those vertices: the number in the mesh, plus the mesh's number of vertices for each
    # instance before.
    used: Index
    triangle: Integers  # (m,) their numbers in the mesh, instance by instance


class SmallTriangles:
    """Instances, or clusters of their triangles, on a camera's film, in float32.

    Parameters
    ----------
    film : Film
    region : Region
        The pixels that are traced.
    bounds : (2, 3, n) float64
        Lowest and highest coordinates of each, in object space.
    matrices : (4, 4, n) float64
        world_from_object of each.
    counts : (n,) int
        The triangles of each.
    area : (n,) float64
        The area of the boxes on the film, in pixels.
    """

    def __init__(
        self,
        film: Film,
        region: Region,
        bounds: Floats,
        matrices: Floats,
        counts: Index,
        area: Floats,
    ) -> None:
        camera = film.camera
        self._region = region
        low, high = bounds
        reach = np.concatenate((np.maximum(np.abs(low), np.abs(high)), np.ones((1, len(counts)))))
        columns = matrices[:3].copy()  # (3, 4, n): v enters as (x, y, z, 1)
        size = 1.01 * ((np.abs(columns) * reach).sum(axis=1) + np.abs(camera.origin[:, None]))
        columns[:, 3] -= camera.origin[:, None]
        right, up, w = (
            d[0] * columns[0] + d[1] * columns[1] + d[2] * columns[2] for d in film.dual
        )
        if camera.projection.shares_direction:
            w = np.zeros_like(right)
            w[3] = 1
        window = camera.window
        width, height = pixel_size(camera)
        x = (right - window.left * w) / width - film.dx * w
        y = (up - window.bottom * w) / height - film.dy * w
        self._matrices = np.stack((x, y, w)).astype(np.float32)
        sums = np.abs((x, y, w) * reach).sum(axis=1)
        least = w[3] + np.minimum(w[:3] * low, w[:3] * high).sum(axis=0)
        constant, slope = film.place
        far = max(camera.width, camera.height)
        size = size.max(axis=0)
        own = constant + (slope + 2 * far * film.weight) * size
        most = np.maximum(sums[0], sums[1]) / least
        self._margin = margin = (
            (9 * _ROUNDING * (1 + sums[2] / least) + 2.0**-21) * most + 2.0**-22 + 4 * own / least
        )
        # All vertices are finite, and far in front of the eye, as `Vertices.ahead` asks.
        known = (margin < _MARGIN) & (least > 2.0**11 * film.weight * size)
        known &= (least > 200 * _ROUNDING * sums[2]) & (least > 1 / _RANGE)
        known &= largest(*sums, *reach, *np.abs(self._matrices).reshape(12, -1)) < _RANGE
        known &= largest(most, np.full_like(most, far)) < _FARTHEST
        self.is_dense = known & (counts > _PER_PIXEL * area)

    def within(self, mesh: Mesh, members: Integers) -> Iterator[Visible | None]:
        """Find the triangles of instances `members` of a mesh that may cover a pixel.

        Yields those of some instances and triangles at a time, and None after each step in between.
        """
        count = len(mesh.vertices)
        vertices = mesh.vertices.T.astype(np.float32, order="C")
        places = []
        for part in parts(len(mesh.triangles), _TRIANGLES):
            corners = mesh.triangles[part].T.astype(np.intp)
            places.append([gather(vertices, corner) for corner in corners])
            yield None
        together = max(1, _TRIANGLES // len(mesh.triangles))
        for some in (members[group] for group in parts(len(members), together)):
            found = []
            for number, own in enumerate(places):
                copy, triangle = np.divmod(self._inside(own, some), own[0].shape[1])
                found.append((copy, triangle + number * _TRIANGLES))
                yield None
            copy, triangle = np.concatenate(found, axis=1)
            at = mesh.triangles.take(triangle, axis=0).T + copy * count
            used, at = occurring(at, len(some) * count)
            counts = np.bincount(copy, minlength=len(some))
            yield Visible(some, counts, at, used, triangle.astype(np.int32))

    def among(self, places: list[Colors], members: Index) -> Index:
        """Return which triangles of members with one matrix may cover a pixel, (c,).

        Given their three corners in object space, (3, m) each.
        """
        return self._inside(places, members[np.argmax(self._margin[members])][None])

    def _inside(self, places: list[Colors], members: Index) -> Index:
        """Return which of m triangles may cover a pixel, counted through all k members.

        `places` are the three corners of each in object space, (3, m).
        """
        count = len(members)
        rows = self._matrices[..., members].transpose(0, 2, 1)  # (3, k, 4)
        factors = rows[..., :3].reshape(3 * count, 3)
        margin = np.float32(1.001 * self._margin[members].max())
        across = []
        upwards = []
        for place in places:
            film = (factors @ place).reshape(3, count, -1)  # the bound holds in any order
            film += rows[..., 3:]
            np.divide(np.float32(1), film[2], out=film[2])
            film[:2] *= film[2]
            film[:2] -= np.float32(0.5)
            across.append(film[0].ravel())
            upwards.append(film[1].ravel())
        region = self._region
        first_x, last_x = _ends(across, margin, region.x0, region.x1)
        first_y, last_y = _ends(upwards, margin, region.y0, region.y1)
        found = np.flatnonzero((first_x <= last_x) & (first_y <= last_y))
        x, y = (gather(first, found) for first in (first_x, first_y))
        one = (x == gather(last_x, found)) & (y == gather(last_y, found))
        # At the region's edge, which cuts boxes off, corners may be farther away.
        one &= (x > region.x0) & (x < region.x1 - 1) & (y > region.y0) & (y < region.y1 - 1)
        a, b, c = (
            (gather(p, found) - x, gather(q, found) - y)
            for p, q in zip(across, upwards, strict=True)
        )
        edges = [p[0] * q[1] - p[1] * q[0] for p, q in ((a, b), (b, c), (c, a))]
        error = np.float32(1.001 * (4 * margin * (1 + margin) + 2 * margin**2 + 2.0**-20))
        outside = (reduce(np.minimum, edges) < -error) & (largest(*edges) > error)
        return gather(found, np.flatnonzero(~(one & outside)))


def _ends(at: list[Floats], margin: np.float32, start: int, end: int) -> tuple[Floats, Floats]:
    """Return the first and the last pixel, start <= pixel < end, between three corners, (m,)."""
    first = reduce(np.minimum, at)
    first -= margin
    last = largest(*at)
    last += margin
    np.ceil(first, out=first)
    np.floor(last, out=last)
    return np.maximum(first, np.float32(start), out=first), np.minimum(
        last, np.float32(end - 1), out=last
    )

"""Small-triangle culling: which triangles of dense instances can cover the centre of a pixel.

In come instances with about as many triangles as pixels, or more; out come those triangles whose
box on the film, widened by all errors, holds the centre of a pixel of the region. Only they are
expanded. What is left out is what `boxes_of` would leave out: so nothing else changes.

The film position of a vertex v of an instance is (p / w, q / w), where p, q, w are A v, with a
matrix A (3, 4) for each instance. In float32 they are off by at most 8 2^-24 S, S = |A| |v|: by the
roundings of A, v, their product and three sums. Where that is less than a sixteenth of w, which is
at least W in the instance's box, p / w is off by at most

    9 2^-24 (1 + S_w / W) S_p / W + 2^-21 S_p / W + 2^-8

with the roundings of 1 / w and the product, and two of what is added, which is less than 2^15. The
errors of float64 are those which `place` and `weight` of `film.py` bound: of A, of the vertices,
and of the box itself.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...scene import Mesh, Region, Scene
from ...tracer.camera import pixel_size
from ...tracer.vector import Floats, Index, gather, largest, occurring, parts
from .film import Film

_PER_PIXEL = 2  # triangles for a pixel of an instance's box: from there on it is dense
_VERTICES = 1 << 14  # at a time: their temporaries stay in a core's cache
_TRIANGLES = 1 << 15  # at a time
_ROUNDING = 2.0**-24
_RANGE = 2.0**40  # of all factors and sums, and of 1 / w: far from where float32 loses digits
_FARTHEST = 1 << 14  # pixels, added to numbers that are less: the sum of two fills 16 bits
_BOTH = np.uint32(0x80008000)  # the highest bits of two of them
_MARGIN = 0.25  # pixels: where it would be more, nothing is left out


class SmallTriangles:
    """Instances as a camera's film shows them, in float32.

    Parameters
    ----------
    region : Region
        The pixels that count.
    area : (n,) float64
        Of the instances' boxes, in pixels.
    """

    def __init__(self, scene: Scene, film: Film, region: Region, area: Floats) -> None:
        camera, of = film.camera, scene.instance_meshes
        self._scene, self._region = scene, region
        low, high = np.array([m.bounds for m in scene.meshes])[of].transpose(1, 2, 0)
        reach = np.concatenate((np.maximum(np.abs(low), np.abs(high)), np.ones((1, len(of)))))
        columns = scene.instance_matrices[:3].copy()  # (3, 4, n): v enters as (x, y, z, 1)
        size = 1.01 * ((np.abs(columns) * reach).sum(axis=1) + np.abs(camera.origin[:, None]))
        columns[:, 3] -= camera.origin[:, None]
        right, up, w = (
            d[0] * columns[0] + d[1] * columns[1] + d[2] * columns[2] for d in film.dual
        )
        if camera.projection.shares_direction:
            w = np.zeros_like(right)
            w[3] = 1
        window, (width, height) = camera.window, pixel_size(camera)
        x = (right - window.left * w) / width - film.dx * w
        y = (up - window.bottom * w) / height - film.dy * w
        self._matrices = np.stack((x, y, w)).astype(np.float32)
        sums = np.abs((x, y, w) * reach).sum(axis=1)
        least = w[3] + np.minimum(w[:3] * low, w[:3] * high).sum(axis=0)
        constant, slope = film.place
        far, size = max(camera.width, camera.height), size.max(axis=0)
        own = constant + (slope + 2 * far * film.weight) * size
        most = np.maximum(sums[0], sums[1]) / least
        margin = (
            (9 * _ROUNDING * (1 + sums[2] / least) + 2.0**-21) * most + 2.0**-8 + 4 * own / least
        )
        self._margin = margin.astype(np.float32)
        counts = np.array([len(m.triangles) for m in scene.meshes])[of]
        # Then all vertices are before the eye by far, as `Vertices.ahead` asks, and finite.
        known = (margin < _MARGIN) & (least > 2.0**11 * film.weight * size)
        known &= (least > 200 * _ROUNDING * sums[2]) & (least > 1 / _RANGE)
        known &= largest(*sums, *reach, *np.abs(self._matrices).reshape(12, -1)) < _RANGE
        known &= largest(most, np.full_like(most, far)) < _FARTHEST // 2
        self.is_dense = known & (counts > _PER_PIXEL * area)

    def within(self, mesh: Mesh, members: Index) -> Iterator[tuple[Index, ...] | None]:
        """Find which triangles of instances of a mesh may cover a pixel, in small steps.

        Yields None after a step; or of some instances (k,) and triangles at a time

        counts : (k,) int
            How many of each instance.
        corners : (3, m) int32
            Their vertices, in the order of `used`.
        used : (v,) int
            Those vertices: their numbers in the mesh, and that of its vertices more for each
            instance before.
        triangle : (m,) int32
            The triangles' numbers in the mesh, instance by instance.
        """
        count, each = len(mesh.vertices), len(mesh.triangles)
        own = np.ones((4, count), np.float32)
        own[:3] = mesh.vertices.T
        corners = []
        for part in parts(each, _TRIANGLES):
            corners.append(mesh.triangles[part].T.astype(np.intp))  # once, not for all instances
            yield None
        together = max(1, _TRIANGLES // max(count, each))
        for some in (members[part] for part in parts(len(members), together)):
            ends = np.empty((len(some), count), np.int64)
            for part in parts(count, max(1, _VERTICES // len(some))):
                ends[:, part] = self._ends(own[:, part], some)
                yield None
            for first, (a, b, c) in zip(range(0, each, _TRIANGLES), corners, strict=True):
                most = largest(*(gather(ends, k).view(np.uint16) for k in (a, b, c)))
                both = most.view(np.uint32).ravel()
                both = both[::2] + both[1::2]
                inside = np.flatnonzero(both & _BOTH == _BOTH)
                copy, triangle = np.divmod(inside, len(a))
                at = np.stack([gather(k, triangle) + copy * count for k in (a, b, c)])
                used, at = occurring(at, ends.size)
                counts, triangle = np.bincount(copy, minlength=len(some)), triangle + first
                yield some, counts, at, used, triangle.astype(np.int32)

    def _ends(self, vertices: NDArray[np.float32], members: Index) -> NDArray[np.int64]:
        """Return per vertex the pixels that a triangle with it may cover: (k, v), 4 x 16 bits.

        Highest x and y, -lowest x and y, within the region: so that of a triangle's largest both
        sums are at least 0 if it may cover one. Each half is 2^14 too large, and not negative.
        """
        rows = np.ascontiguousarray(self._matrices[..., members].transpose(0, 2, 1))
        p, q, w = rows @ vertices  # its sums may be in any order, and one vertex's differ
        np.divide(np.float32(1), w, out=w)
        region, margin = self._region, self._margin[members, None] + np.float32(_FARTHEST)
        out = np.empty((*w.shape, 4), np.uint16)
        for axis, (at, start, end) in enumerate(
            ((p, region.x0, region.x1), (q, region.y0, region.y1))
        ):
            at *= w
            highest = at + (margin - np.float32(0.5))
            np.subtract(margin + np.float32(0.5), at, out=at)
            for k, value, last in ((axis, highest, end - 1), (axis + 2, at, -start)):
                np.minimum(value, np.float32(_FARTHEST + last), out=value)
                out[..., k] = value.astype(np.uint16)
        return out.view(np.int64)[..., 0]

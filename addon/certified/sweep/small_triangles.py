"""Culls triangles that cover no pixel's centre, in dense instances, before they are expanded.

A dense instance has more triangles than pixels. A triangle is culled if its box on the film,
widened by all errors, contains the centre of no pixel of the region. `boxes_of` would leave it out,
too, so that culling changes no result.

The film position of a vertex v of an instance is (p / w, q / w), where (p, q, w) = A v, with a
matrix A (3, 4) for each instance. In float32 they are off by at most 8 2^-24 S, S = |A| |v|: by the
roundings of A, v, their product and three sums. Where that is less than a sixteenth of w, which is
at least W in the instance's box, p / w is off by at most

    9 2^-24 (1 + S_w / W) S_p / W + 2^-21 S_p / W + 2^-8

with the roundings of 1 / w and the product, and two of what is added, which is less than 2^15. The
errors of float64, in A, in the vertices and in the box itself, are bounded by `place` and `weight`
of `film.py`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...arrays import Colors, Floats, Index, Integers, parts
from ...scene import Mesh, Region, Scene
from ...tracer.vector import gather, largest, occurring
from .film import Film

_PER_PIXEL = 2  # an instance with more triangles per pixel of its box is dense
_VERTICES = 1 << 14  # vertices at a time: their temporaries stay in a core's cache
_TRIANGLES = 1 << 15  # triangles at a time
_ROUNDING = 2.0**-24  # the relative error of one rounding in float32
_RANGE = 2.0**40  # no factor, sum or 1 / w is larger: far from where float32 loses digits
_FARTHEST = 1 << 14  # pixels: added to smaller numbers, so that the sum of two fills 16 bits
_BOTH = np.uint32(0x80008000)  # the highest bits of two sums
_MARGIN = 0.25  # pixels: instances with a wider margin are not dense


class Part(NamedTuple):
    """Triangles of k instances of a mesh."""

    mesh: Mesh
    instances: Integers  # (k,)
    counts: Index  # (k,) how many triangles of each
    corners: Integers  # (3, m) which of `used` their vertices are
    # (v,) those vertices: the number in the mesh, plus the mesh's number of vertices for each
    # instance before.
    used: Index
    own: Integers | None = None  # (m,) their numbers in the mesh, as in `chunks.Names`


class SmallTriangles:
    """The instances of a scene on a camera's film, in float32.

    Parameters
    ----------
    scene : Scene
        It has n instances.
    film : Film
    region : Region
        The pixels that are traced.
    area : (n,) float64
        The area of the instances' boxes, in pixels.
    """

    def __init__(self, scene: Scene, film: Film, region: Region, area: Floats) -> None:
        camera = film.camera
        of = scene.instance_meshes
        self._scene = scene
        self._region = region
        low, high = scene.instance_bounds
        reach = np.concatenate((np.maximum(np.abs(low), np.abs(high)), np.ones((1, len(of)))))
        (x, y, w, _), size = film.rows(scene)
        self._matrices = np.stack((x, y, w)).astype(np.float32)
        sums = np.abs((x, y, w) * reach).sum(axis=1)
        least = w[3] + np.minimum(w[:3] * low, w[:3] * high).sum(axis=0)
        constant, slope = film.place
        far = max(camera.width, camera.height)
        own = constant + (slope + 2 * far * film.weight) * size
        most = np.maximum(sums[0], sums[1]) / least
        margin = (
            (9 * _ROUNDING * (1 + sums[2] / least) + 2.0**-21) * most + 2.0**-8 + 4 * own / least
        )
        self._margin = margin.astype(np.float32)
        counts = np.array([len(m.triangles) for m in scene.meshes])[of]
        # All vertices are finite, and far in front of the eye, as `Vertices.ahead` asks.
        known = (margin < _MARGIN) & (least > 2.0**11 * film.weight * size)
        known &= (least > 200 * _ROUNDING * sums[2]) & (least > 1 / _RANGE)
        known &= largest(*sums, *reach, *np.abs(self._matrices).reshape(12, -1)) < _RANGE
        known &= largest(most, np.full_like(most, far)) < _FARTHEST // 2
        self.is_dense = known & (counts > _PER_PIXEL * area)

    def within(self, mesh: Mesh, members: Integers) -> Iterator[Part | None]:
        """Find the triangles of instances `members` of a mesh that may cover a pixel.

        Yields those of some instances and triangles at a time, and None after each step in between.
        """
        count = len(mesh.vertices)
        each = len(mesh.triangles)
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
            found = []
            for first, (a, b, c) in zip(range(0, each, _TRIANGLES), corners, strict=True):
                most = largest(*(gather(ends, k).view(np.uint16) for k in (a, b, c)))
                both = most.view(np.uint32).ravel()
                both = both[::2] + both[1::2]
                inside = np.flatnonzero(both & _BOTH == _BOTH)
                copy, triangle = np.divmod(inside, len(a))
                at = np.stack([gather(k, triangle) + copy * count for k in (a, b, c)])
                found.append((at, copy, (triangle + first).astype(np.int32)))
                yield None
            at, copy, triangle = (np.concatenate(v, axis=-1) for v in zip(*found, strict=True))
            # Once for all parts, as it looks at every vertex of the mesh.
            used, at = occurring(at, ends.size)
            counts = np.bincount(copy, minlength=len(some))
            yield Part(mesh, some, counts, at, used, triangle)

    def _ends(self, vertices: Colors, members: Index) -> NDArray[np.int64]:
        """Return the pixels that a triangle may cover at each vertex, (k, v), as 4 x 16 bits.

        These are highest x, highest y, -lowest x, -lowest y, within the region, plus 2^14, so that
        they are not negative. A triangle has the largest of its vertices. If it may cover a pixel,
        highest - lowest is at least 0 for both x and y.
        """
        rows = np.ascontiguousarray(self._matrices[..., members].transpose(0, 2, 1))
        p, q, w = rows @ vertices  # the bound holds for sums in any order
        np.divide(np.float32(1), w, out=w)
        region = self._region
        margin = self._margin[members, None] + np.float32(_FARTHEST)
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

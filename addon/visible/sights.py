"""What rays see: through the pixels' centres, and through any film positions, both certified.

Cells of the film are numbered from half a pixel beside the region's corner, so that a pixel's
centre is the corner of four cells of one pixel. A cell of level k is 2^k pixels wide.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Index, parts
from ..certified.bounds import Fractions, plane_fractions
from ..certified.ladder import Ladder
from ..certified.rounding import rounding
from ..certified.surfaces import Surfaces
from ..certified.sweep.depth_buffer import ROUNDING, nearness
from ..certified.triangle_tree import TriangleTree
from ..scene import Scene
from ..tracer.camera import Rays, camera_rays, film_positions
from ..tracer.hits import NOTHING, Hits, Statistics
from ..tracer.progress import result_of
from ..tracer.vector import cross, dot, spread
from .faces import Faces

_APART = 2.0**-30  # of t, from a face towards what is before it
_TOGETHER = 1 << 14  # rays that are traced together
TOP = 7  # the level of the largest cells, which may be any number beside one another


class Centres:
    """What the rays through the pixels' centres see.

    `hidden` has for each level from 0 to TOP the nearness that hides what is farther in all of a
    cell, -inf where none does. `face`, `at` are what is seen, and a film position of each, (2, n).
    """

    def __init__(self, scene: Scene, faces: Faces, hits: Hits) -> None:
        camera = scene.camera
        region = camera.region
        shape = region.height, region.width
        self.corner = region.x0 - 0.5, region.y0 - 0.5
        self.size = region.width, region.height
        name = _numbers(faces, hits)
        every, pixel = np.unique(name, return_index=True)
        some = every != NOTHING
        self.face = every[some]
        self.at = np.stack(film_positions(region, pixel=pixel[some]))
        # Planes have numbers of their own here: they hide, too.
        plane = np.where(hits.instance >= len(scene.instances), -2 - hits.instance, NOTHING)
        name = np.where(name >= 0, name, plane).reshape(shape)
        t = hits.t.reshape(shape)
        least = nearness(camera, t, t, ROUNDING)[0]
        off = 0.0 if camera.projection.shares_direction else 2 * faces.film.ray_error
        least -= np.abs(least) * off
        # All rays between four that meet one triangle, which is convex, meet it, too.
        same = (name[1:, 1:] == name[:-1, :-1]) & (name[1:, :-1] == name[:-1, 1:])
        same &= (name[1:, 1:] == name[:-1, 1:]) & (name[1:, 1:] != NOTHING)
        corners = (least[1:, 1:], least[:-1, :-1], least[1:, :-1], least[:-1, 1:])
        side = 1 << TOP
        rows, columns = (-(-(n + 1) // side) * side for n in shape)
        finest = np.full((rows, columns), np.inf)  # beyond the region, where nothing is seen
        finest[: shape[0] + 1, : shape[1] + 1] = -np.inf
        within = np.where(same, np.min(corners, axis=0), -np.inf)
        finest[1 : shape[0], 1 : shape[1]] = within
        self.hidden = [finest]
        for _ in range(TOP):
            last = np.minimum(self.hidden[-1][::2], self.hidden[-1][1::2])
            self.hidden.append(np.minimum(last[:, ::2], last[:, 1::2]))

    def film(self, level: int, cell: Index) -> tuple[Floats, Floats]:
        """Return where cells (2, n) begin and end on the film, within the region, (2, n) each."""
        size = 2.0**level
        corner = np.array(self.corner)[:, None]
        end = np.array(self.size)[:, None] + 0.5
        low, high = (np.clip(at * size, 0.5, end) for at in (cell, cell + 1))
        return corner + low, corner + high

    def cells_of(self, faces: Faces, some: Index) -> tuple[Index, Index, Index]:
        """Return the level of cells about as large as each face, 0 to TOP; and all it may reach.

        Returns
        -------
        level : (n,) int
        which : (c,) int
            The number of the face of each cell.
        cell : (2, c) int
        """
        at = np.array(self.corner)[:, None]
        low, high = faces.low[:, some] - at, faces.high[:, some] - at
        level = np.clip(np.frexp(np.maximum(*(high - low)))[1], 0, TOP)
        first, last = np.floor(np.stack((low, high)) * 2.0**-level).astype(np.int64)
        width, height = last - first + 1
        which, number = spread(np.arange(len(some)), width * height)
        y, x = np.divmod(number, width[which])
        return level, which, np.stack((x, y)) + first[:, which]


class Sights:
    """Traces rays through any film positions."""

    def __init__(self, scene: Scene, faces: Faces) -> None:
        self._scene = scene
        self._faces = faces
        self._tree = TriangleTree.of(scene)

    def look(self, at: Floats) -> tuple[Index, Rays]:
        """Return the faces that rays through film positions (2, n) see, and the rays.

        NOTHING for planes, and for nothing.
        """
        camera = self._scene.camera
        rays = camera_rays(camera, *at)
        return self._trace(
            rays, Surfaces.planes_of(self._scene), (camera.clip_start, camera.clip_end)
        ), rays

    def before(self, face: Index, rays: Rays) -> Index:
        """Return the faces that are met by n rays last before the given ones, (n,), about."""
        a, b, c = self._faces.points[:, self._faces.corners[:, face]].swapaxes(0, 1)
        normal = cross(b - a, c - a)
        t = dot(a - rays.origins, normal) / dot(rays.directions, normal) * (1 - _APART)
        known = np.flatnonzero(np.isfinite(t))
        back = Rays(rays.origins + t * rays.directions, -rays.directions).take(known)
        out = np.full(len(face), NOTHING)
        out[known] = self._trace(back, None, (0.0, np.inf))
        return out

    def _trace(self, rays: Rays, planes: Surfaces | None, clip: tuple[float, float]) -> Index:
        found: list[Index] = [np.zeros(0, np.intp)]
        for some in parts(rays.count, _TOGETHER):
            own = rays.take(np.arange(some.start, some.stop))
            ladder = Ladder(own, planes, clip)
            for pairs in self._tree.pairs(own, *clip):
                ladder.test(pairs)
            found.append(_numbers(self._faces, result_of(ladder.hits(Statistics()))))
        return np.concatenate(found)


def _numbers(faces: Faces, hits: Hits) -> Index:
    """Return the numbers of the faces that rays see, (n,): NOTHING for planes, and for nothing."""
    own = hits.triangle != NOTHING
    instance = np.where(own, hits.instance, 0)
    return np.where(own, faces.start[instance] + hits.triangle, NOTHING)


def behind_planes(scene: Scene, faces: Faces, low: Floats, high: Floats) -> Floats:
    """Return the nearness that infinite planes have at least in n boxes, (n,); -inf if none.

    There is room for the rounding of the rays at the corners, and of those between.
    """
    camera = scene.camera
    parallel = camera.projection.shares_direction
    out = np.full(low.shape[1], -np.inf)
    for plane in scene.planes:
        x, y = np.stack((low, high), axis=1)
        rays = camera_rays(camera, np.concatenate((*x, *x)), np.concatenate((*y, *y[::-1])))
        found = plane_fractions(rays, plane.point[:, None], plane.normal[:, None])
        off = 2 * rounding(scene).ray * np.abs(plane.normal).max()
        moved = Fractions(
            found.numerator,
            found.numerator_error + (off if parallel else 0.0),
            found.denominator,
            found.denominator_error + (0.0 if parallel else off),
        )
        first, last = (np.broadcast_to(end, rays.count) for end in moved.interval())
        least, most = nearness(camera, first, last, ROUNDING)
        sure = np.isfinite(last) & faces.clip.inside(least, most)
        least = np.where(sure, least, -np.inf).reshape(4, -1).min(axis=0)
        out = np.maximum(out, least)
    return out

"""What rays see: through the pixels' centres, and through any film positions, both certified.

Cells of the film are numbered from half a pixel beside the region's corner, so that a pixel's
centre is the corner of four cells of one pixel. A cell of level k is 2^k pixels wide.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Index
from ..certified.ladder import Ladder
from ..certified.sweep.depth_buffer import ROUNDING, nearness
from ..scene import Scene
from ..tracer.camera import camera_rays, film_positions
from ..tracer.hits import NOTHING, Hits, Statistics
from ..tracer.progress import result_of
from ..tracer.vector import spread
from ..tracer.world import Pairs, WorldTriangles
from .faces import Faces

TOP = 7  # the level of the largest cells, which may be any number beside one another
_TOGETHER = 1 << 16  # rays of any film position traced together


class Centres:
    """What the rays through the pixels' centres see.

    `face` (h, w) is the number of the face, NOTHING for none. `hidden` has for each level from 0 to
    TOP the nearness that hides what is farther in all of a cell, -inf where none does.
    """

    def __init__(self, scene: Scene, faces: Faces, hits: Hits) -> None:
        camera = scene.camera
        region = camera.region
        shape = region.height, region.width
        self.corner = region.x0 - 0.5, region.y0 - 0.5
        self.size = region.width, region.height
        name: Index = face_numbers(faces, hits)
        # Planes have numbers of their own here: they hide, too.
        plane = np.where(hits.instance >= len(scene.instances), -2 - hits.instance, NOTHING)
        every = np.where(name >= 0, name, plane).reshape(shape)
        self.face = name.reshape(shape)
        t = hits.t.reshape(shape)
        with np.errstate(all="ignore"):
            least = nearness(camera, t, t, ROUNDING)[0]
        least -= np.abs(least) * (2 * self._ray_error(faces))
        # All rays between four that meet one triangle, which is convex, meet it, too.
        same = (every[1:, 1:] == every[:-1, :-1]) & (every[1:, :-1] == every[:-1, 1:])
        same &= (every[1:, 1:] == every[:-1, 1:]) & (every[1:, 1:] != NOTHING)
        corners = (least[1:, 1:], least[:-1, :-1], least[1:, :-1], least[:-1, 1:])
        side = 1 << TOP
        rows, columns = (-(-(n + 1) // side) * side for n in shape)
        finest = np.full((rows, columns), np.inf)  # beyond the region, where nothing is seen
        finest[: shape[0] + 1, : shape[1] + 1] = -np.inf
        within = np.where(same, np.min(corners, axis=0), -np.inf)
        finest[1 : shape[0], 1 : shape[1]] = within
        self.hidden = [finest]
        self.refresh()

    @staticmethod
    def _ray_error(faces: Faces) -> float:
        parallel = faces.film.camera.projection.shares_direction
        return 0.0 if parallel else faces.film.ray_error

    def refresh(self) -> None:
        """Compute the larger cells anew."""
        del self.hidden[1:]
        for _ in range(TOP):
            last = self.hidden[-1]
            self.hidden.append(
                np.minimum(
                    np.minimum(last[::2, ::2], last[1::2, ::2]),
                    np.minimum(last[::2, 1::2], last[1::2, 1::2]),
                )
            )

    def nearness_in(self, level: int, cell: Index) -> Floats:
        """Return the nearness that hides what is farther, in cells (2, n) of a level."""
        x, y = cell if level >= 0 else cell >> -level
        return self.hidden[max(level, 0)][y, x]

    def film(self, level: int, cell: Index, room: float = 0.0) -> tuple[Floats, Floats]:
        """Return where cells (2, n) begin and end on the film, within the region, (2, n) each.

        They are larger by `room` times their size on each side.
        """
        size = 2.0**level
        corner = np.array(self.corner)[:, None]
        end = np.array(self.size)[:, None] + 0.5
        low = np.clip((cell - room) * size, 0.5, end)
        high = np.clip((cell + 1 + room) * size, 0.5, end)
        return corner + low, corner + high

    def around(self, level: int, cell: Index, corner: int) -> tuple[Index, Floats]:
        """Return the face that one of four pixels around cells sees, (n,), and that pixel, (2, n).

        The pixel is where its centre is on the film.
        """
        ends = np.array(self.size)[:, None] - 1
        own = (cell >> -level if level < 0 else cell) - 1
        pixel = np.clip(own + np.array([[corner & 1], [corner >> 1]]), 0, ends)
        return self.face[pixel[1], pixel[0]], pixel + (np.array(self.corner)[:, None] + 1)

    def witnesses(self, scene: Scene) -> tuple[Index, Floats]:
        """Return the faces that are seen, and a film position of each, (2, n)."""
        faces, pixel = np.unique(self.face, return_index=True)
        some = faces != NOTHING
        return faces[some], np.stack(film_positions(scene.camera.region, pixel=pixel[some]))


def face_numbers(faces: Faces, hits: Hits) -> Index:
    """Return the numbers of the faces that rays see, (n,): NOTHING for planes, and for nothing."""
    own = hits.triangle != NOTHING
    instance = np.where(own, hits.instance, 0)
    return np.where(own, faces.start[instance] + hits.triangle, NOTHING)


def start_cells(faces: Faces, some: Index, corner: tuple[float, float]) -> tuple[Index, Index]:
    """Return the level of cells about as large as each face, 0 to TOP; and all it may reach.

    Returns
    -------
    level : (n,) int
    ends : (2, 2, n) int
        The first and the last of its cells, x and y each.
    """
    at = np.array(corner)[:, None]
    low, high = faces.low[:, some] - at, faces.high[:, some] - at
    level = np.clip(np.frexp(np.maximum(*(high - low)))[1], 0, TOP)
    return level, np.floor(np.stack((low, high)) * 2.0**-level).astype(np.int64)


class Sights:
    """Traces rays through any film positions, with the faces `some` (n,) alone."""

    def __init__(
        self, scene: Scene, faces: Faces, some: Index, corner: tuple[float, float]
    ) -> None:
        self._scene = scene
        self._faces = faces
        self._corner = corner
        level, ends = start_cells(faces, some, corner)
        count = np.prod(ends[1] - ends[0] + 1, axis=0)
        which, number = spread(np.arange(len(some)), count)
        y, x = np.divmod(number, (ends[1, 0] - ends[0, 0] + 1)[which])
        first = _morton(ends[0, 0, which] + x, ends[0, 1, which] + y) << 2 * level[which]
        self._face = some[which]
        self._first = first
        self._last = first + (1 << 2 * level[which])

    def look(self, x: Floats, y: Floats, least: Floats) -> Index:
        """Return the faces that rays through film positions see, (n,); NOTHING for none.

        What is surely less near than `least` (n,) is left out: then another face is returned.
        """
        out = np.empty(len(x), np.intp)
        x0, y0 = self._corner
        key = _morton(np.floor(x - x0).astype(np.int64), np.floor(y - y0).astype(np.int64))
        order = np.argsort(key, kind="stable")
        for begin in range(0, len(order), _TOGETHER):
            some = order[begin : begin + _TOGETHER]
            out[some] = self._look(key[some], x[some], y[some], least[some])
        return out

    def _look(self, key: Index, x: Floats, y: Floats, least: Floats) -> Index:
        """Trace some rays, sorted by `key`."""
        first = np.searchsorted(key, self._first)
        count = np.searchsorted(key, self._last) - first
        met = np.flatnonzero(count)
        face, ray = spread(met, count[met])
        ray += np.repeat(first[met], count[met])
        face = self._face[face]
        f = self._faces
        near = f.nearest[face] >= least[ray]
        for axis, at in enumerate((x, y)):
            near &= (f.low[axis, face] <= at[ray]) & (at[ray] <= f.high[axis, face])
        face, ray = face[near], ray[near]
        used, row = np.unique(face, return_inverse=True)
        corners = f.points[:, f.corners[:, used]].swapaxes(0, 1)
        instance = np.searchsorted(f.start, used, side="right") - 1
        own = (instance.astype(np.int32), (used - f.start[instance]).astype(np.int32))
        triangles = WorldTriangles(corners, *own)
        camera = self._scene.camera
        ends = np.array([0.0, 0.0, camera.width, camera.width])
        around = camera_rays(camera, ends, np.array([0.0, camera.height] * 2))
        ladder = Ladder.of(self._scene, camera_rays(camera, x, y), around)
        ladder.test(Pairs(ray, row, triangles))
        return face_numbers(f, result_of(ladder.hits(Statistics())))


def _morton(x: Index, y: Index) -> Index:
    """Return the bits of x and y in turns, (n,): those of a cell's pixels follow one another."""
    out = np.zeros_like(x)
    for bit in range(20):
        out |= ((x >> bit) & 1) << 2 * bit | ((y >> bit) & 1) << 2 * bit + 1
    return out

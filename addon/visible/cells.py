"""What hides faces in cells of the film.

Cells are numbered from half a pixel beside the region's corner, so that a pixel's centre is the
corner of four cells of one pixel. A cell of level k is 2^k pixels wide.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Array, Floats, Index, parts
from ..certified.bounds import Fractions, plane_fractions
from ..certified.rounding import rounding
from ..certified.sweep.depth_buffer import ROUNDING, nearness
from ..scene import Plane, Region, Scene
from ..tracer.camera import camera_rays, film_positions
from ..tracer.hits import NOTHING, Hits
from ..tracer.progress import Work
from ..tracer.vector import spread
from .faces import Faces
from .hiding import patches
from .sights import numbers

# The most rays through centres, in all and for each face: up to them, pixels are divided.
_RAYS = 1 << 21
_RAYS_OF_FACE = 64
TOP = 7  # the level of the largest cells, which may be any number beside one another
TOGETHER = 1 << 16  # cells that are looked at together


def scale_of(scene: Scene) -> int:
    """Return into how many pixels each is divided along its sides: a power of two."""
    region = scene.camera.region
    most = min(_RAYS, _RAYS_OF_FACE * scene.triangle_count)
    scale = 1
    while region.width * region.height * (2 * scale) ** 2 <= most:
        scale *= 2
    return scale


def finer(scene: Scene, scale: int) -> Scene:
    """Return a scene with more pixels. The rays through the film stay the same, to the bit."""
    camera = scene.camera
    r = camera.region
    region = Region(scale * r.x0, scale * r.y0, scale * r.x1, scale * r.y1)
    size = scale * camera.width, scale * camera.height
    return replace(scene, camera=replace(camera, width=size[0], height=size[1], region=region))


class Cells:
    """What is hidden in cells, by what the rays through the pixels' centres see.

    `hidden` has for each level from 0 to TOP the nearness that hides what is farther in all of a
    cell, -inf where none does. `face`, `at` are what is seen, and a film position of each, (2, n).
    """

    def __init__(self, scene: Scene, faces: Faces, hits: Hits, depth: Floats) -> None:
        camera = scene.camera
        region = camera.region
        shape = region.height, region.width
        self.corner = region.x0 - 0.5, region.y0 - 0.5
        self.size = region.width, region.height
        name = numbers(faces, hits)
        pixel = np.full(faces.count, NOTHING)
        own = np.flatnonzero(name != NOTHING)
        pixel[name[own]] = own
        self.face = np.flatnonzero(pixel != NOTHING)
        self.at = np.stack(film_positions(region, pixel=pixel[self.face]))
        # Planes have numbers of their own here: they hide, too.
        plane = np.where(hits.instance >= len(scene.instances), -2 - hits.instance, NOTHING)
        name = np.where(name >= 0, name, plane).reshape(shape)
        t = depth.reshape(shape)
        least = nearness(camera, t, t, ROUNDING)[0]
        off = 0.0 if camera.projection.shares_direction else 2 * faces.film.ray_error
        least -= np.abs(least) * off
        self._name = np.pad(name, 1, constant_values=NOTHING)
        self._least = np.pad(least, 1)
        # All rays between four that meet one triangle, which is convex, meet it, too.
        names = _of_corners(self._name)
        same = (names == names[0]).all(axis=0) & (names[0] != NOTHING)
        side = 1 << TOP
        rows, columns = (-(-n // side) * side for n in same.shape)
        finest = np.full((rows, columns), np.inf)  # beyond the region, where nothing is seen
        finest[: shape[0] + 1, : shape[1] + 1] = np.where(
            same, _of_corners(self._least).min(axis=0), -np.inf
        )
        self.hidden = [finest]

    def join(self, faces: Faces) -> Work[None]:
        """Find what several faces hide together: what a corner sees, and what continues it."""
        finest = self.hidden[0]
        open_ = np.argwhere(finest == -np.inf).T[::-1]
        for part in parts(open_.shape[1], TOGETHER):
            cell = open_[:, part]
            low, high = self.film(0, cell)
            name, least = (
                np.stack([v[cell[1] + j, cell[0] + i] for j in (0, 1) for i in (0, 1)])
                for v in (self._name, self._least)
            )
            found = np.full(cell.shape[1], -np.inf)
            # What is farther more often goes on behind what is nearer than the reverse.
            for corner in np.where(name >= 0, least, np.inf).argsort(axis=0):
                own = name[corner, np.arange(len(found))]
                rows = np.flatnonzero((own >= 0) & (found == -np.inf))
                at = cell[:, rows] + np.stack((corner[rows] % 2, corner[rows] // 2))
                at = at + np.array(self.corner)[:, None]
                found[rows] = patches(faces, own[rows], at, low[:, rows], high[:, rows])
                yield None
            finest[cell[1], cell[0]] = found
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


def quarters(cell: Index) -> Index:
    """Return the cells of the next level in n cells (2, n), (2, 4 n)."""
    x, y = 2 * cell
    four = np.stack([(x + i, y + j) for j in (0, 1) for i in (0, 1)], axis=2)
    return four.reshape(2, -1)


def _of_corners(values: Array) -> Array:
    """Return what is known of the corners of cells, (4, h, w), from (h + 1, w + 1)."""
    return np.stack((values[:-1, :-1], values[:-1, 1:], values[1:, :-1], values[1:, 1:]))


def behind_plane(scene: Scene, faces: Faces, plane: Plane, low: Floats, high: Floats) -> Floats:
    """Return the nearness that an infinite plane has at least in n boxes, (n,); else -inf.

    There is room for the rounding of the rays at the corners, and of those between.
    """
    camera = scene.camera
    parallel = camera.projection.shares_direction
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
    return np.where(sure, least, -np.inf).reshape(4, -1).min(axis=0)

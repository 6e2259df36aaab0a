"""What hides faces in cells of the film.

Cells are numbered from half a pixel beside the region's corner, so that a pixel's centre is the
corner of four cells of one pixel. A cell of level k is 2^k pixels wide.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array, Floats, parts
from ..certified.sweep.depth_buffer import ROUNDING, nearness
from ..scene import Scene
from ..tracer.camera import film_positions
from ..tracer.hits import NOTHING, Hits
from ..tracer.progress import Work
from .faces import Faces
from .hiding import patches
from .sights import numbers

# The most rays through centres, in all and for each face: up to them, pixels are divided.
_RAYS = 1 << 21
_RAYS_OF_FACE = 64
TOP = 7  # the level of the largest cells, which may be any number beside one another
_TOGETHER = 1 << 16  # cells that are looked at together


def scale_of(scene: Scene) -> int:
    """Return into how many pixels each is divided along its sides: a power of two."""
    region = scene.camera.region
    most = min(_RAYS, _RAYS_OF_FACE * scene.triangle_count)
    scale = 1
    while region.width * region.height * (2 * scale) ** 2 <= most:
        scale *= 2
    return scale


class Cells:
    """What is hidden in cells, by what the rays through the pixels' centres see.

    `hidden` has for each level from 0 to TOP the nearness that hides what is farther in all of a
    cell, -inf where none does. `face`, `at` are what is seen, and a film position of each, (2, n).
    """

    def __init__(self, scene: Scene, faces: Faces, hits: Hits, depth: Floats) -> None:
        camera = scene.camera
        region = camera.region
        shape = region.height, region.width
        self.corner = np.array([[region.x0], [region.y0]]) - 0.5
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
        least, most = nearness(camera, t, t, ROUNDING)
        off = 2 * faces.film.ray_error * (1.0 if camera.projection.shares_direction else most)
        least -= off
        # At the ends of the clip range rays between these may see past what these see.
        least[~faces.clip.inside(least, most + off)] = -np.inf
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
        for part in parts(open_.shape[1], _TOGETHER):
            cell = open_[:, part]
            low = self.corner + cell
            name, least = (
                np.stack([v[cell[1] + j, cell[0] + i] for j in (0, 1) for i in (0, 1)])
                for v in (self._name, self._least)
            )
            found = np.full(cell.shape[1], -np.inf)
            # What is farther more often goes on behind what is nearer than the reverse.
            for corner in np.where(name >= 0, least, np.inf).argsort(axis=0):
                own = name[corner, np.arange(len(found))]
                rows = np.flatnonzero((own >= 0) & (found == -np.inf))
                at = low[:, rows] + np.stack((corner[rows] % 2, corner[rows] // 2))
                found[rows] = patches(faces, own[rows], at, low[:, rows], low[:, rows] + 1)
                yield None
            finest[cell[1], cell[0]] = found
        for _ in range(TOP):
            last = np.minimum(self.hidden[-1][::2], self.hidden[-1][1::2])
            self.hidden.append(np.minimum(last[:, ::2], last[:, 1::2]))

    def hidden_from(self, level: int, low: Floats) -> Floats:
        """Return the nearness that hides what is farther in cells that begin at `low` (2, n)."""
        x, y = ((low - self.corner) * 2.0**-level).astype(np.intp)
        return self.hidden[level][y, x]


def _of_corners(values: Array) -> Array:
    """Return what is known of the corners of cells, (4, h, w), from (h + 1, w + 1)."""
    return np.stack((values[:-1, :-1], values[:-1, 1:], values[1:, :-1], values[1:, 1:]))

"""t and the barycentrics of what a picture's rays see, found when they are asked for.

Which surface a ray sees takes no more than intervals that are apart. What is found here is a
function of the ray and its surface alone: it does not matter when, or of which others together.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..certainty import check_assumptions
from ..scene import Region, Scene
from ..tracer.camera import Rays, camera_rays, corner_rays, film_positions
from ..tracer.hits import NOTHING, Hits, LazyHits, Measure, Measured
from ..tracer.vector import Index, gather, parts
from ..tracer.world import WorldTriangles, world_corners
from .surfaces import Prepared, Surfaces

PIXELS = 1 << 17  # whose surfaces are prepared together: what that takes is some MiB


class Measures:
    """t and the barycentrics of a scene's frame, whose instances and triangles are `names` (h, w).

    These are the frame's own arrays, and may still be filled.
    """

    def __init__(self, scene: Scene, names: tuple[NDArray[np.int32], NDArray[np.int32]]) -> None:
        self._scene, self._names = scene, names
        self._height, self._width = names[0].shape
        self._open = np.zeros(self._height, bool)  # rows that nobody has asked for yet
        self._known = Measured.none()

    @cached_property
    def _values(self) -> Measure:
        return _nothing(self._height, self._width)

    def enter(self, rows: slice, hits: Hits) -> None:
        """Enter what is known of rows; what `LazyHits` do not know is found when asked for."""
        if isinstance(hits, LazyHits):
            ray = hits.known.ray + rows.start * self._width
            self._known = Measured.joined((self._known, replace(hits.known, ray=ray)))
        else:
            self._values[:, rows] = np.vstack((hits.t, hits.s)).reshape(4, -1, self._width)
        self._open[rows] = isinstance(hits, LazyHits)

    def of(self, rows: slice) -> Measure:
        """Return t, inf where nothing is hit, and barycentrics of k rows, (4, k, w)."""
        for _ in self.steps(rows):
            pass
        return self._values[:, rows]

    def steps(self, rows: slice) -> Iterator[None]:
        """Find those of some rows that are not known yet, in small steps."""
        first, last, _ = rows.indices(self._height)
        together, names = max(1, PIXELS // self._width), [v.reshape(-1) for v in self._names]
        for y in range(first, last, together):
            some = y + np.flatnonzero(self._open[y : min(y + together, last)])
            if len(some):
                ray = (some[:, None] * self._width + np.arange(self._width)).ravel()
                region = self._scene.camera.region
                found = measured(self._scene, region, names, self._known, ray)
                self._values[:, some] = found.reshape(4, -1, self._width)
                self._open[some] = False
            yield


def _nothing(*shape: int) -> Measure:
    """Return t and the barycentrics of rays of this shape that hit nothing."""
    out = np.zeros((4, *shape))
    out[0] = np.inf
    return out


def measured(
    scene: Scene,
    region: Region,
    names: tuple[Index, Index],
    known: Measured,
    ray: Index,
    dx: float = 0.0,
    dy: float = 0.0,
) -> Measure:
    """Return t, the nearest float64, and the barycentrics of certified rays of a region, (4, k).

    Parameters
    ----------
    names : (NDArray, NDArray)
        Instance and triangle that each of the region's rays surely sees, (n,), row by row.
    known : Measured
        Of rays that integers decided.
    ray : (k,) int
        The numbers of the rays that are asked about.
    dx, dy : float
        Where each passes its pixel's centre.

    Raises
    ------
    AssumptionError
        If this process's arithmetic no longer is as the proof needs it.
    """
    check_assumptions()
    values, names = _nothing(len(ray)), [gather(v, ray) for v in names]
    hits = Hits(values[0], *np.full((2, len(ray)), NOTHING, np.int32), values[1:])
    place = np.searchsorted(known.ray, ray)
    given = np.append(known.ray, NOTHING)[place] == ray
    values[:, given] = known.values[:, place[given]]
    around = corner_rays(scene.camera, dx, dy)

    def rays_at(index: Index) -> Rays:
        return camera_rays(scene.camera, *film_positions(region, dx, dy, gather(ray, index)))

    rest = np.flatnonzero((names[0] != NOTHING) & ~given)
    for part in parts(len(rest), PIXELS):
        at = rest[part]
        surfaces, surface = _surfaces(scene, *(gather(v, at) for v in names))
        for _ in Prepared(around, surfaces).enter(hits, at, surface, rays_at):
            pass
    return values


def _surfaces(scene: Scene, instance: Index, triangle: Index) -> tuple[Surfaces, Index]:
    """Return the surfaces of these names, (n,) each, and which of them each is."""
    first, planes = len(scene.instances), [(p.point, p.normal) for p in scene.planes]
    which, row = _different(instance, triangle)
    of_mesh = gather(instance, which) < first
    names = [gather(v, which[of_mesh]) for v in (instance, triangle)]
    number = np.where(of_mesh, len(planes) - 1 + np.cumsum(of_mesh), instance[which] - first)
    surfaces = Surfaces(planes, first, WorldTriangles(world_corners(scene, *names), *names))
    return surfaces, gather(number, row)


def _different(instance: Index, triangle: Index) -> tuple[Index, Index]:
    """Return where different names occur first, and which of these each is.

    In their order: neighbours in the picture are neighbours in memory. Of names that share a place
    in the table, some may come more than once.
    """
    every = np.arange(len(instance), dtype=np.int32)
    table = np.empty(1 << (2 * len(every)).bit_length(), np.int32)
    place = (triangle + instance * np.int32(40503)) & (len(table) - 1)
    table[place[::-1]] = every[::-1]
    first = gather(table, place)
    same = (gather(instance, first) == instance) & (gather(triangle, first) == triangle)
    first = np.where(same, first, every)
    which = np.flatnonzero(first == every)
    table[which] = every[: len(which)]
    return which, gather(table, first)

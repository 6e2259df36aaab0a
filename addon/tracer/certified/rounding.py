"""t and the barycentrics of what certified rays see, found when they are asked for.

Which surface a ray sees takes no more than intervals that are apart. In come its names, and what
integers found already; out go the float64 nearest to each t, and the barycentrics: a function of
the ray and its surface alone, so that it does not matter when, or with which others, it is called.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..camera import Rays, camera_rays, corner_rays, film_positions
from ..hits import NOTHING, Hits, Measure, Measured
from ..vector import Index, gather, parts
from ..world import WorldTriangles, world_corners
from .certainty import check_assumptions
from .surfaces import TOGETHER, Prepared, Surfaces

if TYPE_CHECKING:
    from ...scene import Region, Scene

PIXELS = 1 << 17  # whose surfaces are prepared together: what that takes is some MiB


def rounded(
    scene: Scene,
    region: Region,
    names: tuple[NDArray[np.int32], NDArray[np.int32]],
    known: Measured,
    ray: Index,
    dx: float = 0.0,
    dy: float = 0.0,
) -> Measure:
    """Return t and the barycentrics of some rays of a region's pixels.

    Parameters
    ----------
    names : (NDArray, NDArray)
        Instance and triangle that each ray of the region surely sees, (n,), row by row.
    known : Measured
        Of the rays that integers decided.
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
    hits = Hits.none(len(ray))
    hits.instance, hits.triangle = (gather(v, ray) for v in names)
    place = np.searchsorted(known.ray, ray)
    given = np.append(known.ray, NOTHING)[place] == ray
    own = known.take(place[given])
    hits.t[given], hits.s[:, given] = own.t, own.s
    around = corner_rays(scene.camera, dx, dy)

    def rays_at(index: Index) -> Rays:
        return camera_rays(scene.camera, *film_positions(region, dx, dy, gather(ray, index)))

    rest = np.flatnonzero((hits.instance != NOTHING) & ~given)
    for part in parts(len(rest), PIXELS):
        at = rest[part]
        surfaces, surface = _surfaces(scene, gather(hits.instance, at), gather(hits.triangle, at))
        prepared = Prepared(around, surfaces)
        for some in parts(len(at), TOGETHER):
            prepared.enter(hits, at[some], rays_at(at[some]), surface[some])
        prepared.finish(hits, rays_at)
    return hits.t, hits.s


def _surfaces(
    scene: Scene, instance: NDArray[np.int32], triangle: NDArray[np.int32]
) -> tuple[Surfaces, Index]:
    """Return the surfaces of these names, (n,) each, and which of them each is."""
    first, planes = len(scene.instances), [(p.point, p.normal) for p in scene.planes]
    which, row = _different(instance, triangle)
    on_mesh = which[gather(instance, which) < first]
    names = gather(instance, on_mesh), gather(triangle, on_mesh)
    if planes:
        number = np.cumsum(of_mesh := gather(instance, which) < first) - 1 + len(planes)
        row = np.where(of_mesh, number, gather(instance, which) - first)[row]
    return Surfaces(planes, first, WorldTriangles(world_corners(scene, *names), *names)), row


def _different(instance: Index, triangle: Index) -> tuple[Index, Index]:
    """Return where different names occur first, and which of these each is.

    In their order: neighbours in the picture are neighbours in memory. Names that share a place in
    the table are told apart, but may be returned more than once.
    """
    count = len(instance)
    every = np.arange(count, dtype=np.int32)
    size = 1 << (2 * count).bit_length()
    place = (triangle + instance * np.int32(40503)) & (size - 1)
    table = np.empty(size, np.int32)
    table[place[::-1]] = every[::-1]
    first = gather(table, place)
    same = (gather(instance, first) == instance) & (gather(triangle, first) == triangle)
    first = np.where(same, first, every)
    which = np.flatnonzero(first == every)
    table[which] = every[: len(which)]
    return which, gather(table, first)

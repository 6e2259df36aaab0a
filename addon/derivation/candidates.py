"""Finds the triangles and planes that one pixel's ray may meet: their box on the film holds it.

A teacher shows, too, why a surface behind the eye or beyond the clip range is not seen. So the
boxes are found twice, for the camera and for one that looks the other way. The instances' own boxes
come first, so that a forest takes no longer than a tree.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..arrays import Places
from ..methods import Method
from ..scene import Camera, Region, Scene
from ..tracer.candidates import candidates, pixel_bounds
from ..tracer.hits import NOTHING
from ..tracer.nearest import plan, within_clip
from ..tracer.progress import result_of
from ..tracer.settings import UNPROVEN_SETTINGS, Settings
from ..tracer.ties import Name
from ..tracer.triangle import textbook
from ..tracer.world import WorldTriangles, box_corners, refused
from .pixel import Candidate, Pixel, answer, check_pixel

LIMIT = 8  # candidates that one still reads

_PLAIN = Settings(Method.TEXTBOOK)
_FARTHEST = 1e300  # metres: no clip range


def gather_pixel(scene: Scene, x: int, y: int, limit: int = LIMIT, source: str = "") -> Pixel:
    """Return what the ray through a pixel's centre may meet.

    Parameters
    ----------
    scene : Scene
    x, y : int
        Of the traced picture, the camera's region; (0, 0) is its lower left.
    limit : int
        The number of triangles to return: first those that the textbook accepts, the nearest
        first, then those that the ray passes, the closest miss first. There are more where the
        proven answer, or what one of the unproven methods sees, would not be the same. Infinite
        planes do not count.
    source : str
        What a reader calls the scene.

    Raises
    ------
    SceneError
        If there is no such pixel.
    """
    check_pixel(scene.camera, x, y)
    column, row = scene.camera.region.x0 + x, scene.camera.region.y0 + y
    triangles = _triangles(scene, Region(column, row, column + 1, row + 1))
    first = len(scene.instances)
    planes = tuple(
        Candidate(scene.objects[p.object], k, NOTHING, np.stack((p.point, p.normal)), p.color[None])
        for k, p in enumerate(scene.planes, first)
    )
    pixel = Pixel(
        scene.camera,
        x,
        y,
        planes,
        scene.background,
        first_plane=first,
        triangles=scene.triangle_count,
        refused=refused(scene),
        source=source,
    )
    order = _order(pixel, triangles)
    count = _enough(pixel, triangles, order, limit)
    shown = [*order[:count]]
    if len(order) > count:
        seen = {answer(pixel, triangles, some).seen for some in UNPROVEN_SETTINGS}
        names = ((triangles.instance[k], triangles.triangle[k]) for k in order[count:])
        shown += [k for k, name in zip(order[count:], names, strict=True) if name in seen]
    return replace(
        pixel,
        candidates=(*(_candidate(scene, triangles, k) for k in shown), *planes),
        left_out=len(order) - len(shown),
    )


def _triangles(scene: Scene, tile: Region) -> WorldTriangles:
    """Return the triangles with a box on the film that holds the tile's one pixel, each once."""
    found: dict[Name, NDArray[np.float64]] = {}
    boxes = box_corners(scene.instance_bounds, scene.instance_matrices)
    for camera in _both_ways(replace(scene.camera, region=tile)):
        # First the instances with a bounding box that the ray may meet.
        x0, x1, y0, y1 = pixel_bounds(camera, boxes, reach=0.5)
        near = np.flatnonzero((x0 < x1) & (y0 < y1))
        some = replace(scene, camera=camera, instances=tuple(scene.instances[k] for k in near))
        for _, pairs in candidates(result_of(plan(some, _PLAIN, 0.0)), tile):
            if pairs is not None:
                names = zip(near[pairs.instance].tolist(), pairs.triangle.tolist(), strict=True)
                found |= zip(names, np.moveaxis(pairs.corners, 2, 0), strict=True)
    corners = np.array(list(found.values())).reshape(-1, 3, 3)
    named = np.array(list(found), np.int32).reshape(-1, 2)
    return WorldTriangles(corners.transpose(1, 2, 0), *named.T)


def _both_ways(camera: Camera) -> list[Camera]:
    """Return the camera without clipping, and one that looks along the same rays backwards."""
    if camera.projection.sees_behind:
        return [replace(camera, clip_start=-_FARTHEST, clip_end=_FARTHEST)]
    start = min(camera.clip_start, 1.0) * 2.0**-20  # nearer, every box would fill the picture
    ahead = replace(camera, clip_start=start, clip_end=_FARTHEST)
    turned = camera.world_from_camera.copy()
    turned[:3, :3] *= -1  # right, up and forward: −d = u (−right) + v (−up) + (−forward)
    return [ahead, replace(ahead, world_from_camera=turned)]


def _order(pixel: Pixel, triangles: WorldTriangles) -> Places:
    """Return the triangles' order for a reader: hits by t, then near misses."""
    rays = pixel.rays()
    hit, t, s = textbook(rays, *triangles.corners)
    with np.errstate(invalid="ignore"):
        outside = np.nan_to_num(np.maximum(0.0, -s.min(axis=0)), nan=np.inf)
        distance = np.nan_to_num(np.abs(t), nan=np.inf)
    seen = hit & within_clip(pixel.camera, t)
    return np.lexsort((triangles.triangle, triangles.instance, distance, outside, ~seen))


def _enough(pixel: Pixel, triangles: WorldTriangles, order: Places, limit: int) -> int:
    """Return how many of the first in order have the same proven answer as all of them.

    At least `limit`: what is tied with the first comes with it, and what raised a doubt of it.
    """
    whole = answer(pixel, triangles)
    names = whole.ties | {whole.seen}
    ordered = zip(triangles.instance[order], triangles.triangle[order], strict=True)
    last = max((k for k, name in enumerate(ordered, start=1) if name in names), default=0)
    count = max(limit, last)
    while count < len(order):
        some = answer(pixel, triangles.take(order[:count]))
        if (some.certainty, some.ties) == (whole.certainty, whole.ties):
            break
        count *= 2
    return min(count, len(order))


def _candidate(scene: Scene, triangles: WorldTriangles, k: int) -> Candidate:
    number, triangle = int(triangles.instance[k]), int(triangles.triangle[k])
    instance = scene.instances[number]
    mesh = scene.meshes[instance.mesh]
    slot = min(int(mesh.slots[triangle]), len(instance.colors) - 1)
    colors = instance.colors[slot : slot + 1]
    if mesh.corner_colors is not None:
        colors = mesh.corner_colors[triangle]
    points = np.ascontiguousarray(triangles.corners[..., k])
    name = scene.objects[instance.object]
    return Candidate(name, number, triangle, points, colors, mesh.name, slot)

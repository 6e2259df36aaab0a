"""What the other side's own rounding may excuse: that of a rasteriser, or of a ray tracer.

Both compute in float32. A rasteriser rounds corners to a fraction of a pixel besides, and keeps
depths in a buffer of 24 bits: its steps grow with the clip range. A ray tracer has neither: its
depths and its clip range are float32's. Where triangles are thin, or seen at a grazing angle, its
depths are worse for that, as they come from quotients.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats
from ..scene import Camera, Scene
from ..tracer import shading
from ..tracer.camera import Rays, pixel_size
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING, Hits
from ..tracer.progress import Work
from ..tracer.vector import cross, dot
from ..tracer.world import world_corners
from .bounds import SNAPPING, U32, corner_errors, depth_step, pixel_error, spread_error, view_error

# The roundings of t = e2 . (s x e1) / (e1 . (d x e2)), as Moeller and Trumbore have it, in units of
# the products' size: a difference of corners (1), the cross product (3) and the scalar product (3),
# for each side of the fraction; one for the division. A direction has three more, of its own.
_QUOTIENT = 18
_LEAST_SINE = 2.0**-20  # of a surface seen edge-on: float32 knows no smaller one


@dataclass(frozen=True, eq=False)
class Renderer:
    """How a picture was made, as far as its rounding goes.

    The distances are of n hits at `positions` (n, 3), on rays whose directions the third argument
    has: (n,) metres.
    """

    name: str
    words: str
    snapping: float  # pixels: to what corners are rounded at least
    closed: bool  # triangles that share an edge leave no gap between them
    sideways: Callable[[Scene, Hits, Floats], Floats]  # how far a surface may be moved
    along: Callable[[Scene, Hits, Floats, Rays], Floats]  # how far its depth may
    # Metres, at depths (n,): how near two depths are taken for one, whatever made them.
    step: Callable[[Camera, Floats], Floats]

    def resolution(self, camera: Camera, depth: Floats, along: Floats) -> Floats:
        """Return how far apart in depth two surfaces are told apart, (n,) metres.

        Both carry the error `along` (n,).
        """
        return self.step(camera, np.asarray(depth, np.float64)) + 2 * along


def _as_sideways(scene: Scene, hits: Hits, positions: Floats, rays: Rays) -> Floats:
    """Return how far a rasteriser moves a depth: as far as the corners that it lies between."""
    return view_error(scene, hits, positions)


def _of_rays(scene: Scene, hits: Hits, positions: Floats) -> Floats:
    """Return how far float32 may move the edges of what n rays hit, (n,) metres.

    A ray's place among a triangle's edges comes from products with whole edges and with the way to
    a corner: the farthest corner's error counts wherever the triangle is hit.
    """
    return corner_errors(scene, hits, positions, lambda own, s: own.max(axis=0))


def _ray_depth(scene: Scene, hits: Hits, positions: Floats, rays: Rays) -> Floats:
    """Return how far float32 may move the t of n rays, (n,) metres.

    A surface that is moved by its corners' error is met that far away, over the cosine at which it
    is seen. The quotient t rounds products of the size |e1| |e2| |s| / (|e1 x e2| |cosine|), where
    s leads from the eye to a corner: the sine of the triangle's corner counts as well.
    """
    moved = _of_rays(scene, hits, positions)
    directions = np.broadcast_to(rays.directions, (3, len(hits)))
    length = np.sqrt(dot(directions, directions))
    n = shading.normals(scene, hits).T
    cosine = np.maximum(np.abs(dot(n, directions)) / length, _LEAST_SINE)
    reach = np.abs(positions - scene.camera.origin).sum(axis=1)
    sine = np.ones(len(hits))
    of_mesh = np.flatnonzero(hits.instance < len(scene.instances))
    p1, p2, p3 = world_corners(scene, hits.instance[of_mesh], hits.triangle[of_mesh])
    eye = scene.camera.origin[:, None]
    reach[of_mesh] = np.max([np.abs(p - eye).sum(axis=0) for p in (p1, p2, p3)], axis=0)
    e1, e2 = p2 - p1, p3 - p1
    normal = cross(e1, e2)
    with np.errstate(divide="ignore", invalid="ignore"):
        whole = np.sqrt(dot(normal, normal) / (dot(e1, e1) * dot(e2, e2)))
    sine[of_mesh] = np.maximum(np.nan_to_num(whole), _LEAST_SINE)
    # t is in units of the direction's length, a depth; distances are along the ray.
    return (moved + _QUOTIENT * U32 * reach / sine) / (cosine * length)


def _no_buffer(camera: Camera, depth: Floats) -> Floats:
    """Return the last place of a float32 depth, (n,) metres."""
    return 2 * U32 * np.abs(depth)


RASTER = Renderer(
    "raster",
    "float32 rasterisation with a depth buffer of 24 bits",
    SNAPPING,
    True,
    view_error,
    _as_sideways,
    depth_step,
)
RAYS = Renderer("rays", "float32 rays", 0.0, False, _of_rays, _ray_depth, _no_buffer)
# Cycles' rays. Its edges are Pluecker's, in which neighbours agree; where a triangle reaches so far
# that they are worse than a rasteriser's, `embree.py` knows.
EMBREE = replace(
    RASTER, name="embree", words="Embree's float32 rays", along=_ray_depth, step=_no_buffer
)
RENDERERS = {renderer.name: renderer for renderer in (RAYS, RASTER)}
_RASTERISERS = "BLENDER_WORKBENCH", "BLENDER_EEVEE"  # from 4.2 to 4.5 BLENDER_EEVEE_NEXT


def renderer_of(header: str, engine: str) -> tuple[Renderer, str]:
    """Return what a picture was made by, and how that is known, in words.

    Parameters
    ----------
    header : str
        Which engine wrote the file's header: 'cycles', 'other' of Blender's; '' for no Blender.
    engine : str
        Blender's name of the engine that the scene is set to; '' where that is not known.
    """
    if header == "cycles":
        return RAYS, "as Cycles made it"
    if not header:
        return RAYS, "as nothing says that it was rasterised"
    if engine.startswith(_RASTERISERS):
        return RASTER, f"as Blender wrote it, and the scene's engine is {engine}"
    # What an add-on registers may trace rays, and a header does not name it.
    return RAYS, "as Blender wrote it, but nothing says that it was rasterised"


def sample_band(
    scene: Scene, frame: Frame, all_rows: list[slice], renderer: Renderer = RASTER
) -> Work[Floats]:
    """Return how far from each pixel's centre a renderer's sample may lie, (h, w) pixels.

    That is the largest error of the surfaces seen in the 3 x 3 pixels around, and of those farther
    away that float32 may move as far as this pixel. `all_rows` are looked at one after the other.
    """
    camera = scene.camera
    w = camera.window
    own = np.zeros(frame.shape)  # of the surface that the pixel itself shows
    for number, rows in enumerate(all_rows):
        hits = frame.hits(rows)
        seen = np.flatnonzero(hits.instance != NOTHING)
        hits = hits.take(seen)
        view = renderer.sideways(scene, hits, frame.positions(rows)[seen])
        row = seen // frame.shape[1] + (rows.start or 0)
        y = w.bottom + (row + camera.region.y0 + 0.5) * pixel_size(camera)[1]
        own[rows].reshape(-1)[seen] = pixel_error(camera, hits.t, view, y, renderer.snapping)
        yield number / len(all_rows)
    smallest = float(np.min(own, where=own > 0, initial=SNAPPING))
    least = max(renderer.snapping, smallest)
    return (yield from spread_error(own, least))

"""Bounds on the other side's own rounding: that of a rasteriser, or of a ray tracer.

Both compute in float32. A rasteriser rounds corners to a fraction of a pixel besides, and keeps
depths in a buffer of 24 bits: its steps grow with the clip range. A ray tracer has neither: its
depths and its clip range are float32's. Where triangles are thin, or seen at a grazing angle, its
depths and its edges are worse for that, as they come from quotients of products.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import Floats, Places
from ..scene import Camera, Scene
from ..tracer import shading
from ..tracer.camera import Rays
from ..tracer.hits import Hits
from ..tracer.vector import cross, dot, largest
from ..tracer.world import world_corners
from .bounds import SNAPPING, U32, corner_errors, depth_step, most_view_error, view_error

# The roundings of t = e2 . (s x e1) / (e1 . (d x e2)), as Moeller and Trumbore have it, in units of
# the products' size: a difference of corners (1), the cross product (3) and the scalar product (3),
# for each side of the fraction; one for the division. A direction has three more, of its own.
_QUOTIENT = 18
# The roundings of (d x e) . s, by which a ray is on one side of an edge or the other: of d (3), e
# and s (1 each), the cross product (2) and the scalar product (3). The absolute values of its terms
# sum up to 2/sqrt(3) of |d| |e| |s| at most: that makes 12. Moeller and Trumbore's third edge is
# where two such quotients add up to 1, with three roundings more: 27 of |d| |s| (|e1| + |e2|) / 2.
# Where that edge is far shorter than the others, at the tip of a needle, they are off by more along
# the needle. That is not excused: a pixel's error has no direction here, and the needle's long
# sides, which are most of its boundary, are known well.
_EDGE = 27
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
    # Metres, at depths (n,): depths nearer to each other than this are taken for one.
    step: Callable[[Camera, Floats], Floats]
    # Upper bound of `sideways` for each instance, (k,) metres, or None.
    most: Callable[[Scene], Floats] | None = None

    def resolution(self, camera: Camera, depth: Floats, along: Floats) -> Floats:
        """Return the resolution of depth, (n,) metres.

        Both carry the error `along` (n,).
        """
        return self.step(camera, np.asarray(depth, np.float64)) + 2 * along


def _as_sideways(scene: Scene, hits: Hits, positions: Floats, rays: Rays) -> Floats:
    """Return how far a rasteriser moves a depth: as far as the corners that it lies between."""
    return view_error(scene, hits, positions)


def _moved(scene: Scene, hits: Hits, positions: Floats) -> Floats:
    """Return how far float32 may move what n rays hit, (n,) metres: as far as any of its corners.

    A ray is held against whole edges, and the way to a corner: so the farthest corner counts.
    """
    return corner_errors(scene, hits, positions, lambda own, s: own.max(axis=0))


def _of_rays(scene: Scene, hits: Hits, positions: Floats) -> Floats:
    """Return how far float32 may move the edges of what n rays hit, (n,) metres.

    They are moved with their corners. And a product of the size |d| |s| |e| is rounded, where s
    leads to a corner of the edge e, while a ray beside the edge makes |d x e| of its distance: the
    more an edge leads along the ray, the less is it known where.
    """
    moved = _moved(scene, hits, positions)
    camera = scene.camera
    of_mesh, (p1, p2, p3), reach = _triangles(scene, hits)
    ways = (positions[of_mesh] - camera.origin).T
    if camera.projection.shares_direction:
        ways = np.broadcast_to(camera.forward[:, None], ways.shape)
    sines = [np.nan_to_num(_sine(ways, e), nan=1.0) for e in (p2 - p1, p3 - p1, p3 - p2)]
    moved[of_mesh] += _EDGE * U32 * reach / np.maximum(np.min(sines, axis=0), _LEAST_SINE)
    return moved


def _triangles(scene: Scene, hits: Hits) -> tuple[Places, Floats, Floats]:
    """Return which m of the hits are a mesh's, their corners, (3, 3, m), and how far they reach.

    The last is the distance from the camera to the farthest corner, (m,) metres.
    """
    of_mesh = np.flatnonzero(hits.instance < len(scene.instances))
    corners = world_corners(scene, hits.instance[of_mesh], hits.triangle[of_mesh])
    eye = scene.camera.origin[:, None]
    return of_mesh, corners, largest(*(_length(p - eye) for p in corners))


def _sine(first: Floats, second: Floats) -> Floats:
    """Return the sine of the angle between vectors (3, m), (m,); NaN where one is zero."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return _length(cross(first, second)) / (_length(first) * _length(second))


def _length(vectors: Floats) -> Floats:
    return np.sqrt(dot(vectors, vectors))


def _ray_depth(scene: Scene, hits: Hits, positions: Floats, rays: Rays) -> Floats:
    """Return how far float32 may move the t of n rays, (n,) metres.

    A surface that is moved by its corners' error is met that far away, over the cosine at which it
    is seen. The quotient t rounds products of the size |e1| |e2| |s| / (|e1 x e2| |cosine|), where
    s leads from the eye to a corner: the sine of the triangle's corner counts as well.
    """
    moved = _moved(scene, hits, positions)
    directions = np.broadcast_to(rays.directions, (3, len(hits)))
    length = _length(directions)
    n = shading.normals(scene, hits).T
    cosine = np.maximum(np.abs(dot(n, directions)) / length, _LEAST_SINE)
    reach = np.abs(positions - scene.camera.origin).sum(axis=1)
    sine = np.ones(len(hits))
    of_mesh, (p1, p2, p3), reach_of_mesh = _triangles(scene, hits)
    reach[of_mesh] = reach_of_mesh
    sine[of_mesh] = np.maximum(np.nan_to_num(_sine(p2 - p1, p3 - p1)), _LEAST_SINE)
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
    most_view_error,
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
    """Return the kind of renderer that made a picture, and how that is known, in words.

    Parameters
    ----------
    header : str
        Which engine wrote the file's header: 'cycles', 'other' of Blender's; '' for no Blender.
    engine : str
        Blender's name of the engine that made it; '' where that is not known. What a .blend is set
        to is not what made a picture.
    """
    if header == "cycles":
        return RAYS, "as Cycles made it"
    if not header:
        return RAYS, "as nothing says that it was rasterised"
    if engine.startswith(_RASTERISERS):
        return RASTER, f"as Blender wrote it, and its engine is {engine}"
    # An engine of an add-on may trace rays, and a header does not name it.
    return RAYS, "as Blender wrote it, but nothing says that it was rasterised"

"""Bounds how far Blender's own arithmetic may move or recolour what a pixel shows.

It computes in float32, rounds triangles' corners, and stores depths, half floats and 8-bit files.
The tracer's own errors in float64 are far below these bounds.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..arrays import Array, Floats, parts, run_starts
from ..scene import Camera, Scene
from ..tracer.camera import pixel_size
from ..tracer.hits import Hits
from ..tracer.progress import Work
from ..tracer.shading import by_mesh
from ..tracer.vector import transform_points
from ..tracer.world import reaches

U32 = 2.0**-24  # the rounding unit of float32
# Pixels: rasterisers keep eight bits of a vertex' position below the pixel. Where the machine's was
# measured to keep less, the comparison adds what is missing: see `Sampling.snapping`.
SNAPPING = 1 / 256

# A vertex goes through three float32 products: model, view, projection. The model's rounds each
# component 4 times, in terms with absolute values that sum up to |M| |v|. The view's rounds it 4
# times, and its matrix was inverted in float32 (8 more), in terms up to |p| + |o|. (v is the vertex
# in its object's space, p in world space, o the camera; norms are sums of absolute values.) A point
# of a triangle has the errors of the corners, weighed by its barycentrics.
_MODEL, _VIEW = 4, 12
# The projection rounds a film position a few times more, and so does the division by w.
_FILM = 4
# A depth buffer has 24 bits; the depth itself comes from a product of 2 terms and a division.
_DEPTH_STEPS = 5


# Pixels: where Blender's sample may lie farther than this from the centre, whatever is shown proves
# nothing.
DECIDABLE = 0.5

_ROWS = 64  # bounded together, at least, so that a step is short in large pictures


def view_error(scene: Scene, hits: Hits, positions: Floats) -> Floats:
    """Return how far float32 may move what n rays hit in camera space, (n,) metres.

    Parameters
    ----------
    scene : Scene
    hits : Hits
        Each hits something. For an infinite plane Blender draws a polygon with corners around the
        camera; their error is taken to grow with the distance from it.
    positions : (n, 3) float64
        Where they lie, in world space.
    """
    return corner_errors(scene, hits, positions, lambda own, s: (own * s).sum(axis=0))


def most_view_error(scene: Scene) -> Floats:
    """Return what :func:`view_error` is at most on each of the k instances, (k,) metres."""
    eye, reach = np.abs(scene.camera.origin).sum(), reaches(scene).sum(axis=0)
    return U32 * (_MODEL * reach + _VIEW * (reach + eye))


def corner_errors(
    scene: Scene, hits: Hits, positions: Floats, together: Callable[[Floats, Floats], Floats]
) -> Floats:
    """Return what the errors of the corners of n triangles come to, (n,) metres.

    `together` makes one of the errors of k corners (3, k) and the barycentrics (3, k).
    """
    eye = np.abs(scene.camera.origin).sum()
    far = np.abs(positions - scene.camera.origin).sum(axis=1)
    error = _MODEL * (eye + far) + _VIEW * (2 * eye + far)
    names = np.stack((hits.instance, hits.triangle))
    for mesh, rows in by_mesh(scene, hits.instance):
        # There are mostly more pixels than triangles: corners are looked at once a run of pixels.
        first = run_starts(*names[:, rows])
        instance, triangle = names[:, rows[first]]
        length = np.diff(first, append=len(rows))
        matrices = scene.instance_matrices[..., None, instance]
        v = mesh.vertices[mesh.triangles[triangle].T].transpose(2, 0, 1)  # component, corner, row
        p = np.abs(transform_points(matrices, v)).sum(axis=0)
        model = transform_points(np.abs(matrices), np.abs(v)).sum(axis=0)
        own = _MODEL * model + _VIEW * (p + eye)
        error[rows] = together(np.repeat(own, length, axis=1), hits.s[:, rows])
    return U32 * error


def pixel_error(
    camera: Camera,
    depth: Floats,
    view: Floats,
    y: Floats | float = 0.0,
    snapping: float = SNAPPING,
) -> Floats:
    """Return how far the other side's sample may lie from the pixel's centre, (n,) pixels.

    Snapping, plus the error `view` (n,) of a point at `depth` (n,) on the film, at its height `y`
    (n,) there, in window units.
    """
    width, height = pixel_size(camera)
    w, projection = camera.window, camera.projection
    steepest = max(map(abs, (w.left, w.right, w.bottom, w.top)))
    moved = view * projection.slant(steepest)
    moved = moved / projection.scale(np.maximum(depth, camera.clip_start), y)
    film = _FILM * U32 * max(camera.width, camera.height)
    return snapping + film + moved / min(width, height)


def depth_step(camera: Camera, depth: Floats) -> Floats:
    """Return how near a buffer of 24 bits takes two depths (n,) for one, metres.

    It holds f / (f - n) (1 - n / z) of a perspective camera, so a step at depth z is
    z^2 (f - n) / (f n) 2^-24; of an orthographic one (f - n) 2^-24. Without a clip end the former
    is z^2 / n 2^-24; of the latter there is no such buffer, and a depth is a float32.
    """
    near, far = camera.clip_start, camera.clip_end
    if far == np.inf:
        z = np.abs(np.asarray(depth, np.float64))
        return _DEPTH_STEPS * U32 * (z if camera.projection.shares_direction else z**2 / near)
    step = np.full(np.shape(depth), (far - near) * U32)
    if not camera.projection.shares_direction:
        step = step * np.asarray(depth, np.float64) ** 2 / (far * near)
    return _DEPTH_STEPS * step


def spread_error(own: Floats, least: float = SNAPPING) -> Work[Floats]:
    """Return the largest error that reaches each pixel, and at `least` that, (h, w).

    `own` (h, w) is the error of the surface that each pixel shows, in pixels. It counts in a square
    around that pixel that reaches as far as the next power of two.
    """
    band = np.full(own.shape, least)
    height, most = len(own), max(own.shape)
    reach = 1
    while True:
        together = max(_ROWS, 2 * reach)
        for part in parts(height, together):
            first = max(0, part.start - reach)
            around = own[first : part.stop + reach]
            # Errors that reach this far. Those up to half of it were spread before.
            ring = around > (reach / 2 if reach > 1 else 0)
            ring &= (around <= reach) | (reach >= most)
            if ring.any():
                largest = largest_within(np.where(ring, around, 0.0), reach)[part.start - first :]
                here = band[part]
                np.maximum(here, largest[: len(here)], out=here)
            yield None
        if reach >= most:
            return band
        reach *= 2


def largest_within(values: Array, reach: int) -> Array:
    """Return the largest of (h, w) values that are at most `reach` rows and columns away."""
    for axis in (0, 1):
        values = np.moveaxis(values, axis, 0).copy()
        done = 0  # how many rows away the largest is known
        while done < min(reach, len(values)):
            step = min(max(done, 1), reach - done)
            before = values.copy()
            np.maximum(values[step:], before[:-step], out=values[step:])
            np.maximum(values[:-step], before[step:], out=values[:-step])
            done += step
        values = np.moveaxis(values, 0, axis)
    return values

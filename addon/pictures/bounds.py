"""Bounds how far Blender's own arithmetic may move or recolour what a pixel shows.

It computes in float32, rounds triangles' corners, and stores depths, half floats and 8-bit files.
The tracer's own errors in float64 are far below these bounds.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Bools, Floats, by_runs, run_starts
from ..files.images import encoded
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

# The units in the last place, of the larger value, by which colours may differ. Blender hands its
# viewport's colours over as half floats, 11 bits, and cuts off rather than rounds: 1 reads 0.9995.
# Next to an edge a window copies them once more, and up to 3 units are missing (measured in 4.3).
HALF_UNITS = 4

# That copy lets a little of the neighbour through: beside a white pixel, black reads 3 * 2^-14
# (measured in 4.3). Eight such steps are allowed.
LEAST_STEP = 8 * 2.0**-14

# The error of a dark colour, as Workbench adds up the logarithms of 1 + a colour in half floats.
LEAST_SUM = 2.0**-12

# A rasteriser interpolates a colour attribute between corners that it has rounded to 1/256 pixel,
# by an approximate 1/w: a ramp over a few pixels is off by as much as this (measured 0.0013).
INTERPOLATED = 2.0**-9

# A writer's own rounding of sRGB's curve, on top of half a level (float32, tables).
LEVEL_SLACK = 0.02

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
    return np.asarray(U32 * (_MODEL * reach + _VIEW * (reach + eye)), np.float64)


def corner_errors(
    scene: Scene, hits: Hits, positions: Floats, together: Callable[[Floats, Floats], Floats]
) -> Floats:
    """Return what the errors of the corners of n triangles come to, (n,) metres.

    `together` makes one of the errors of k corners (3, k) and the barycentrics (3, k).
    """
    eye = scene.camera.origin
    far = np.abs(positions - eye).sum(axis=1)
    error = _MODEL * (np.abs(eye).sum() + far) + _VIEW * (2 * np.abs(eye).sum() + far)
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
        own = _MODEL * model + _VIEW * (p + np.abs(eye).sum())
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


@dataclass(frozen=True)
class Storage:
    """How a picture's colours were rounded before they are compared."""

    levels: int = 0  # above 0, of a file that stores sRGB's curve in integers: 255; 0 for floats
    dither: float = 0.0  # noise that was added, in levels
    sums: int = 0  # how many samples were added up in half floats; 0 for one
    opaque: bool = False  # there is no alpha, which is not compared then


FLOATS = Storage()


def differing(
    first: Array,
    second: Array,
    interpolated: Bools | bool = False,
    stored: Storage = FLOATS,
) -> Bools:
    """Return which pixels of two (..., c) pictures differ by more than :func:`difference` allows.

    What is not finite differs from everything.
    """
    if stored.levels:
        alike = (first == second) & np.isfinite(first)
    else:  # as much is always allowed, and mostly they are nearer; NaN and infinity are not less
        with np.errstate(invalid="ignore", over="ignore"):
            alike = np.abs(first - second) < LEAST_STEP
    out = ~alike.all(axis=-1)
    first, second = first[out], second[out]
    between = np.broadcast_to(interpolated, out.shape)[out]
    apart, allowed = difference(first, second, between, stored)
    finite = np.isfinite(first) & np.isfinite(second)
    out[out] = ~((apart <= allowed) & finite).all(axis=-1)
    return out


def differing_pixels(first: Array, second: Array) -> Bools:
    """Return which pixels of two pictures (h, w, c) differ, as :func:`differing`: a run at once."""
    flat = (picture.reshape(-1, picture.shape[-1]) for picture in (first, second))
    return by_runs(differing, *flat).reshape(first.shape[:-1])


def difference(
    first: Array,
    second: Array,
    interpolated: Bools | bool = False,
    stored: Storage = FLOATS,
) -> tuple[Floats, Floats]:
    """Return how far two pictures are apart, and how far rounding may have put them, (..., c).

    Of floats, HALF_UNITS in a half float's last place are allowed, but at least LEAST_STEP, and
    half a unit for each addition. Of a file with integers, half a level and the noise are allowed
    in place of that; with 16 bits, HALF_UNITS, too.

    Parameters
    ----------
    first, second : (..., c) float
        Linear colours, or linear RGBA.
    interpolated : (...) bool
        Where a colour lies between those of corners, and INTERPOLATED more is allowed.
    stored : Storage
        How the second picture was rounded.
    """
    levels = stored.levels
    first, second = first.astype(np.float64), second.astype(np.float64)
    more = INTERPOLATED * np.asarray(interpolated, dtype=np.float64)[..., None]
    if levels:
        first, second = encoded(first), encoded(second)
    with np.errstate(invalid="ignore"):
        apart = np.abs(first - second)
        if levels:  # a half float's units are of (e + 0.055) / 2.4 at most, by the curve's slope
            halves = HALF_UNITS * 2.0**-10 / 2.4 * (np.maximum(first, second) + 0.055)
            step = (0.5 + LEVEL_SLACK + stored.dither) / levels
            return apart, step + (levels > 255) * halves + more
        size = np.maximum(np.abs(first), np.abs(second))
        unit = np.spacing(np.minimum(size, 2.0**15).astype(np.float16))  # the last binade
        unit = unit.astype(np.float64)
        more = more + stored.sums / 2 * np.maximum(unit, LEAST_SUM)
        return apart, np.maximum(HALF_UNITS * unit, LEAST_STEP) + more


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
        for y in range(0, height, together):
            first = max(0, y - reach)
            around = own[first : y + together + reach]
            # Errors that reach this far. Those up to half of it were spread before.
            ring = around > (reach / 2 if reach > 1 else 0)
            ring &= (around <= reach) | (reach >= most)
            if ring.any():
                largest = largest_within(np.where(ring, around, 0.0), reach)[y - first :]
                here = band[y : y + together]
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

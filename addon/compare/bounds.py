"""How far Blender's own arithmetic may move or recolour what a pixel shows.

Float32, snapping, the depth buffer, half floats and 8-bit files: these are bounds on *Blender's*
side; the tracer's own errors in float64 are far below them. U32 = 2^-24 is the rounding unit of
float32.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..images import encoded
from ..runs import run_starts
from ..scene import Camera, Scene
from ..tracer.camera import pixel_size
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.nearest import Hits
from ..tracer.progress import Work
from ..tracer.shading import by_mesh
from ..tracer.vector import transform_points

U32 = 2.0**-24
# Pixels: rasterisers keep eight bits of a vertex' position below the pixel. Where the machine's was
# measured to keep less, the comparison adds what is missing: see `Picture.snapping`.
SNAPPING = 1 / 256

# A vertex goes through three float32 products: model, view, projection. Of each component the
# model's has 4 roundings of terms whose absolute values sum up to |M| |v|; the view's has 4, and
# its matrix was inverted in float32 (8 more), of terms up to |p| + |o|. (p is the vertex in world
# space, v in its object's, o the camera; norms are sums of absolute values.) What a point of a
# triangle is off by is what its corners are off by, weighed by its barycentrics.
_MODEL, _VIEW = 4, 12
# The projection rounds a film position a few times more, and so does the division by w.
_FILM = 4
# A depth buffer has 24 bits; the depth itself comes from a product of 2 terms and a division.
_DEPTH_STEPS = 5

# Blender hands its viewport's colours over as half floats, 11 bits, and cuts off rather than
# rounds: 1 reads 0.9995. Next to an edge a window copies them once more, and up to 3 units in the
# last place are missing (measured in 4.3). So many units of the larger value are allowed.
HALF_UNITS = 4

# That copy lets a little of the neighbour through: beside a white pixel, black reads 3 * 2^-14
# (measured in 4.3). Eight such steps are allowed.
LEAST_STEP = 8 * 2.0**-14

# Workbench adds up the logarithms of 1 + a colour in half floats; of a dark one, this is lost.
LEAST_SUM = 2.0**-12

# A rasteriser interpolates a colour attribute between corners that it has rounded to 1/256 pixel,
# by an approximate 1/w: a ramp over a few pixels is off by as much as this (measured 0.0013).
INTERPOLATED = 2.0**-9

# What a writer's own rounding of sRGB's curve may add to half a level (float32, tables).
LEVEL_SLACK = 0.02

_ROWS = 64  # looked at together, at least, so that a step is short in large pictures


def view_error(scene: Scene, hits: Hits, positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far float32 may move what n rays hit in camera space, (n,) metres.

    Parameters
    ----------
    scene : Scene
    hits : Hits
        Each of something. Of an infinite plane Blender draws a polygon whose corners are stored
        around the camera, and their error is taken to grow with the distance from it.
    positions : (n, 3) float64
        Where they lie, in world space.
    """
    eye = scene.camera.origin
    far = np.abs(positions - eye).sum(axis=1)
    error = _MODEL * (np.abs(eye).sum() + far) + _VIEW * (2 * np.abs(eye).sum() + far)
    names = np.stack((hits.instance, hits.triangle))
    for mesh, rows in by_mesh(scene, hits.instance):
        # Pixels outnumber triangles, mostly: the corners are looked at once for a run of pixels.
        first = run_starts(*names[:, rows])
        instance, triangle = names[:, rows[first]]
        length = np.diff(first, append=len(rows))
        matrices, error[rows] = scene.instance_matrices[..., instance], 0.0
        for s, corner in zip(hits.s[:, rows], mesh.triangles[triangle].T, strict=True):
            v = mesh.vertices[corner].T
            p = np.abs(transform_points(matrices, v)).sum(axis=0)
            model = transform_points(np.abs(matrices), np.abs(v)).sum(axis=0)
            own = _MODEL * model + _VIEW * (p + np.abs(eye).sum())
            error[rows] += s * np.repeat(own, length)
    return U32 * error


def pixel_error(
    camera: Camera,
    depth: NDArray[np.float64],
    view: NDArray[np.float64],
    y: NDArray[np.float64] | float = 0.0,
) -> NDArray[np.float64]:
    """Return how far Blender's sample may lie from the pixel's centre, (n,) pixels.

    Snapping to 1/256 pixel, plus the error `view` (n,) of a point at `depth` (n,) on the film, at
    its height `y` (n,) there, in window units.
    """
    width, height = pixel_size(camera)
    steepest, projection = max(map(abs, vars(camera.window).values())), camera.projection
    moved = view * projection.slant(steepest)
    moved = moved / projection.scale(np.maximum(depth, camera.clip_start), y)
    film = _FILM * U32 * max(camera.width, camera.height)
    return SNAPPING + film + moved / min(width, height)


def depth_resolution(
    camera: Camera, depth: NDArray[np.float64], view: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far apart in depth Blender can tell two surfaces, (n,) metres.

    A 24-bit depth buffer holds f / (f - n) (1 - n / z) of a perspective camera, so a step at depth
    z is z^2 (f - n) / (f n) 2^-24; of an orthographic one (f - n) 2^-24. Both surfaces carry the
    error `view` (n,) besides.
    """
    near, far = camera.clip_start, camera.clip_end
    step = camera.projection.depth_step((far - near) * U32, depth, near, far)
    return _DEPTH_STEPS * step + 2 * view


def differing(
    first: NDArray, second: NDArray, interpolated: NDArray[np.bool_] | bool = False, *stored: float
) -> NDArray[np.bool_]:
    """Return which pixels of two (..., c) pictures differ by more than :func:`difference` allows.

    `stored` is as there. What is not finite differs from everything.
    """
    size = np.maximum(np.abs(first), np.abs(second))
    apart, allowed = difference(first, second, interpolated, *stored)
    with np.errstate(invalid="ignore"):
        return ~((apart <= allowed) & np.isfinite(size)).all(axis=-1)


def difference(
    first: NDArray,
    second: NDArray,
    interpolated: NDArray[np.bool_] | bool = False,
    levels: int = 0,
    sums: int = 0,
    dither: float = 0.0,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how far two pictures are apart, and how far rounding may have put them, (..., c).

    HALF_UNITS of a half float's last place are allowed, but at least LEAST_STEP; where a colour is
    `interpolated` (...), INTERPOLATED more. Where the second picture was stored in so many `levels`
    above 0 of sRGB's curve, as a PNG is, half a level and `dither` levels of noise are allowed in
    place of that; of 16 bits, HALF_UNITS, too. A mean of `sums` samples, added up in half
    floats, loses half a unit with each.
    """
    first, second = first.astype(np.float64), second.astype(np.float64)
    more = INTERPOLATED * np.asarray(interpolated, dtype=np.float64)[..., None]
    if levels:
        first, second = encoded(first), encoded(second)
    with np.errstate(invalid="ignore"):
        apart = np.abs(first - second)
        if levels:  # a half float's units are of (e + 0.055) / 2.4 at most, by the curve's slope
            halves = HALF_UNITS * 2.0**-10 / 2.4 * (np.maximum(first, second) + 0.055)
            return apart, (0.5 + LEVEL_SLACK + dither) / levels + (levels > 255) * halves + more
        size = np.maximum(np.abs(first), np.abs(second))
        unit = np.spacing(np.minimum(size, 2.0**15).astype(np.float16))  # the last binade
        unit = unit.astype(np.float64)
        more = more + sums / 2 * np.maximum(unit, LEAST_SUM)
        return apart, np.maximum(HALF_UNITS * unit, LEAST_STEP) + more


def sample_band(scene: Scene, frame: Frame, all_rows: list[slice]) -> Work[NDArray[np.float64]]:
    """Return how far from each pixel's centre Blender's sample may lie, (h, w) pixels.

    It is the largest of the surfaces seen in the 3 x 3 pixels around, and of those farther off that
    float32 may move as far as this. Some rows are looked at together.
    """
    own, camera = np.zeros(frame.shape), scene.camera  # of what the pixel itself shows
    for number, rows in enumerate(all_rows):
        hits = frame.hits(rows)
        seen = np.flatnonzero(hits.instance != NOTHING)
        hits = hits.take(seen)
        view = view_error(scene, hits, frame.positions(rows)[seen])
        below = camera.region.y0 + (rows.start or 0) + 0.5
        y = camera.window.bottom + (seen // frame.shape[1] + below) * pixel_size(camera)[1]
        own[rows].reshape(-1)[seen] = pixel_error(camera, hits.t, view, y)
        yield number / len(all_rows)
    return (yield from spread_error(own))


def spread_error(own: NDArray[np.float64]) -> Work[NDArray[np.float64]]:
    """Return SNAPPING, or what is larger of those whose surface may move as far as the pixel.

    `own` (h, w) is how far, in pixels; it counts in a square that reaches as far as the power of
    two above it.
    """
    band = np.full(own.shape, SNAPPING)
    reach, height, most = 1, len(own), max(own.shape)
    while True:
        together = max(_ROWS, 2 * reach)
        for y in range(0, height, together):
            first = max(0, y - reach)
            around = own[first : y + together + reach]
            # Those that reach so far, but not to half of it: they were looked at before.
            ring = around > (reach / 2 if reach > 1 else 0)
            ring &= (around <= reach) | (reach >= most)
            if ring.any():
                largest = largest_within(np.where(ring, around, 0.0), reach)[y - first :]
                here = band[y : y + together]
                np.maximum(here, largest[: len(here)], out=here)
            yield 1.0
        if reach >= most:
            return band
        reach *= 2


def largest_within(values: NDArray, reach: int) -> NDArray:
    """Return the largest of (h, w) values that are at most `reach` rows and columns away."""
    for axis in (0, 1):
        values = np.moveaxis(values, axis, 0).copy()
        done = 0  # so far away has been looked
        while done < min(reach, len(values)):
            step = min(max(done, 1), reach - done)
            before = values.copy()
            np.maximum(values[step:], before[:-step], out=values[step:])
            np.maximum(values[:-step], before[step:], out=values[:-step])
            done += step
        values = np.moveaxis(values, 0, axis)
    return values

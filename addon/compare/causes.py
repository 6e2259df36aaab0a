"""Why a pixel differs: each cause is a check that can fail, with its figure kept for the pixel.

In come two pictures of one scene and what was traced; out goes a cause for every pixel that
differs. A cause is only given where the tracer itself, asked again, sees what Blender shows, or
where the manifest names something in that place that the tracer does not model.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..manifest import Unmodelled
from ..scene import Camera, Scene
from ..tracer import shading
from ..tracer.camera import pixel_size, project
from ..tracer.frame import Frame
from ..tracer.progress import Work, result_of, scaled
from ..tracer.render import tiles
from ..tracer.visibility import NOTHING
from .again import look_again
from .bounds import SNAPPING, pixel_error, view_error
from .cause import Cause, Causes, Settler, differing

DECIDABLE = 0.5  # pixels: within a larger band, what lies there explains nothing


def find_causes(
    scene: Scene,
    frame: Frame,
    picture: NDArray[np.float32],
    unmodelled: Sequence[Unmodelled] = (),
    sample_radius: float = 0.0,
) -> Work[Causes]:
    """Give every pixel of a picture its cause.

    Parameters
    ----------
    scene, frame
        What was traced, and what it gave.
    picture : (h, w, 4) float32
        Blender's.
    unmodelled : sequence of Unmodelled
        From the manifest.
    sample_radius : float
        How far from a pixel's centre Blender samples it on purpose, in pixels.

    Yields
    ------
    float
        Share of the work done.
    """
    region, shape = scene.camera.region, frame.t.shape
    out = Causes(np.zeros(shape, np.uint8), np.full(shape, np.nan), np.full(shape, np.nan))
    settle = Settler(out, np.zeros(shape, bool))
    all_rows = [slice(t.y0 - region.y0, t.y1 - region.y0) for t in tiles(scene.camera)]
    band = yield from scaled(_sample_band(scene, frame, all_rows), 0.0, 0.1)
    band += sample_radius
    for rows in all_rows:
        part = settle.rows(rows)
        ramp = shading.interpolated(scene, frame.instance_index[rows])
        part.open[:] = differing(frame.color[rows], picture[rows], ramp)
        part(~frame.rows_done[rows, None], Cause.NOT_TRACED)
        # Not only where the pictures differ: a pixel that agrees by accident proves nothing.
        part(band[rows] > DECIDABLE, Cause.NOT_DECIDABLE, band[rows], DECIDABLE)
        yield 0.1
    yield from scaled(look_again(scene, picture, band, settle), 0.1, 0.9)
    for number, feature in enumerate(unmodelled):
        if not settle.open.any():
            break
        if feature.everywhere:
            settle(settle.open, Cause.NOT_MODELLED, float(number))
        elif feature.bounds is not None:
            inside = settle.open & covered(scene.camera, feature.bounds)
            settle(inside, Cause.NOT_MODELLED, float(number))
        yield 1.0
    settle(settle.open, Cause.UNEXPLAINED)
    return out


def sample_band(scene: Scene, frame: Frame) -> NDArray[np.float64]:
    """Return how far from each pixel's centre Blender's sample may lie, (h, w) pixels.

    It is the largest of the surfaces seen in the 3 x 3 pixels around, and of those farther off that
    float32 may move as far as this.
    """
    return result_of(_sample_band(scene, frame, [slice(None)]))


def _sample_band(scene: Scene, frame: Frame, all_rows: list[slice]) -> Work[NDArray[np.float64]]:
    """Do the work of :func:`sample_band`, some rows at a time."""
    own = np.zeros(frame.t.shape)  # of the surface that the pixel itself shows
    for number, rows in enumerate(all_rows):
        hits = frame.hits(rows)
        seen = np.flatnonzero(hits.instance != NOTHING)
        hits = hits.take(seen)
        view = view_error(scene, hits, frame.positions(rows)[seen])
        own[rows].reshape(-1)[seen] = pixel_error(scene.camera, hits.t, view)
        yield number / len(all_rows)
    band = np.full(own.shape, SNAPPING)
    reach, most = 1, max(own.shape)
    while True:
        # Those that reach so far, but not to half of it: they were looked at before.
        ring = (own > reach / 2 if reach > 1 else own > 0) & ((own <= reach) | (reach >= most))
        if ring.any():
            np.maximum(band, _largest_within(np.where(ring, own, 0.0), reach), out=band)
        yield 1.0
        if reach >= most:
            return band
        reach *= 2


def _largest_within(values: NDArray[np.float64], reach: int) -> NDArray[np.float64]:
    """Return the largest value at most `reach` rows and columns away."""
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


def covered(camera: Camera, bounds: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    r = camera.region
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8)
    (x, y, depth), _ = project(camera, corners)
    out = np.zeros((r.height, r.width), bool)
    if depth.max() < camera.clip_start or depth.min() > camera.clip_end:
        return out
    if not camera.orthographic:
        if depth.min() <= camera.clip_start:
            return ~out  # around the eye: anywhere
        x, y = x / depth, y / depth
    (width, height), w = pixel_size(camera), camera.window
    px, py = (x - w.left) / width, (y - w.bottom) / height
    x0, x1 = int(max(np.floor(px.min()) - r.x0, 0)), int(np.ceil(min(px.max(), r.x1)) - r.x0)
    y0, y1 = int(max(np.floor(py.min()) - r.y0, 0)), int(np.ceil(min(py.max(), r.y1)) - r.y0)
    out[y0 : max(y1, 0), x0 : max(x1, 0)] = True
    return out

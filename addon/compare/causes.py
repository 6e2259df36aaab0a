"""Why a pixel differs: each cause is a check that can fail, with its figure kept for the pixel.

In come two pictures of one scene and what was traced; out goes a cause for every pixel that
differs. A cause is only given where the tracer itself, asked again, sees what Blender shows, or
where the manifest names something in that place that the tracer does not model.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ..manifest import Unmodelled
from ..scene import Camera, Scene
from ..tracer import shading
from ..tracer.camera import film_of
from ..tracer.frame import Frame
from ..tracer.progress import Work, scaled
from ..tracer.render import tiles
from . import transforms
from .again import look_again
from .alternatives import Alternative, look_elsewhere
from .band import sample_bands
from .boundary import boundary
from .cause import Cause, Causes, Hidden, Settler, difference
from .clip import look_beyond
from .mixing import look_around
from .shown import Shown

DECIDABLE = 0.5  # pixels: within a larger band, what lies there explains nothing


def find_causes(
    scene: Scene,
    frame: Frame,
    picture: NDArray[np.float32] | Shown,
    unmodelled: Sequence[Unmodelled] = (),
    sample_radius: float = 0.0,
    filter_radius: float = 0.0,
    absent: Mapping[int, Hidden] | None = None,
    alternatives: Sequence[Alternative] = (),
    curves: Sequence[transforms.Named] | None = None,
    at_most: int | None = None,
) -> Work[Causes]:
    """Give every pixel of a picture its cause.

    Parameters
    ----------
    scene, frame
        What was traced, and what it gave.
    picture : (h, w, 4) float32, or Shown
        Blender's, with whose surfaces it shows if that is known.
    unmodelled : sequence of Unmodelled
        From the manifest.
    sample_radius : float
        How far from a pixel's centre Blender samples it on purpose, in pixels.
    filter_radius : float
        How far the filter reaches that mixes several samples of a pixel; 0 for one sample.
    absent : mapping of int to Hidden, optional
        Why an object, by its number among those that may be shown, is not traced.
    alternatives : sequence of Alternative
        The scene as it is with an object shown or hidden, or in another frame.
    curves : sequence of transforms.Named, optional
        What may have been done to the colours, besides what is always tried; None where nothing
        may have been.
    at_most : int, optional
        Look at no more than so many differing pixels, spread over the picture; the others keep
        AGREE, and are counted in `Causes.passed_over`.

    Yields
    ------
    float
        Share of the work done.
    """
    shown = picture if isinstance(picture, Shown) else Shown(picture)
    if any(u.everywhere and u.recolours for u in unmodelled):
        shown = shown.in_another_light()
    shape = frame.t.shape
    out = Causes(np.zeros(shape, np.uint8), np.full(shape, np.nan), np.full(shape, np.nan))
    settle = Settler(out, np.zeros(shape, bool))
    band = yield from scaled(_open(scene, frame, shown, sample_radius, settle), 0.0, 0.1)
    if at_most is not None:
        out.passed_over = _thin(settle.open, at_most)
    shown = _shades(frame, shown, curves, settle)
    yield from scaled(look_around(scene, shown, filter_radius, settle), 0.1, 0.1)
    yield from scaled(look_again(scene, shown, band, settle), 0.2, 0.6)
    yield from scaled(look_beyond(scene, shown, settle), 0.8, 0.1)
    for number, feature in enumerate(unmodelled):
        if feature.bounds is not None and not feature.everywhere and settle.open.any():
            inside = settle.open & covered(scene.camera, feature.bounds)
            settle(inside, Cause.NOT_MODELLED, float(number))
            yield 0.9
    _absent(shown, absent or {}, settle)
    yield from scaled(look_elsewhere(frame, shown, alternatives, band, settle), 0.9, 0.1)
    for number, feature in enumerate(unmodelled):
        if feature.everywhere:
            allowed = settle.open
            if feature.recolours:  # light does not put another object there
                allowed = allowed & ~shown.other_object(frame.instance_index)
            settle(allowed, Cause.NOT_MODELLED, float(number))
    settle(settle.open, Cause.UNEXPLAINED)
    return out


def _open(
    scene: Scene, frame: Frame, shown: Shown, sample_radius: float, settle: Settler
) -> Work[NDArray[np.float64]]:
    """Open the pixels that differ, but those of which nothing can be said; return the band."""
    region = scene.camera.region
    all_rows = [slice(t.y0 - region.y0, t.y1 - region.y0) for t in tiles(scene.camera)]
    band = yield from sample_bands(scene, frame, all_rows)
    band += sample_radius
    for rows in all_rows:
        part, here, seen = settle.rows(rows), shown.at(rows), frame.instance_index[rows]
        ramp = shading.interpolated(scene, seen)
        part.open[:] = here.other_object(seen) | here.other_color(frame.color[rows], ramp)
        part(~frame.rows_done[rows, None], Cause.NOT_TRACED)
        # Not only where the pictures differ: a pixel that agrees by accident proves nothing.
        part(band[rows] > DECIDABLE, Cause.NOT_DECIDABLE, band[rows], DECIDABLE)
        yield 1.0
    return band


def _thin(open_: NDArray[np.bool_], most: int) -> int:
    """Close open pixels but so many; return how many were closed."""
    found = np.flatnonzero(open_)
    if len(found) <= most:
        return 0
    kept = found[np.linspace(0, len(found) - 1, most).astype(int)]
    open_[:] = False
    open_.flat[kept] = True
    return len(found) - len(kept)


def _shades(
    frame: Frame,
    shown: Shown,
    curves: Sequence[transforms.Named] | None,
    settle: Settler,
) -> Shown:
    """Settle the pixels that show the same object in another shade; return how to see the rest."""
    same = shown.same_object(frame.instance_index)
    if shown.lit:
        left, _ = difference(frame.color, shown.color)
        settle(settle.open & same, Cause.COLOR, left.max(axis=-1), 1.0)
        settle.out.transform = "light that the tracer does not have"
        return shown
    if curves is None or not settle.open.any():
        return shown
    found = transforms.find(frame, shown, settle.open & ~boundary(frame), curves)
    if found is None:
        return shown
    settle.out.transform = found.name
    shown = shown.through(found.of)
    left, allowed = shown.difference(frame.color)
    alike = ~shown.other_color(frame.color) & ~shown.other_object(frame.instance_index)
    settle(settle.open & alike, Cause.COLOR, left, allowed)
    return shown


def _absent(shown: Shown, absent: Mapping[int, Hidden], settle: Settler) -> None:
    """Settle pixels that are known to show an object that the tracer was told to leave out."""
    for number, hidden in absent.items():
        where = settle.open & (shown.owner == number)
        if where.any():
            settle.out.hidden.append(hidden)
            settle(where, Cause.HIDDEN, float(len(settle.out.hidden) - 1))


def covered(camera: Camera, bounds: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which pixels of the camera's region a world-space box (2, 3) may cover, (h, w)."""
    r = camera.region
    corners = np.array(np.meshgrid(*bounds.T)).reshape(3, 8)
    px, py, depth = film_of(camera, corners)
    out = np.zeros((r.height, r.width), bool)
    if depth.max() < camera.clip_start or depth.min() > camera.clip_end:
        return out
    if not camera.projection.is_parallel and depth.min() <= camera.clip_start:
        return ~out  # around the eye: anywhere
    x0, x1 = int(max(np.floor(px.min()) - r.x0, 0)), int(np.ceil(min(px.max(), r.x1)) - r.x0)
    y0, y1 = int(max(np.floor(py.min()) - r.y0, 0)), int(np.ceil(min(py.max(), r.y1)) - r.y0)
    out[y0 : max(y1, 0), x0 : max(x1, 0)] = True
    return out

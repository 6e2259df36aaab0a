"""How far from a pixel's centre a renderer's sample may lie, as float32 moves surfaces: its band.

Found for the pixels that are asked for. The others need not be looked at where what is known of
the objects bounds them all.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary, proxy

import numpy as np

from ..arrays import Bools, Floats, Index, parts, places
from ..certainty import Certainty
from ..scene import Scene
from ..tracer.camera import camera_rays, film_positions, pixel_size
from ..tracer.frame import Frame
from ..tracer.hits import NOTHING
from ..tracer.progress import Work
from ..tracer.shading import positions
from ..tracer.world import depth_ranges
from .bounds import DECIDABLE, SNAPPING, pixel_error, spread_error
from .renderers import RASTER, Renderer

_TOGETHER = 1 << 15  # pixels bounded in one step
_FEW = 16  # fewer than one in 16 pixels are few: each is bounded by itself
_REACH = 1.0  # pixels: a band up to this comes from the 3 x 3 pixels around alone
_ENDS = 4  # one of so many pixels is few enough to be asked for a bound of the others
_SLACK = 1 + 2.0**-10  # far above what rounding adds to a bound

# By frame, for as long as it is there.
_BANDS: WeakKeyDictionary[Frame, dict[tuple[Scene, Renderer], SampleBand]] = WeakKeyDictionary()


def band_of(scene: Scene, frame: Frame, renderer: Renderer = RASTER) -> SampleBand:
    """Return the band of a frame, and what is known of it already if the frame is whole.

    Pictures with a fault are held against the same frame.
    """
    known = _BANDS.setdefault(frame, {}) if frame.rows_done.all() else {}
    key = scene, renderer
    if key not in known:
        known[key] = SampleBand(scene, frame, renderer)
    return known[key]


class SampleBand:
    """How far from the centres a renderer's samples may lie.

    That is the largest error of the surfaces seen in the 3 x 3 pixels around a pixel, and of those
    farther away that float32 may move as far as this pixel.

    Attributes
    ----------
    values : (h, w) float64
        Pixels; NaN where it was not requested.
    most : float
        None is larger than this.
    """

    def __init__(self, scene: Scene, frame: Frame, renderer: Renderer) -> None:
        self.values = np.full(frame.shape, np.nan)
        self._scene, self._renderer = scene, renderer
        self._frame: Frame = proxy(frame)  # which is to go once nobody else needs it
        self.most = _most(scene, frame, renderer)

    def find(self, asked: Bools) -> Work[None]:
        """Find the values of the pixels asked (h, w); of all where that takes no longer."""
        left = asked & np.isnan(self.values)
        if self.most <= _REACH and _FEW * left.sum() < left.size:
            yield from self._find_some(*places(left))
        elif left.any():
            yield from self._find_all()

    def _find_some(self, row: Index, column: Index) -> Work[None]:
        height, width = self.values.shape
        for part in parts(len(row), _TOGETHER // 9):
            around = [
                np.clip(row[part] + y, 0, height - 1) * width
                + np.clip(column[part] + x, 0, width - 1)
                for y in (-1, 0, 1)
                for x in (-1, 0, 1)
            ]
            pixel, place = np.unique(around, return_inverse=True)
            largest = self._own(pixel)[place].reshape(9, -1).max(axis=0)
            self.values[row[part], column[part]] = np.maximum(largest, self._renderer.snapping)
            yield None

    def _find_all(self) -> Work[None]:
        own = np.zeros(self.values.shape)
        for _ in self._frame.measures.steps(slice(None)):
            yield None
        for part in parts(own.size, _TOGETHER):
            own.flat[part] = self._own(np.arange(own.size)[part])
            yield None
        smallest = float(np.min(own, where=own > 0, initial=SNAPPING))
        least = max(self._renderer.snapping, smallest)
        self.values[:] = yield from spread_error(own, least)

    def _own(self, pixel: Index) -> Floats:
        """Return the errors of the surfaces that n pixels show, (n,) pixels; 0 for none."""
        every = self._frame.hits()
        out = np.zeros(len(pixel))
        seen = np.flatnonzero(every.instance[pixel] != NOTHING)
        pixel, hits = pixel[seen], every.take(pixel[seen])
        camera = self._scene.camera
        rays = camera_rays(camera, *film_positions(camera.region, pixel=pixel))
        view = self._renderer.sideways(self._scene, hits, positions(rays, hits))
        row = pixel // camera.region.width + camera.region.y0
        y = camera.window.bottom + (row + 0.5) * pixel_size(camera)[1]
        out[seen] = pixel_error(camera, hits.t, view, y, self._renderer.snapping)
        return out


def _most(scene: Scene, frame: Frame, renderer: Renderer) -> float:
    """Return what no band of a frame is larger than; infinity where only all of them tell.

    No point of an object lies nearer than its box. Of objects whose box reaches to the camera, as
    a floor's does, it is asked how deep they are seen: that is least at an end of a row's pixels
    of one triangle.
    """
    camera = scene.camera
    is_proven = (frame.certainty != Certainty.NOT_CERTIFIED).all()
    bounded = is_proven and camera.projection.is_linear and not scene.planes
    if not renderer.most or not bounded:
        return np.inf
    seen = np.bincount(frame.instance_index.ravel() + 1, minlength=1 + len(scene.instances))[1:] > 0
    with np.errstate(all="ignore"):
        view = renderer.most(scene) * _SLACK

    def errors(depth: Floats) -> Floats:
        with np.errstate(all="ignore"):
            return pixel_error(camera, depth / _SLACK, view, snapping=renderer.snapping)

    most = errors(depth_ranges(scene)[0])
    wide = seen & ~(most <= DECIDABLE)
    if wide.any():
        ends = np.flatnonzero(_ends(frame) & np.append(wide, False)[frame.instance_index])
        if _ENDS * len(ends) > frame.certainty.size:
            return np.inf
        depth = np.full(len(seen), np.inf)
        instance = frame.instance_index.ravel()[ends]
        np.minimum.at(depth, instance, frame.measures.some(ends)[0])
        most = np.where(wide, errors(depth), most)
    return float(np.max(most[seen], initial=renderer.snapping))


def _ends(frame: Frame) -> Bools:
    """Return the first and the last pixel (h, w) of each triangle in a row."""
    height, width = frame.shape
    new = np.ones((height, width + 1), bool)
    new[:, 1:-1] = False
    for names in (frame.instance_index, frame.triangle_index):
        new[:, 1:-1] |= names[:, 1:] != names[:, :-1]
    return new[:, :-1] | new[:, 1:]

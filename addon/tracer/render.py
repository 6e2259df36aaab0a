"""Renders a scene into a frame, band by band: traces rays, shades what they see, reports progress.

`steps` is the loop. A render engine, a modal operator and a script drive it, each with its own
way to show progress and to stop. A step takes some ten milliseconds. How rays are traced is left to
a `Tracer`: `nearest.tracer` for the textbook and the other unproven methods.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, parts
from ..scene import Camera, Region, Scene
from .camera import Rays, camera_rays, film_positions
from .coloring import Color
from .frame import Frame
from .hits import Hits, Statistics
from .nearest import TraceBand
from .nearest import tracer as unproven_tracer
from .progress import Event, Progress, Work, scaled
from .settings import Settings

# Rows of a tile: enough to share work between rows, few enough that a cancelled picture has some.
ROWS = 32
PIXELS = 1 << 16  # of a tile, so that what is done for all of them at once is a short step
SLOW_PIXELS = 1 << 18  # of a band where pixels take long
RAYS = 1 << 23  # of a band where a pixel has many certified ones: a second or two
FINEST = 1 << 14  # pixels across, of a picture whose pixels are the samples
BYTES_PER_PIXEL = 224  # of a band: depth buffer, fragments, hits
WHOLE = 0.999  # of the progress, until the picture is whole

# Prepares to trace the bands of a picture by the settings' method, which is not `auto`. No ray
# passes farther from its pixel's centre than a reach, in pixels. It counts in the statistics.
Tracer = Callable[[Scene, Settings, float, Statistics], Work[TraceBand]]
Offset = tuple[float, float]  # where a ray passes its pixel's centre, in pixels
Shade = Callable[[Callable[[], Rays], Hits], NDArray[np.float32]]


@dataclass(frozen=True)
class Round:
    """One time that a picture is gone through: what is traced of each pixel, and shaded.

    The colour is the mean over the rays at `offsets`, else that of the ray through the centre.
    """

    offsets: tuple[Offset, ...]
    color: Color | None  # none: only what the centre rays meet is found
    is_traced: bool = False  # the centre rays are known from the round before

    def rays(self) -> list[Offset]:
        """Return where the rays that are traced pass their pixels' centres, in their order."""
        centre = [] if self.is_traced else [(0.0, 0.0)]
        return [*centre, *self.offsets]


def steps(
    scene: Scene, settings: Settings, frame: Frame, tracer: Tracer = unproven_tracer
) -> Iterator[Event]:
    """Trace a scene into an empty frame, in steps.

    The caller stops by not asking for more, and then calls `frame.cancel`. What the caller does
    between two steps does not count as time.
    """
    work = _steps(scene, settings, frame, tracer)
    statistics = frame.statistics
    while True:
        began = time.perf_counter()
        try:
            event = next(work)
        except StopIteration:
            return
        finally:
            statistics.seconds += time.perf_counter() - began
        yield event


def rounds(settings: Settings) -> list[Round]:
    """Return how often a picture is gone through, and for what."""
    offsets = tuple(sample_offsets(settings.samples)) if settings.samples > 1 else ()
    if settings.color is Color.DEPTH:  # its greys lie between the nearest and the farthest hit
        return [Round((), None), Round(offsets, settings.color, is_traced=True)]
    return [Round(offsets, settings.color)]


def rays_in_order(camera: Camera, settings: Settings) -> Iterator[tuple[Region, Offset]]:
    """Yield the bands of rays that a picture is made of, in the order in which they are traced.

    Whoever traces them elsewhere can walk them ahead of `steps`.
    """
    for each in rounds(settings):
        for band in bands(camera, settings):
            for offset in each.rays():
                yield band, offset


def _steps(scene: Scene, settings: Settings, frame: Frame, tracer: Tracer) -> Work[None]:
    """Trace a scene band by band, in each of its rounds."""
    statistics = frame.statistics
    statistics.method = settings.method.value
    statistics.triangles = scene.triangle_count
    every_round = rounds(settings)
    reach = max((abs(v) for each in every_round for at in each.offsets for v in at), default=0.0)
    trace_band = yield from tracer(scene, settings, reach, statistics)
    every_band = bands(scene.camera, settings)
    together = samples_together(scene.camera, settings)
    share = WHOLE / (len(every_round) * len(every_band))
    done = 0.0
    for each in every_round:
        depths = frame.depths() if each.is_traced else (0.0, 0.0)
        shade = partial(each.color.of, scene, depths) if each.color else None
        for band in every_band:
            work = _Band(frame, band, each, shade, together and bool(each.offsets))
            yield from scaled(work.steps(trace_band), done, share)
            done += share
            yield Progress(done)
    yield Progress(1.0)


@dataclass(frozen=True, eq=False)
class _Band:
    """A band of a frame in one round."""

    frame: Frame
    region: Region
    wanted: Round
    shade: Shade | None
    together: bool  # all samples are traced with the first

    @property
    def rows(self) -> slice:
        """The rows of the frame that the band covers."""
        first = self.frame.scene.camera.region.y0
        return slice(self.region.y0 - first, self.region.y1 - first)

    def steps(self, trace_band: TraceBand) -> Work[None]:
        """Trace and shade the band, and write it into the frame."""
        offsets = self.wanted.offsets
        starts, shares = self._shares()
        if self.wanted.is_traced:
            hits = self.frame.hits(self.rows)
        else:
            hits = yield from scaled(trace_band(self.region, 0.0, 0.0), 0.0, shares[0])
        color = np.zeros((len(hits) if offsets else 0, 4))
        for number, offset in enumerate(offsets, start=1):
            own = starts[number], shares[number]
            other = yield from scaled(trace_band(self.region, *offset), *own)
            for part in parts(len(hits), PIXELS // 2):
                color[part] += self._shaded(other.take(part), part, offset) / len(offsets)
                yield None
        yield from self._write(hits, color)

    def _shares(self) -> tuple[list[float], list[float]]:
        """Return where the work on the centres and on each sample begins, and their shares."""
        count = len(self.wanted.offsets)
        work = [1.0, *(1.0 for _ in range(count))]
        if self.together:  # the first of them finds all
            work[1:] = [count**0.5, *(0.1 * count**0.5 / count for _ in range(count - 1))]
        shares = [each / sum(work) for each in work]
        return [0.0, *accumulate(shares)][:-1], shares

    def _shaded(self, hits: Hits, part: slice, offset: Offset = (0.0, 0.0)) -> NDArray[np.float32]:
        """Return the colours of some of the band's rays, (n, 4)."""
        pixel = np.arange(part.start, part.start + len(hits))
        camera = self.frame.scene.camera
        assert self.shade
        return self.shade(
            lambda: camera_rays(camera, *film_positions(self.region, *offset, pixel)), hits
        )

    def _write(self, hits: Hits, color: Floats) -> Work[None]:
        """Enter the band's colours, and what its centre rays met, in small steps.

        Without colours yet, t is found at once: the colours of the whole picture depend on it.
        """
        frame, rows = self.frame, self.rows
        colors = frame.color[rows].reshape(-1, 4)
        if self.shade:
            for part in parts(len(hits), PIXELS // 2):
                has_samples = len(color) > 0
                colors[part] = color[part] if has_samples else self._shaded(hits.take(part), part)
                yield None
        if not self.wanted.is_traced:
            frame.enter(rows, hits)
        frame.rows_done[rows] = self.shade is not None
        if not self.shade:
            yield from frame.measures.steps(rows)


def sample_offsets(samples: int) -> list[Offset]:
    """Return where `samples` x `samples` rays pass a pixel's centre, in pixels."""
    at = [(i + 0.5) / samples - 0.5 for i in range(samples)]
    return [(dx, dy) for dy in at for dx in at]


def tiles(camera: Camera) -> list[Region]:
    """Split the camera's region into tiles of whole rows, from the lowest."""
    return _rows(camera.region, max(1, min(ROWS, PIXELS // camera.region.width)))


def bands(camera: Camera, settings: Settings) -> list[Region]:
    """Split the camera's region into bands that are traced together, from the lowest.

    The higher they are, the less often a triangle is read. They are limited by memory, and by
    the wish to see the picture grow where a pixel has many samples or every triangle is tested.
    """
    pixels = settings.memory // BYTES_PER_PIXEL
    is_slow = not settings.method.is_proven or not camera.projection.is_linear
    if samples_together(camera, settings):
        pixels //= settings.samples**2
    elif settings.samples > 1 or is_slow:
        rays = SLOW_PIXELS if is_slow else RAYS
        pixels = min(pixels, max(PIXELS, rays // settings.samples**2))
    return _rows(camera.region, max(1, pixels // camera.region.width))


def samples_together(camera: Camera, settings: Settings) -> bool:
    """Return whether a pixel's samples can be traced as pixels of a larger picture.

    Their number a direction is a power of two, so that no ray is rounded otherwise.
    """
    n = settings.samples
    is_proven = settings.method.is_proven and camera.projection.is_linear
    fits = n * max(camera.width, camera.height) <= FINEST
    fits &= n * n * camera.region.width * BYTES_PER_PIXEL <= settings.memory  # one row of pixels
    return is_proven and fits and n > 1 and n & (n - 1) == 0


def _rows(r: Region, rows: int) -> list[Region]:
    return [Region(r.x0, y, r.x1, min(y + rows, r.y1)) for y in range(r.y0, r.y1, rows)]

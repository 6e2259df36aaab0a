"""Scene + Settings -> Frame, tile by tile, with progress and cancelling.

`steps` is the one loop: a render engine, a modal operator and a script drive it, each with its
own way to show progress and to stop. A step takes some ten milliseconds.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from ..certainty import AssumptionError, check_assumptions
from ..certified.any_rays import trace_rays
from ..certified.plain import plain
from ..certified.rounding import rounding
from ..methods import Method
from ..scene import Camera, Region, Scene
from .camera import Rays, camera_rays, film_positions
from .coloring import Color
from .frame import Frame
from .hits import Hits, Statistics
from .nearest import plan, trace_tile
from .progress import Steps, Work, result_of, scaled, timed
from .settings import Precision, Settings
from .vector import parts
from .world import refused

try:
    from ..certified.sweep.sweep import sweep as certified
except ModuleNotFoundError as missing:
    # Where `sweep/` is deleted, but for what else may be in its folder, the definition finds the
    # same, later. Whatever else is missing is an error.
    if missing.name not in {f"{__package__}.certified.sweep{end}" for end in ("", ".sweep")}:
        raise
    certified = plain

# Rows of a tile: enough to share work between rows, few enough that a cancelled picture has some.
ROWS = 32
PIXELS = 1 << 16  # of a tile, so that what is done for all of them at once is a short step
SLOW_PIXELS = 1 << 18  # of a band where pixels take long
RAYS = 1 << 23  # of a band where a pixel has many certified ones: a second or two
BYTES_PER_PIXEL = 224  # of a band: depth buffer, fragments, hits
WHOLE = 0.999  # of the progress, until the picture is whole

# Finds the hits of a band's rays, which pass their pixels' centres at (dx, dy).
TraceBand = Callable[[Region, float, float], Work[Hits]]
# Where rays are traced: prepares to trace a scene's bands, by settings whose method is one. Rays
# pass their pixels' centres within a reach, in pixels; what it takes is counted. It is `here`.
Tracer = Callable[[Scene, Settings, float, Statistics], Work[TraceBand]]


def render(
    scene: Scene,
    settings: Settings | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
    tracer: Tracer | None = None,
) -> Frame:
    """Trace a scene.

    Parameters
    ----------
    progress : callable, optional
        Called with the share of the work that is done, 0 to 1; 1 only at the end.
    cancelled : callable, optional
        Asked after every step; once it says True, the frame is returned with the rows that are
        done, and marked `cancelled`.
    tracer : Tracer, optional
        Where rays are traced, if not here.

    Raises
    ------
    AssumptionError
        If the method is `certified`, and this process's arithmetic allows no proof.
    """
    frame = Frame.empty(scene)
    for share in steps(scene, settings or Settings(), frame, tracer):
        if progress:
            progress(share)
        if share < 1 and cancelled and cancelled():
            frame.cancel()
            break
    return frame


def steps(
    scene: Scene, settings: Settings, frame: Frame, tracer: Tracer | None = None
) -> Iterator[float]:
    """Trace a scene into an empty frame; yields the share of the work done after each step.

    The caller stops by not asking for more, and then calls `frame.cancel`. What the caller does
    between two steps does not count as time.
    """
    work, statistics = _steps(scene, settings, frame, tracer or here), frame.statistics
    share: float | None = 0.0
    while share is not None:
        began = time.perf_counter()
        share = next(work, None)
        statistics.seconds += time.perf_counter() - began
        if share is not None:
            yield share


def trace(
    scene: Scene, settings: Settings, statistics: Statistics | None = None, rays: Rays | None = None
) -> Hits:
    """Return what the rays through the centres of the region's pixels meet, and nothing else.

    Row by row from the lowest.

    Parameters
    ----------
    settings : Settings
        Of which the samples do not count.
    statistics : Statistics, optional
        To count in.
    rays : Rays, optional
        Any rays, in their place; t counts in the camera's clip range, in lengths of a direction.
        They are tested with every triangle, which takes as long as it sounds.
    """
    statistics = statistics or Statistics()
    settings = resolved(settings, statistics)
    if rays:
        return result_of(trace_rays(scene, rays, settings, statistics))
    tracer = result_of(here(scene, settings, 0.0, statistics))
    found = [result_of(tracer(band, 0.0, 0.0)) for band in bands(scene.camera, settings)]
    return Hits.joined(found)


def _steps(scene: Scene, settings: Settings, frame: Frame, tracer: Tracer) -> Iterator[float]:
    settings = resolved(settings, frame.statistics)
    frame.statistics.triangles = scene.triangle_count
    offsets = sample_offsets(settings.samples) if settings.samples > 1 else []
    reach = max((abs(o) for offset in offsets for o in offset), default=0.0)
    trace_band = yield from tracer(scene, settings, reach, frame.statistics)
    rounds, every = [(offsets, settings.color)], bands(scene.camera, settings)
    if settings.color is Color.DEPTH:  # whose greys are between the nearest and the farthest hit
        rounds.insert(0, ([], None))
    share = WHOLE / (len(rounds) * len(every))
    for k, (some, color) in enumerate(rounds):
        depths = frame.depths() if k else (0.0, 0.0)
        shade = color and partial(color.of, scene, depths)
        for number, band in enumerate(every, start=k * len(every)):
            work = _band(trace_band, band, some, shade, frame, is_traced=k > 0)
            yield from scaled(work, number * share, share)
    yield 1.0


def here(scene: Scene, settings: Settings, reach: float, statistics: Statistics) -> Work[TraceBand]:
    """Prepare to trace bands in this process; yields 0, as nothing is traced yet."""
    if not settings.method.is_plain:
        statistics.refused, statistics.rounding = refused(scene), str(rounding(scene))
        find = certified if scene.camera.projection.is_linear else plain
        return lambda band, dx, dy: find(scene, band, settings.memory // 2, dx, dy, statistics)
    made = yield from plan(scene, settings, reach)
    statistics.refused = made.refused
    return lambda band, dx, dy: trace_tile(made, band, dx, dy, statistics)


def resolved(settings: Settings, statistics: Statistics) -> Settings:
    """Return settings with a method that is one: `auto` is certified, where that is possible."""
    if not settings.method.is_plain:
        try:
            check_assumptions()
            settings = replace(settings, method=Method.CERTIFIED)
        except AssumptionError as error:
            if settings.method != Method.AUTO:
                raise
            settings = replace(settings, method=Method.WATERTIGHT, precision=Precision.FLOAT64)
            statistics.notes.append(f"traced by watertight in float64, as {error}")
    statistics.method = settings.method.value
    return settings


def _band(
    trace, band: Region, offsets: list, shade: Callable | None, frame: Frame, is_traced: bool
) -> Work[None]:
    """Trace a band through its pixels' centres and, for its colour, at these offsets from them.

    What is known of the centres already is not traced again. Without `shade` it is not done yet.
    """
    share, camera = 1 / (1 + len(offsets)), frame.scene.camera
    rows = slice(band.y0 - camera.region.y0, band.y1 - camera.region.y0)
    hits = frame.hits(rows)
    if not is_traced:
        hits = yield from scaled(trace(band, 0.0, 0.0), 0.0, share)

    def shaded(hits: Hits, part: slice, dx: float = 0.0, dy: float = 0.0) -> NDArray[np.float32]:
        pixel = np.arange(part.start, part.start + len(hits))
        return shade(lambda: camera_rays(camera, *film_positions(band, dx, dy, pixel)), hits)

    color = None
    for number, (dx, dy) in enumerate(offsets, start=1):
        other = yield from scaled(trace(band, dx, dy), number * share, share)
        if color is None:
            color = np.zeros((len(hits), 4))
        for part in parts(len(hits), PIXELS // 8):
            color[part] += shaded(other.take(part), part, dx, dy) / len(offsets)
            yield (number + 1) * share
    written = _write(frame, rows, hits, color, shade and shaded, is_traced)
    yield from timed(written, frame.statistics.stages, 1.0)


def sample_offsets(samples: int) -> list[tuple[float, float]]:
    """Return where `samples` x `samples` rays pass a pixel's centre, in pixels."""
    at = [(i + 0.5) / samples - 0.5 for i in range(samples)]
    return [(dx, dy) for dy in at for dx in at]


def tiles(camera: Camera) -> list[Region]:
    """Split the camera's region into tiles of whole rows, from the lowest."""
    return _rows(camera.region, max(1, min(ROWS, PIXELS // camera.region.width)))


def bands(camera: Camera, settings: Settings) -> list[Region]:
    """Split the camera's region into bands that are traced together, from the lowest.

    The higher they are, the less often a triangle is looked at. Memory limits them; and the wish to
    see the picture grow, where a pixel has many samples, or its triangles are all tested.
    """
    pixels = settings.memory // BYTES_PER_PIXEL
    if settings.samples > 1 or settings.method.is_plain:
        rays = SLOW_PIXELS if settings.method.is_plain else RAYS
        pixels = min(pixels, max(PIXELS, rays // settings.samples**2))
    return _rows(camera.region, max(1, pixels // camera.region.width))


def _rows(r: Region, rows: int) -> list[Region]:
    return [Region(r.x0, y, r.x1, min(y + rows, r.y1)) for y in range(r.y0, r.y1, rows)]


def _write(
    frame: Frame,
    rows: slice,
    hits: Hits,
    color: NDArray | None,
    shaded: Callable | None,
    is_entered: bool,
) -> Steps[None]:
    """Enter a band's colour, and what the rays through its pixels' centres met, in small steps.

    Without a colour, their t is found already: the colours of the whole picture are by it.
    """
    colors = frame.color[rows].reshape(-1, 4)
    for part in parts(len(hits), PIXELS // 8) if shaded else ():
        colors[part] = shaded(hits.take(part), part) if color is None else color[part]
        yield "shade"
    if not is_entered:
        frame.enter(rows, hits)
    frame.rows_done[rows] = shaded is not None
    for _ in () if shaded else frame.measures.steps(rows):
        yield "rounding"

"""Scene + Settings -> Frame, tile by tile, with progress and cancelling.

`steps` is the one loop: a render engine, a modal operator and a script drive it, each with its
own way to show progress and to stop. A step takes some ten milliseconds.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Region, Scene
from . import shading
from .camera import camera_rays
from .certainty import AssumptionError, check_assumptions
from .frame import Frame
from .hits import Hits
from .progress import Work, scaled
from .settings import Method, Precision, Settings
from .visibility import Plan, film_positions, plan, trace_tile

# Rows of a tile: enough to share work between rows, few enough that a cancelled picture has some.
ROWS = 32
PIXELS = 1 << 16  # of a tile, so that what is done for all of them at once is a short step
_WHOLE = 0.999  # of the progress, until the picture is whole


def render(
    scene: Scene,
    settings: Settings | None = None,
    progress: Callable[[float], None] | None = None,
    cancelled: Callable[[], bool] | None = None,
) -> Frame:
    """Trace a scene.

    Parameters
    ----------
    scene : Scene
    settings : Settings, optional
    progress : callable, optional
        Called with the share of the work that is done, 0 to 1; 1 only at the end.
    cancelled : callable, optional
        Asked after every step; once it says True, the frame is returned with the rows that are
        done, and marked `cancelled`.

    Returns
    -------
    Frame

    Raises
    ------
    AssumptionError
        If the method is `certified`, and this process's arithmetic allows no proof.
    """
    frame = Frame.empty(scene.camera)
    for share in steps(scene, settings or Settings(), frame):
        if progress:
            progress(share)
        if share < 1 and cancelled and cancelled():
            frame.cancelled = True
            break
    return frame


def steps(scene: Scene, settings: Settings, frame: Frame) -> Iterator[float]:
    """Trace a scene into an empty frame; yields the share of the work done after each step.

    The caller stops by not asking for more, and then sets `frame.cancelled`. What the caller does
    between two steps does not count as time.
    """
    work, statistics = _steps(scene, settings, frame), frame.statistics
    share: float | None = 0.0
    while share is not None:
        began = time.perf_counter()
        share = next(work, None)
        statistics.seconds += time.perf_counter() - began
        if share is not None:
            yield share


def _steps(scene: Scene, settings: Settings, frame: Frame) -> Iterator[float]:
    settings = _resolved(settings, frame)
    frame.statistics.triangles = scene.triangle_count
    offsets = sample_offsets(settings.samples) if settings.samples > 1 else []
    reach = max((abs(o) for offset in offsets for o in offset), default=0.0)
    made = yield from plan(scene, settings, reach)
    frame.statistics.refused = made.refused
    all_tiles = tiles(scene.camera)
    for number, tile in enumerate(all_tiles):
        tracing = _trace(made, tile, offsets, frame)
        yield from scaled(tracing, _WHOLE * number / len(all_tiles), _WHOLE / len(all_tiles))
    yield 1.0


def _resolved(settings: Settings, frame: Frame) -> Settings:
    """Return settings with a method that is one: `auto` is certified, where that is possible."""
    if not settings.method.is_plain:
        try:
            check_assumptions()
            settings = replace(settings, method=Method.CERTIFIED)
        except AssumptionError as error:
            if settings.method != Method.AUTO:
                raise
            settings = replace(settings, method=Method.WATERTIGHT, precision=Precision.FLOAT64)
            frame.statistics.notes.append(f"traced by watertight in float64, as {error}")
    frame.statistics.method = settings.method.value
    return settings


def _trace(made: Plan, tile: Region, offsets: list, frame: Frame) -> Work[None]:
    """Trace a tile through its pixels' centres and, for its colour, at these offsets from them."""
    share = 1 / (1 + len(offsets))
    centre = yield from scaled(trace_tile(made, tile, statistics=frame.statistics), 0.0, share)
    color = (
        np.zeros((tile.width * tile.height, 4)) if offsets else shading.colors(made.scene, centre)
    )
    for number, (dx, dy) in enumerate(offsets, start=1):
        tracing = trace_tile(made, tile, dx, dy, frame.statistics)
        hits = yield from scaled(tracing, number * share, share)
        color += shading.colors(made.scene, hits) / len(offsets)
    _write(made, frame, tile, centre, color)


def sample_offsets(samples: int) -> list[tuple[float, float]]:
    """Return where `samples` x `samples` rays pass a pixel's centre, in pixels."""
    at = [(i + 0.5) / samples - 0.5 for i in range(samples)]
    return [(dx, dy) for dy in at for dx in at]


def tiles(camera: Camera) -> list[Region]:
    """Split the camera's region into bands of whole rows, from the lowest."""
    r = camera.region
    rows = max(1, min(ROWS, PIXELS // r.width))
    return [Region(r.x0, y, r.x1, min(y + rows, r.y1)) for y in range(r.y0, r.y1, rows)]


def _write(plan: Plan, frame: Frame, tile: Region, hits: Hits, color: NDArray) -> None:
    """Enter a tile's colour, and what the rays through its pixels' centres met."""
    scene = plan.scene
    rows = slice(tile.y0 - scene.camera.region.y0, tile.y1 - scene.camera.region.y0)
    rays = camera_rays(scene.camera, *film_positions(tile, 0.0, 0.0), plan.settings.precision.dtype)
    for target, value in (
        (frame.color, color),
        (frame.t, hits.t),
        (frame.position, shading.positions(rays, hits)),
        (frame.normal, shading.normals(scene, hits)),
        (frame.barycentrics, hits.s.T),
        (frame.object_index, shading.objects(scene, hits)),
        (frame.instance_index, hits.instance),
        (frame.triangle_index, hits.triangle),
        (frame.certainty, hits.certainty),
    ):
        target[rows] = np.asarray(value).reshape(target[rows].shape)
    first = rows.start * tile.width
    frame.ties.update((first + pixel, names) for pixel, names in hits.ties.items())
    frame.rows_done[rows] = True

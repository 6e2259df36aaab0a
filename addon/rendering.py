"""Renders a scene by any method: the table of methods, and what is chosen from it.

The loop over a picture is `tracer/render.py`. What differs between methods is how hits are found:

- an unproven method tests triangles in floating point (`tracer/nearest.py`);
- `certified` proves each answer: `certified/definition.py` says what is proven,
  `certified/plain.py` finds it, and `certified/sweep/` finds the same sooner where the picture is
  linear in the film position.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Literal, overload

from .certified import any_rays, plain
from .certified.arithmetic import AssumptionError, check_assumptions
from .certified.rounding import rounding
from .certified.samples import traced_together
from .certified.sweep.sweep import sweep
from .methods import UNPROVEN, Method
from .opened import only
from .scene import Scene, SceneError, finite
from .tracer import nearest
from .tracer import render as loop
from .tracer.camera import Rays, camera_rays, film_positions
from .tracer.frame import Frame
from .tracer.hits import Hits, Statistics
from .tracer.nearest import TraceBand
from .tracer.progress import Meter, Work, at_once, result_of
from .tracer.render import Tracer, bands
from .tracer.settings import Precision, Settings
from .tracer.world import refused

if TYPE_CHECKING:
    from reference_tracer_rays.every import Crossings

TraceRays = Callable[[Scene, Rays, Settings, Statistics], Work[Hits]]


@at_once
def certified_tracer(
    scene: Scene, settings: Settings, reach: float, statistics: Statistics
) -> TraceBand:
    """Prepare to trace bands of a picture with proof: nothing is traced yet."""
    statistics.refused = refused(scene)
    statistics.rounding = str(rounding(scene))
    find = sweep if scene.camera.projection.is_linear else plain.plain
    memory = settings.memory // 2
    return lambda band, dx, dy: find(scene, band, memory, dx, dy, statistics)


def certified_samples(
    scene: Scene, settings: Settings, reach: float, statistics: Statistics
) -> Work[TraceBand]:
    """Prepare as :func:`certified_tracer`, all samples at once: see `samples_together`."""
    centre = yield from certified_tracer(scene, settings, reach, statistics)
    find = partial(sweep, memory=settings.memory // 2, statistics=statistics)
    return traced_together(centre, find, scene, settings.samples)


# By method: what traces a picture's bands, and what traces any rays.
TRACERS: dict[Method, Tracer] = {
    **dict.fromkeys(UNPROVEN, nearest.tracer),
    Method.CERTIFIED: certified_tracer,
}
RAY_TRACERS: dict[Method, TraceRays] = {
    **dict.fromkeys(UNPROVEN, nearest.trace_rays),
    Method.CERTIFIED: any_rays.trace_rays,
}


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
        Traces the rays in place of the method's own, for instance on other machines.

    Raises
    ------
    AssumptionError
        If the method is `certified`, and this process's arithmetic allows no proof.
    """
    frame = Frame.empty(scene)
    meter = Meter()
    for event in steps(scene, settings or Settings(), frame, tracer):
        meter.read(event)
        if progress:
            progress(meter.share)
        if meter.share < 1 and cancelled and cancelled():
            frame.cancel()
            break
    return frame


def steps(
    scene: Scene, settings: Settings, frame: Frame, tracer: Tracer | None = None
) -> Work[None]:
    """Trace a scene into an empty frame, as `tracer.render.steps`, by any method.

    Raises
    ------
    AssumptionError
        If the method is `certified`, and this thread's arithmetic allows no proof, or no longer
        does: then the frame is empty.
    """
    chosen = resolved(settings, frame.statistics)
    own = certified_samples if loop.samples_together(scene.camera, chosen) else None
    try:
        yield from loop.steps(scene, chosen, frame, tracer or own or TRACERS[chosen.method])
    except AssumptionError as error:
        frame.withdraw()
        chosen = _unproven(settings, frame.statistics, error)
        yield from loop.steps(scene, chosen, frame, tracer or TRACERS[chosen.method])


def frame_of(scene: Scene, settings: Settings, tracer: Tracer | None = None) -> Work[Frame]:
    """Trace a scene in steps, as :func:`steps`, and return its frame."""
    frame = Frame.empty(scene)
    yield from steps(scene, settings, frame, tracer)
    return frame


@overload
def trace(
    scene: Scene,
    settings: Settings | None = None,
    statistics: Statistics | None = None,
    rays: Rays | None = None,
    every: Literal[False] = False,
) -> Hits: ...
@overload
def trace(
    scene: Scene,
    settings: Settings | None = None,
    statistics: Statistics | None = None,
    rays: Rays | None = None,
    *,
    every: Literal[True],
) -> Crossings: ...
def trace(
    scene: Scene,
    settings: Settings | None = None,
    statistics: Statistics | None = None,
    rays: Rays | None = None,
    every: bool = False,
) -> Hits | Crossings:
    """Return what the rays through the centres of the region's pixels meet, and nothing else.

    Row by row from the lowest.

    Parameters
    ----------
    settings : Settings
        The number of samples has no effect.
    statistics : Statistics, optional
        To count in.
    rays : Rays, optional
        Any rays to trace instead. The camera's clip range applies to t, in lengths of a direction.
        Where there are many, a tree of boxes says which triangles each may meet.
    every : bool
        Whether to return all that the rays meet, certified: see ``docs/every.md``. Nothing is
        counted then.

    Raises
    ------
    SceneError
        If a ray is not finite, as nothing is proven of it, or has no three coordinates. If `every`
        is asked for by a method that is not certified.
    """
    if every and settings and not settings.method.is_proven:
        raise SceneError(f"all hits are certified, and not traced by {settings.method}")
    statistics = statistics or Statistics()
    settings = resolved(settings or Settings(), statistics)
    if rays or every:
        rays = rays or camera_rays(scene.camera, *film_positions(scene.camera.region))
        for name in ("origins", "directions"):
            own = getattr(rays, name)
            count = 1 if own.shape[1] == 1 else rays.count
            finite(own, (3, count), f"The {name} of rays")
        o, d = (v.astype(settings.precision.dtype) for v in (rays.origins, rays.directions))
        rays = replace(rays, origins=o, directions=d)
        if every:
            clip = scene.camera.clip_start, scene.camera.clip_end
            return result_of(only("rays", "all hits of rays").all_hits(scene, rays, clip))
        return result_of(RAY_TRACERS[settings.method](scene, rays, settings, statistics))
    return result_of(hits(scene, settings, statistics))


def hits(scene: Scene, settings: Settings, statistics: Statistics) -> Work[Hits]:
    """Find what the rays through the centres of the region's pixels meet, by a known method."""
    trace_band = yield from TRACERS[settings.method](scene, settings, 0.0, statistics)
    found = []
    for band in bands(scene.camera, settings):
        found.append((yield from trace_band(band, 0.0, 0.0)))
    return Hits.joined(found)


def resolved(settings: Settings, statistics: Statistics) -> Settings:
    """Return settings with a method of the table: `auto` is certified where that is possible.

    Where it is not, it is watertight in float64, and a note in the statistics says why.

    Raises
    ------
    AssumptionError
        If the method is `certified`, and this process's arithmetic allows no proof.
    """
    if not settings.method.is_proven:
        return settings
    try:
        check_assumptions()
    except AssumptionError as error:
        return _unproven(settings, statistics, error)
    return replace(settings, method=Method.CERTIFIED)


def _unproven(settings: Settings, statistics: Statistics, why: AssumptionError) -> Settings:
    """Return the settings of `auto` where nothing can be certified; else raise why."""
    if settings.method != Method.AUTO:
        raise why
    statistics.notes.append(f"traced by watertight in float64, as {why}")
    return replace(settings, method=Method.WATERTIGHT, precision=Precision.FLOAT64)

"""What workers do: a scene and how it is traced come in, what they find goes out."""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache, wraps
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import reference_tracer
from distributed import get_worker
from reference_tracer.arrays import Floats
from reference_tracer.certified.measures import Measured
from reference_tracer.methods import Method
from reference_tracer.rendering import TRACERS, resolved
from reference_tracer.scene import Region, Scene
from reference_tracer.study import extremes, tradeoff
from reference_tracer.study.extremes import ExtremesRow
from reference_tracer.study.scenarios.sweeps import BY_NAME
from reference_tracer.study.trade import TradeRow
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.progress import Work
from reference_tracer.tracer.settings import Settings

T = TypeVar("T")
PROVEN = Settings(Method.CERTIFIED)
_PACKAGES, _CODE = (reference_tracer.__file__, __file__), (".py", ".toml")


@lru_cache(maxsize=1)
def about() -> str:
    """Return all that another version of may be another result, as JSON."""
    files = sorted(f for p in _PACKAGES for f in Path(p).parent.rglob("*") if f.suffix in _CODE)
    code = sha256("".join(f.read_text("utf-8") for f in files).encode()).hexdigest()
    own = f"{reference_tracer.__version__} (code {code[:8]})"
    python = ".".join(platform.python_version_tuple()[:2])
    return json.dumps({"Reference Tracer": own, "numpy": np.__version__, "Python": python})


def _named(task: Callable[..., T]) -> Callable[..., T]:
    """Have a task refuse callers of another version, and say which worker has failed."""

    @wraps(task)
    def named(asked_by: str, *arguments: Any) -> T:
        worker = f"worker {get_worker().address}"
        if asked_by != about():
            raise RuntimeError(f"{worker} is of another version: {about()}, not {asked_by}")
        try:
            return task(*arguments)
        except Exception as error:  # with what it holds it would have to be pickled
            raise RuntimeError(f"{worker}: {type(error).__name__}: {error}") from None

    return named


def _done(work: Work[T]) -> T:
    """Run work to its end, or until nobody wants it any more; returns its result."""
    worker = get_worker()
    own = worker.state.tasks[worker.get_current_task()]
    while own.state == "executing":
        try:
            next(work)
        except StopIteration as stop:
            result: T = stop.value
            return result
    raise RuntimeError("cancelled")


def kept(data: T) -> T:
    """Return data, which tasks to come are given."""
    return data


@_named
def trace(
    scene: Scene, settings: Settings, reach: float, region: Region, dx: float, dy: float
) -> tuple[Hits, Statistics]:
    """Return what a region's rays see, and what it took.

    Of a certified picture t and the barycentrics follow from that: they are found where the scene
    is, once they are asked for, and this one does not travel.
    """
    statistics = Statistics()
    chosen = resolved(settings, statistics)
    trace_band = _done(TRACERS[chosen.method](scene, chosen, reach, statistics))
    hits = _done(trace_band(region, dx, dy))
    if isinstance(hits.measures, Measured):
        hits.measures = replace(hits.measures, scene=Scene(scene.camera))
    return hits, statistics


@_named
def trade_rows(scene: Scene, settings: Settings, truth: Floats) -> list[TradeRow]:
    """Return a row of the trade; it is held against the colour `truth` (h, w, 4)."""
    choices = [tradeoff.Choice(each, scene) for each in (PROVEN, settings)]
    return _done(tradeoff.rows_of(choices, truth))[-1:]


@_named
def extremes_rows(scenario: str, scale: float, rays: int | None, judged: int) -> list[ExtremesRow]:
    """Return the rows of a scenario at a scale."""
    return _done(extremes.rows_of(BY_NAME[scenario], scale, rays, judged))

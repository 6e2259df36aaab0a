"""What workers do: bytes, numbers and texts come in, what they find goes out."""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from functools import lru_cache, wraps
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

import numpy as np
import reference_tracer
from distributed import get_worker
from reference_tracer.files.checked_json import camera_of
from reference_tracer.files.scenes import load_scene
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

from .owners import Owners

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


def kept(data: bytes) -> bytes:
    """Return bytes, which tasks to come are given."""
    return data


@lru_cache(maxsize=2)
def _scene(data: bytes) -> Scene:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.npz"
        path.write_bytes(data)
        return load_scene(path)


@lru_cache(maxsize=2)  # a scene keeps tables once they are made
def _seen(scene: bytes, camera: str) -> Scene:
    return _scene(scene).seen_by(camera_of(json.loads(camera)))


@_named
def trace(
    scene: bytes, camera: str, settings: str, reach: float, region: tuple, dx: float, dy: float
) -> tuple[Owners | Hits, Statistics]:
    """Return what a region's rays see, and what it took."""
    seen, statistics = _seen(scene, camera), Statistics()
    chosen = resolved(Settings(**json.loads(settings)), statistics)
    trace_band = _done(TRACERS[chosen.method](seen, chosen, reach, statistics))
    hits = _done(trace_band(Region(*region), dx, dy))
    return Owners.of(hits) if chosen.method.is_proven else hits, statistics


@_named
def trade_rows(scene: bytes, camera: str, settings: str, truth: bytes) -> list[TradeRow]:
    """Return a row of the trade; it is held against the colour `truth` (h, w, 4)."""
    seen = _seen(scene, camera)
    color = np.load(BytesIO(truth), allow_pickle=False)
    wanted = tradeoff.Choice(Settings(**json.loads(settings)), seen)
    proven = tradeoff.Choice(PROVEN, seen)
    return _done(tradeoff.rows_of([proven, wanted], color))[-1:]


@_named
def extremes_rows(scenario: str, scale: float, rays: int | None, judged: int) -> list[ExtremesRow]:
    """Return the rows of a scenario at a scale."""
    return _done(extremes.rows_of(BY_NAME[scenario], scale, rays, judged))

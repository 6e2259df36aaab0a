"""The benchmark's one loop: a plan -> what its pictures take, scene by scene, case by case.

Interrupted at any moment, it leaves the results of the cases that are done.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import Any

from reference_tracer.methods import Method
from reference_tracer.projections import PERSPECTIVE
from reference_tracer.rendering import render, trace
from reference_tracer.scene import Mesh, Scene
from reference_tracer.tracer.progress import Progress, Work, scaled
from reference_tracer.tracer.settings import Settings

from .children import LONGEST, one_core, takes_too_long
from .field import Field
from .meshes import MissingMeshError
from .plan import Case, Plan
from .results import Bench
from .rounds import Runner, Runners, in_rounds
from .scenes import build, mesh_of

CERTIFIED, PLAIN = Settings(Method.CERTIFIED), Settings(Method.MOLLER_TRUMBORE)
METHODS = PLAIN, CERTIFIED
TRACE, RENDER, PICTURE = "trace", "render", "picture"
# What is asked of a method; of a frame, what is not asked for is not found.
WORKS: dict[str, Callable[[Scene, Settings], Any]] = {
    TRACE: lambda scene, settings: _with(trace(scene, settings), "t", "s"),
    RENDER: lambda scene, settings: render(scene, settings).passes(),
    PICTURE: render,
    "outputs": lambda scene, settings: _with(render(scene, settings), "t", "barycentrics"),
}


def _with(found: Any, *names: str) -> Any:
    """Ask for arrays, which are found only then."""
    for name in names:
        getattr(found, name)
    return found


def measure(plan: Plan, bench: Bench, cache: Path) -> Work[None]:
    """Measure a plan's cases, on one core where the system can keep a process there.

    Parameters
    ----------
    plan : Plan
    bench : Bench
        Gets the results, and notes on what was left out.
    cache : Path
        The folder where Blender's monkey is kept from run to run.
    """
    total, done = sum(case.cost for case in plan.cases), 0.0
    end = time.perf_counter() + plan.seconds
    with one_core(), closing(Field(plan.slow, bench, cache)) as field:
        _warm_up(cache)
        for case in plan.cases:
            try:
                mesh = field.mesh(case.scene)
            except MissingMeshError as error:
                bench.note(f"{case.scene} is left out: {error}")
            else:
                # So that slow ones do not make the whole late.
                share = max(0.0, end - time.perf_counter()) * case.cost / (total - done)
                work = _measure_case(plan, min(plan.budget, share), bench, field, mesh, case)
                yield from scaled(work, done / total, case.cost / total)
            done += case.cost
    yield Progress(1.0)


def _warm_up(cache: Path) -> None:
    """Trace a few pixels: what a process does once, such as a self-test, is nobody's time."""
    mesh = mesh_of("cube", cache)
    for settings in METHODS:
        for work in (trace, render):
            work(build(mesh, 16, 9, PERSPECTIVE.name), settings)


def _measure_case(
    plan: Plan, budget: float, bench: Bench, field: Field, mesh: Mesh, case: Case
) -> Work[None]:
    """Measure a case, its rounds within a budget in seconds."""
    results: dict[str, Any] = {}
    ours = _ours(mesh, case, results)
    for what in (TRACE,) if plan.quick else (TRACE, RENDER):
        runner = ours[f"{PLAIN.method.value}, {what}"]
        if takes_too_long(runner.run):
            runner.failed = f"it takes more than {LONGEST:g} s: not timed"
    peers = field.runners(build(mesh, case.width, case.height, case.camera), case)
    yield from in_rounds([*ours.values(), *peers.values()], plan.repeats, budget)
    field.compare(peers, results[PICTURE])
    bench.keep_rounds(case.title, ours | peers)


def _ours(mesh: Mesh, case: Case, results: dict[str, Any]) -> Runners:
    """Return who is timed on our own side; what certified has found last is in the results."""

    def timed(what: str, settings: Settings) -> float:
        scene = build(mesh, case.width, case.height, case.camera)  # a traced one keeps tables
        began = time.process_time()
        found = WORKS[what](scene, settings)
        seconds = time.process_time() - began
        results[what] = found if what == PICTURE else None
        return seconds

    return {
        f"{s.method.value}, {what}": Runner(partial(timed, what, s))
        for what in WORKS
        for s in (METHODS if what in (TRACE, RENDER) else (CERTIFIED,))
    }

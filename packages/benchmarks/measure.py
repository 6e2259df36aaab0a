"""The benchmark's one loop: a plan -> rows, scene by scene, case by case.

Interrupted at any moment, it leaves the rows of the cases that are done.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import closing
from functools import partial
from itertools import groupby
from pathlib import Path

import numpy as np
from reference_tracer.methods import Method
from reference_tracer.projections import PERSPECTIVE
from reference_tracer.rendering import render, trace
from reference_tracer.scene import Mesh, Scene
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.progress import Progress, Work, scaled
from reference_tracer.tracer.settings import Settings

from . import memory
from .children import one_core
from .field import Field
from .meshes import MissingMeshError
from .plan import Case, Plan
from .rounds import Runner, in_rounds
from .rows import Bench, Row
from .scenes import SUBJECTS, build, mesh_of

CERTIFIED, PLAIN = Settings(Method.CERTIFIED), Settings(Method.MOLLER_TRUMBORE)
METHODS = PLAIN, CERTIFIED
WHAT = TRACE, RENDER = "trace", "render"
PICTURE, OUTPUTS = "picture", "outputs"  # what of a frame is asked for, of certified alone
_MEMORY = 0.2  # the share of a scene's time that its memory takes, about

Peaks = dict[memory.Job, int | None]


def measure(plan: Plan, bench: Bench, cache: Path) -> Work[None]:
    """Measure a plan's cases, on one core where the system can keep a process there.

    Parameters
    ----------
    plan : Plan
    bench : Bench
        Gets the rows, two for each case, and notes on what was left out.
    cache : Path
        The folder where Blender's monkey is kept from run to run.
    """
    total, done = sum(case.cost for case in plan.cases), 0.0
    pace = Pace(plan)
    with one_core(), closing(Field(plan, bench, cache)) as field:
        _warm_up(cache)
        for name, group in groupby(plan.cases, key=lambda case: case.scene):
            cases = list(group)
            size = sum(case.cost for case in cases)
            try:
                mesh = field.mesh(name)
            except MissingMeshError as error:
                bench.note(f"{name} is left out: {error}")
            else:
                work = _measure_scene(pace, bench, cache, field, mesh, cases)
                yield from scaled(work, done / total, size / total)
            done += size
    yield Progress(1.0)


def _warm_up(cache: Path) -> None:
    """Trace a few pixels: what a process does once, such as a self-test, is nobody's time."""
    mesh = mesh_of("cube", cache)
    for settings in METHODS:
        for work in (trace, render):
            work(build(mesh, 16, 9, PERSPECTIVE.name), settings)


def _measure_scene(
    pace: Pace, bench: Bench, cache: Path, field: Field, mesh: Mesh, cases: list[Case]
) -> Work[None]:
    peaks = yield from scaled(_measure_memory(cases, cache, pace.plan.quick), 0.0, _MEMORY)
    share = (1 - _MEMORY) / sum(case.cost for case in cases)
    start = _MEMORY
    for case in cases:
        timing = Timing(mesh, case)
        for (settings, what), runner in timing.runners.items():
            if _took_too_long(peaks, case, settings, what):
                runner.failed = f"{what} takes more than {memory.LONGEST:g} s"
                bench.note(f"{case.title}: {settings.method.value}: {runner.failed}: not timed")
        peers = field.runners(timing.scene(), case)
        yield from scaled(
            in_rounds(
                [*timing.runners.values(), *peers.values()], pace.plan.repeats, pace.budget(case)
            ),
            start,
            share * case.cost,
        )
        start += share * case.cost
        for (settings, what), runner in timing.runners.items():
            bench.keep(f"{case.title}: {settings.method.value}, {what}", runner.seconds.values())
        for name, runner in peers.items():
            bench.keep(f"{case.title}: {name}", runner.seconds.values())
        field.tell(peers, case)
        rows = [timing.row(settings, peers, peaks) for settings in METHODS]
        bench.rows += [field.completed(row, timing.certified) for row in rows]


def _measure_memory(cases: list[Case], cache: Path, quick: bool) -> Work[Peaks]:
    """Measure all of a scene's pictures in one go: its mesh is made once."""
    wanted = WHAT[:1] if quick else WHAT
    jobs = [_job(case, s, what) for case in cases for s in METHODS for what in wanted]
    found: Peaks = {}
    with closing(memory.peaks(cases[0].scene, cache, jobs)) as peaks:
        for job, peak in zip(jobs, peaks, strict=True):
            found[job] = peak
            yield Progress(len(found) / len(jobs))
    return found


def _took_too_long(peaks: Peaks, case: Case, settings: Settings, what: str) -> bool:
    """Whether an unproven method's memory was not found out, but certified's was."""
    plain, proven = (peaks.get(_job(case, s, what), 0) for s in (settings, CERTIFIED))
    return plain is None and proven is not None


def _job(case: Case, s: Settings, what: str) -> memory.Job:
    size = case.width, case.height
    return memory.Job(*size, case.camera, s.method.value, s.precision.value, what == RENDER)


class Pace:
    """Shares the time of a plan among its cases, so that slow ones do not make the whole late."""

    def __init__(self, plan: Plan) -> None:
        """Begin now."""
        self.plan, self._end = plan, time.perf_counter() + plan.seconds
        self._to_come = sum(case.cost for case in plan.cases)

    def budget(self, case: Case) -> float:
        """Return the seconds for the rounds of the next case."""
        left = max(0.0, self._end - time.perf_counter())
        share = left * case.cost / self._to_come
        self._to_come -= case.cost
        return min(self.plan.budget, share)


class Timing:
    """Our own side of a case: who is timed, and what of it belongs into a row."""

    def __init__(self, mesh: Mesh, case: Case) -> None:
        """Prepare; nothing runs before a runner is asked to."""
        self._mesh, self._case = mesh, case
        self.certified: Frame | None = None  # the latest: peers are held against it
        self._stages: dict[Settings, list[dict[str, float]]] = {s: [] for s in METHODS}
        self.runners = {(s, what): Runner(self._of(s, what)) for what in WHAT for s in METHODS}
        for what in (PICTURE, OUTPUTS):
            self.runners[CERTIFIED, what] = Runner(self._of(CERTIFIED, what))

    def scene(self) -> Scene:
        """Return the case's scene, new: one that was traced keeps tables."""
        case = self._case
        return build(self._mesh, case.width, case.height, case.camera)

    def _of(self, settings: Settings, what: str) -> Callable[[], float]:
        works = {TRACE: self._trace, RENDER: self._render}
        return lambda: works.get(what, partial(self._frame, what))(settings)

    def _trace(self, settings: Settings) -> float:
        scene = self.scene()
        began = time.process_time()
        hits = trace(scene, settings)
        assert hits.t is not None and hits.s is not None  # found when they are asked for
        return time.process_time() - began

    def _frame(self, what: str, settings: Settings) -> float:
        """Render; of the frame, its picture alone or t and barycentrics, too, are asked for."""
        scene = self.scene()
        began = time.process_time()
        frame = render(scene, settings)
        if what == OUTPUTS:
            assert frame.t is not None and frame.barycentrics is not None
        return time.process_time() - began

    def _render(self, settings: Settings) -> float:
        scene = self.scene()
        began, waited = time.process_time(), time.perf_counter()
        frame = render(scene, settings)
        frame.passes()
        seconds = time.process_time() - began
        share = seconds / (time.perf_counter() - waited)  # the tracer's own clock is a user's
        self._stages[settings].append({k: share * s for k, s in frame.statistics.stages.items()})
        if settings == CERTIFIED:
            self.certified = frame
        return seconds

    def row(self, settings: Settings, peers: dict[str, Runner], peaks: Peaks) -> Row:
        """Return a method's row; what only some peers know is still to be filled in."""
        case, ours = self._case, self.runners[settings, TRACE]
        whole = self.runners[settings, RENDER]
        row = Row(
            case.scene,
            SUBJECTS[case.scene].copies * len(self._mesh.triangles),
            case.width,
            case.height,
            case.camera,
            settings.method.value,
            settings.precision.value,
            trace_s=ours.median,
            render_s=whole.median,
            peak_bytes=peaks.get(_job(case, settings, TRACE)),
            render_peak_bytes=peaks.get(_job(case, settings, RENDER)),
            rounds=len(ours.seconds),
            stages=_medians(self._stages[settings][-len(whole.seconds) :]),
        )
        for name, runner in peers.items():
            setattr(row, f"{name}_s", runner.median)
        if settings == CERTIFIED:
            picture, outputs = (self.runners[settings, what] for what in (PICTURE, OUTPUTS))
            row.picture_s, row.outputs_s = picture.median, outputs.median
        return row


def _medians(rounds: list[dict[str, float]]) -> dict[str, float]:
    """Return the median seconds of every stage."""
    names = dict.fromkeys(name for stages in rounds for name in stages)
    return {name: float(np.median([stages.get(name, 0.0) for stages in rounds])) for name in names}

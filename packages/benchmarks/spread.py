"""Measures two processes on a long picture beside one: seconds that a user waits.

`reftrace trace` with `--scheduler local:2`, and the same without, on all cores.
"""

from __future__ import annotations

import sys
import time
from functools import partial
from pathlib import Path

import trimesh
from reference_tracer.tracer.progress import Work

from .commands import MAIN, run_to_end
from .plan import SPREAD, Plan
from .results import Bench
from .rounds import Runner, in_rounds

ONE, TWO = "one process", "local:2"
# 327,680 triangles with 26 rays a pixel: more than ten seconds of one process.
_PICTURE = "--samples", "5", "--set", "width=1920", "height=1080"
_BUDGET = 120.0  # seconds, beside the first round


def measure_spread(plan: Plan, bench: Bench, cache: Path) -> Work[None]:
    """Measure it, if it is in the plan."""
    if SPREAD not in plan.commands:
        return
    folder = cache / "commands"
    mesh, picture = folder / "sphere.ply", folder / "sphere.png"
    argv = [sys.executable, "-c", MAIN, "trace", str(mesh), *_PICTURE, "--out", str(picture)]
    if not mesh.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        trimesh.creation.icosphere(7).export(mesh)
    options = {ONE: (), TWO: ("--scheduler", TWO)}
    runners = {who: Runner(partial(_waited, [*argv, *o])) for who, o in options.items()}
    yield from in_rounds(list(runners.values()), plan.repeats, _BUDGET)
    bench.keep_rounds(SPREAD, runners)


def _waited(argv: list[str]) -> float:
    began = time.perf_counter()
    run_to_end(argv)
    return time.perf_counter() - began

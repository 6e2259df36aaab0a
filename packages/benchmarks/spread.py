"""Measures two processes on a long picture: seconds of waiting, times one process's.

As a user waits: `reftrace trace` with `--scheduler local:2` against the same without, on all cores.
"""

from __future__ import annotations

import subprocess
import sys
import time
from functools import partial
from pathlib import Path

from reference_tracer.tracer.progress import Work

from .peers import MissingPeerError
from .plan import SPREAD, Plan
from .rounds import Runner, in_rounds, ratio
from .rows import Bench, CommandRow

_MAIN = "import sys; from reference_tracer.cli.main import main; sys.exit(main())"
# 327,680 triangles with 26 rays a pixel: more than ten seconds of one process.
_PICTURE = "--samples", "5", "--set", "width=1920", "height=1080"
_BUDGET = 120.0  # seconds, beside the first round


def measure_spread(plan: Plan, bench: Bench, cache: Path) -> Work[None]:
    """Measure it, if it is in the plan; the row's seconds are those that a user waits."""
    if SPREAD not in plan.commands:
        return
    folder = cache / "commands"
    mesh, picture = folder / "sphere.ply", folder / "sphere.png"
    argv = [sys.executable, "-c", _MAIN, "trace", str(mesh), *_PICTURE, "--out", str(picture)]
    if not mesh.is_file():
        import trimesh

        folder.mkdir(parents=True, exist_ok=True)
        trimesh.creation.icosphere(7).export(mesh)
    one, two = (Runner(partial(_waited, [*argv, *o])) for o in ((), ("--scheduler", "local:2")))
    yield from in_rounds([one, two], plan.repeats, _BUDGET)
    if failed := one.failed or two.failed:
        bench.note(f"{SPREAD}: {failed}")
    elif found := ratio(two, one):
        bench.keep(SPREAD, two.seconds.values())
        times = found.median, found.least, found.most
        bench.commands.append(CommandRow(SPREAD, one.median, *times, len(two.seconds), two.median))


def _waited(argv: list[str]) -> float:
    began = time.perf_counter()
    done = subprocess.run(argv, capture_output=True, text=True, check=False)
    if done.returncode:
        raise MissingPeerError(f"it failed ({done.stderr.strip()[-200:]})")
    return time.perf_counter() - began

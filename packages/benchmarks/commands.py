"""Measures what commands take: CPU seconds of processes of their own, beside `import bpy`.

Each round measures `import bpy`, too. What a command reads is made once, and kept in a folder.
"""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

from reference_tracer.tracer.progress import Work

from .children import one_core
from .peers import MissingPeerError, missing
from .plan import COMMANDS, Plan
from .results import Bench
from .rounds import Runner, in_rounds

RULER, COMMAND = "import bpy", "command"
MAIN = "import sys; from reference_tracer.cli.main import main; sys.exit(main())"
_CHILD = [sys.executable, "-m", "reference_tracer_benchmarks.commands_child"]
_SCENES = Path(__file__).resolve().parents[2] / "sample_scenes"
_LARGE = "--set", "width=1920", "height=1080"
_ANSWERS = 0, 1, 2  # exit codes of a comparison that was made


def measure_commands(plan: Plan, bench: Bench, cache: Path) -> Work[None]:
    """Measure a plan's commands.

    Parameters
    ----------
    plan : Plan
    bench : Bench
        Gets the times, and notes on what was left out.
    cache : Path
        The folder for what commands read and write.
    """
    wanted = [c for c in COMMANDS if c in plan.commands]
    if not wanted:
        return
    with one_core():
        try:
            files = _files(cache / "commands")
        except MissingPeerError as error:
            bench.note(f"commands: {error}")
            return
        ruler = Runner(partial(cpu_seconds, [sys.executable, "-c", RULER]))
        runners = {name: Runner(_work(name, files)) for name in wanted}
        budget = plan.budget * (1 + len(wanted))
        yield from in_rounds([ruler, *runners.values()], plan.repeats, budget)
        for name, runner in runners.items():
            bench.keep_rounds(name, {RULER: ruler, COMMAND: runner})


def _files(folder: Path) -> dict[str, Path]:
    """Return what the commands read, by name; made where it is not there.

    Raises
    ------
    MissingPeerError
        If there is no bpy, or no sample scene.
    """
    if importlib.util.find_spec("bpy") is None:
        raise missing("bpy")
    files = {"suzanne": _SCENES / "suzanne.blend", "out": folder / "out"}
    if not files["suzanne"].is_file():
        raise MissingPeerError(f"there is no '{files['suzanne']}': they are measured in a clone")
    made = {name: folder / name for name in ("cube.blend", "xray.blend", "mesh.ply")}
    if not all(path.is_file() for path in made.values()):
        folder.mkdir(parents=True, exist_ok=True)
        cpu_seconds([*_CHILD, "make", str(files["suzanne"]), str(folder)])
    return files | made


def _work(name: str, files: dict[str, Path]) -> Callable[[], float]:
    """Return what measures a command of COMMANDS."""
    of = {key: str(path) for key, path in files.items()}
    into = "--out", of["out"]
    argv = {
        "reftrace --help": ["--help"],
        "compare suzanne, 960 x 540": ["compare", of["suzanne"], *into],
        "compare 12 triangles, 1920 x 1080": ["compare", of["cube.blend"], *_LARGE, *into],
        "compare 385,000 pixels that one cause excuses": [
            "compare",
            of["xray.blend"],
            "--as-is",
            "--no-identity",
            "--set",
            "width=1162",
            "height=654",
            *into,
        ],
        "trace mesh.ply, 1.3 M triangles": [
            "trace",
            of["mesh.ply"],
            *_LARGE,
            "--out",
            f"{of['out']}.png",
        ],
    }
    if name in argv:
        return partial(cpu_seconds, [sys.executable, "-c", MAIN, *argv[name]])
    passes = "none" if name.endswith("the picture alone") else "all"
    return partial(_said, [*_CHILD, "f12", of["suzanne"], passes])


def cpu_seconds(argv: list[str]) -> float:
    """Run a process to its end; return the CPU seconds that it took, its own and the system's.

    Raises
    ------
    MissingPeerError
        If it fails.
    """
    before = os.times()
    run_to_end(argv)
    after = os.times()
    return sum(after[2:4]) - sum(before[2:4])  # those of children that have ended


def _said(argv: list[str]) -> float:
    """Return the seconds that a process of ours measures, and says in its last line."""
    return float(run_to_end(argv).splitlines()[-1])


def run_to_end(argv: list[str]) -> str:
    """Return what a process prints.

    Raises
    ------
    MissingPeerError
        If it fails.
    """
    done = subprocess.run(argv, capture_output=True, text=True, errors="replace")
    if done.returncode not in _ANSWERS or "Traceback" in done.stderr:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise MissingPeerError(f"it failed ({last})")
    return done.stdout

"""A `Bench` -> `bench.json`, `bench.txt`, and `times.json`, which pyperf reads and plots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference_tracer.report import folders

from .peers import MissingPeerError, missing
from .rows import Bench

if TYPE_CHECKING:
    from pyperf import BenchmarkSuite

SCHEMA = "reference_tracer.bench/1"
TABLE, JSON, TIMES = "bench.txt", "bench.json", "times.json"
UNFINISHED = "unfinished"  # the folder in the results' of a run until it ends

_UNITS = {
    "_s": "CPU seconds, the median of the rounds, for a whole picture",
    "cycles_s, workbench_s": "the same, in seconds that a user waits",
    "_rays": "rays that were traced; fewer than the picture has: its seconds are extrapolated",
    "_bytes": "bytes at the peak, beside the scene and the libraries",
    "embreex_differs": "share of pixels in which embreex, in float32, names another triangle",
    "stages": "seconds of a whole frame, by stage",
    "commands": "cpu_s: CPU seconds of its process; ratio: to those of `import bpy`, of one round",
}


def to_dict(bench: Bench) -> dict[str, Any]:
    """Return what `bench.json` holds: facts of the machine, and rows."""
    return {
        "schema": SCHEMA,
        **bench.machine,
        "quick": bench.quick,
        "interrupted": bool(bench.interrupted),
        "notes": bench.notes,
        "units": _UNITS,
        "rows": [asdict(r) for r in bench.rows],
        "commands": [asdict(c) for c in bench.commands],
    }


def write_json(directory: str | Path, bench: Bench) -> None:
    """Write `bench.json`; whoever reads it meanwhile, or stops us, finds a whole one."""
    with folders.replacing_file(Path(directory) / JSON) as new:
        folders.write_json(new, to_dict(bench))


def suite(values: Mapping[str, tuple[list[float], str]]) -> BenchmarkSuite | None:
    """Return values by their names, each with its unit, as pyperf keeps them, if there are any.

    Raises
    ------
    MissingPeerError
        If pyperf is not installed.
    """
    try:
        from pyperf import Benchmark, BenchmarkSuite, Run
    except ImportError:
        raise missing("pyperf") from None
    runs = [Run(of, metadata={"name": name, "unit": unit}) for name, (of, unit) in values.items()]
    return BenchmarkSuite([Benchmark([run]) for run in runs]) if runs else None


def _values(bench: Bench) -> dict[str, tuple[list[float], str]]:
    """Return the seconds of all rounds, and the peaks of memory."""
    kept: dict[str, tuple[list[float], str]] = {k: (v, "second") for k, v in bench.times.items()}
    for r in bench.rows:
        if r.peak_bytes:
            name = f"{r.scene}, {r.width} x {r.height}, {r.camera}: {r.method}, memory"
            kept[name] = [r.peak_bytes], "byte"
    return kept


def write(directory: str | Path, bench: Bench) -> None:
    """Write the table and the JSONs; a note says if pyperf, which makes tables, is missing.

    Parameters
    ----------
    directory : path
        Made where it is not there.
    bench : Bench

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    from .tables import table

    with folders.replacing(Path(directory), (TIMES, TABLE, JSON)) as new:
        try:
            if kept := suite(_values(bench)):
                kept.dump(str(new / TIMES))
        except MissingPeerError as error:
            bench.note(str(error))
        write_json(new, bench)
        (new / TABLE).write_text(table(bench) + "\n", encoding="utf-8")

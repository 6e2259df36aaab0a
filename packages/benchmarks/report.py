"""A `Bench` -> `bench.json`, `bench.txt` and `bench.svg`; and a saved one, to compare with."""

from __future__ import annotations

import json
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from reference_tracer.report import folders
from reference_tracer.scene import SceneError

from .plot import picture
from .rows import Bench, CommandRow, Row
from .scaling import scalings
from .tables import table

SCHEMA = "reference_tracer.bench/1"
TABLE, JSON, PLOT = "bench.txt", "bench.json", "bench.svg"

_UNITS = {
    "_s": "CPU seconds, the median of the rounds, for a whole picture",
    "cycles_s, workbench_s": "the same, in seconds that a user waits",
    "_rays": "rays that were traced; fewer than the picture has: its seconds are extrapolated",
    "_bytes": "bytes at the peak, beside the scene and the libraries",
    "_least, _most": "of the ratios of two times of one round",
    "embreex_differs": "share of pixels in which embreex, in float32, names another triangle",
    "stages": "seconds of a whole frame, by stage",
    "commands": "cpu_s: CPU seconds of its process; ratio: to those of `import bpy`, of one round",
}


def to_dict(bench: Bench) -> dict[str, Any]:
    """Return what `bench.json` holds: facts of the machine, rows, and what was fitted to them."""
    return {
        "schema": SCHEMA,
        **bench.machine,
        "quick": bench.quick,
        "interrupted": bool(bench.interrupted),
        "notes": bench.notes,
        "units": _UNITS,
        "rows": [asdict(r) for r in bench.rows],
        "commands": [asdict(c) for c in bench.commands],
        "scaling": [asdict(s) for s in scalings(bench.rows)],
    }


def write_json(directory: str | Path, bench: Bench) -> None:
    """Write `bench.json`; whoever reads it meanwhile, or stops us, finds a whole one."""
    with folders.replacing_file(Path(directory) / JSON) as new:
        folders.write_json(new, to_dict(bench))


def write(directory: str | Path, bench: Bench, baseline: Bench | None = None) -> None:
    """Write `bench.json`, `bench.txt` and `bench.svg`, in this order.

    Parameters
    ----------
    directory : path
        Made where it is not there.
    bench : Bench
    baseline : Bench, optional
        What the table compares with.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    directory = Path(directory)
    directory.mkdir(parents=True, exist_ok=True)
    (directory / PLOT).unlink(missing_ok=True)  # an earlier one would pass for this run's
    write_json(directory, bench)
    (directory / TABLE).write_text(table(bench, baseline) + "\n", encoding="utf-8")
    if bench.rows:
        (directory / PLOT).write_text(picture(bench), encoding="utf-8")


def load(path: str | Path) -> Bench:
    """Read a `bench.json`.

    Raises
    ------
    SceneError
        If it is none.
    OSError
        If it cannot be read.
    """
    try:
        data = json.loads(Path(path).read_text(encoding="utf-8"))
        if data["schema"] != SCHEMA:
            raise SceneError(f"'{path}' has the schema {data['schema']!r}, not {SCHEMA!r}")
        known = {f.name for f in fields(Row)}
        rows = [Row(**{k: v for k, v in row.items() if k in known}) for row in data["rows"]]
        ours = {"schema", "quick", "interrupted", "notes", "units", "rows", "commands", "scaling"}
        facts = {k: v for k, v in data.items() if k not in ours}
        commands = [CommandRow(**row) for row in data.get("commands", ())]  # older ones have none
        return Bench(facts, data["quick"], rows, data["notes"], data["interrupted"], commands)
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(f"'{path}' is not a bench.json of Reference Tracer: {error}") from error

"""Writes the table and `engines.json` of several engines against one certified picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ..comparison.engines import EngineRow, to_dict
from ..diagnosis.fault_rows import table
from ..pictures.identity import NOTHING
from .folders import write_all
from .tables import columns

JSON = "engines.json"
_HEAD = "engine", "differ", "inside", "edges", "object", "unexpl.", "verdict"
_NAMED = 3  # pixels of each engine


def write(directory: str | Path, rows: Sequence[EngineRow]) -> None:
    """Write `engines.json`: every engine's picture against the tracer's.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    write_all(Path(directory), {JSON: to_dict(rows)})


def lines(rows: Sequence[EngineRow]) -> list[str]:
    """Return the table of the engines, the first pixels of each that differ, and its checks."""
    out = columns([_HEAD, *map(_cells, rows)], left=(0, 6))
    for row in rows:
        for w in row.wrong[:_NAMED]:
            x, y = w["pixel"]
            out.append(f"  {row.engine} at ({x}, {y}): {_sides(w)}: {w['cause']}: {w['why']}")
        more = row.counts.differ - _NAMED if row.counts else 0
        if more > 0:
            out.append(f"  {row.engine}: and {more:,} more, on its page")
        out += [f"  {row.engine}: {line}" for line in (*row.not_judged, *table(row.self_check))]
    return out


def _cells(row: EngineRow) -> Sequence[str] | str:
    if row.counts is None:
        return f"{row.engine:10} no picture: {row.error}"
    p = row.counts
    counts = p.differ, p.interior.differ, p.boundary.differ, row.wrong_objects
    found = ["?" if n is None else f"{n:,}" for n in (*counts, p.unexplained)]
    return [row.engine, *found, row.verdict]


def _sides(wrong: Mapping[str, object]) -> str:
    """Say what both sides show."""
    triangle = wrong["triangle"]
    traced = f"'{wrong['traced']}'" + (f" (triangle {triangle})" if triangle != NOTHING else "")
    if wrong["traced"] == "nothing":
        traced = "nothing"
    beneath = f" beneath {wrong['beneath']}" if "beneath" in wrong else ""
    shown = wrong.get("shown")
    if shown in (None, "not known"):
        return f"the tracer sees {traced}"
    if shown == wrong["traced"]:
        colors = "" if beneath and wrong["cause"] != "unexplained" else ", in other colours"
        return f"both show {traced}{beneath}{colors}"
    shown = "nothing" if shown == "nothing" else f"'{shown}'"
    return f"the tracer sees {traced}, Blender {shown}{beneath}"

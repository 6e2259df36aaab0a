"""Shows the study of numerical stability: as a table, as `extremes.json`, and plotted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from ..methods import Method
from ..study.extremes import BreakingPoint, ExtremesRow, breaking_points, written
from ..study.scenarios.sweeps import BY_NAME, SCENARIOS
from .extreme_plots import plot
from .folders import finite, write_all
from .tables import columns
from .templates import alone

__all__ = ["breaking_table", "page", "plot", "to_dict", "write"]
SCHEMA = "reference_tracer.extremes/1"
TABLE, JSON, PLOT = "extremes.txt", "extremes.json", "extremes.html"

_FIRST = "First scale at which a ray is missed or wrong; + at which one crosses too many; . never"
_LITERAL = "(The literal textbook is left out: it loses rays from the first scale of nearly all.)"
_UNITS = {  # what the numbers of a row are, for the reader of the JSON
    "rays": "rays of the scene; the counts below are of rays",
    "missed": "the certified ray sees a surface, the method none",
    "wrong": "the method sees another surface, or one where there is none",
    "doubled": "the method crosses more triangles than the certified ray does",
    "refused": "triangles and rays that are not finite in this precision",
    "largest_t_error": "ulp of the certified t in float64, where both see the same; null: nowhere",
    "exact": "share of the pairs of a ray and a triangle that integer arithmetic decided",
    "judged": "rays that were held against the definition, in integers, with every surface",
}


def breaking_table(rows: Sequence[ExtremesRow]) -> str:
    """Return as text at which scale each method first misses a ray or sees a wrong surface.

    Behind a plus: where a ray first crosses more triangles than there are.
    """
    points = breaking_points(rows)
    found = dict.fromkeys((p.method, p.precision) for p in points)
    methods = [m for m in found if m[0] != Method.TEXTBOOK_LITERAL]
    by = {(p.scenario, p.method, p.precision): p for p in points}
    lines: list[Sequence[str] | str] = [
        ["", "", *(Method(method).record.short for method, _ in methods)],
        ["", "", *(precision for _, precision in methods)],
        "",
    ]
    for name in dict.fromkeys(p.scenario for p in points):
        scale = BY_NAME[name].scale_name if name in BY_NAME else ""
        lines.append([name, scale, *(_first_scale(by.get((name, *m))) for m in methods)])
    return "\n".join([_FIRST, _LITERAL, "", *columns(lines, left=(0, 1))])


def _first_scale(point: BreakingPoint | None) -> str:
    if point is None or point.doubled is None:
        return written(point and point.lost)
    return f"{written(point.lost)} +{written(point.doubled)}"


def to_dict(rows: Sequence[ExtremesRow]) -> dict[str, object]:
    """Return what `extremes.json` holds."""
    return {
        "schema": SCHEMA,
        "units": _UNITS,
        "scenarios": [
            {
                "name": s.name,
                "title": s.title,
                "explanation": s.explanation,
                "scale": s.scale_name,
                "unit": s.unit,
            }
            for s in SCENARIOS
        ],
        "breaking_points": [p._asdict() for p in breaking_points(rows)],
        "rows": [asdict(r) | {"largest_t_error": finite(r.largest_t_error)} for r in rows],
    }


def page(rows: Sequence[ExtremesRow]) -> str:
    """Return the page of the plots."""
    return alone("Reference Tracer: extremes", plots=[plot(rows)])


def write(directory: str | Path, rows: Sequence[ExtremesRow]) -> None:
    """Write `extremes.txt`, `extremes.json` and `extremes.html`, all or none, in a folder.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    texts = {TABLE: f"{breaking_table(rows)}\n", PLOT: page(rows)}
    write_all(Path(directory), {**texts, JSON: to_dict(rows)})

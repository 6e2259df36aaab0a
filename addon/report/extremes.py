"""Shows the study of numerical stability: as tables, as `extremes.json` and as pictures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ..methods import MEASURED
from ..study.extremes import BreakingPoint, ExtremesRow, breaking_points, written
from ..study.scenarios.sweeps import BY_NAME, SCENARIOS
from . import extreme_plots
from .extreme_plots import by_scenario, scale_of
from .folders import finite, replacing, write_json
from .tables import columns, percent

SCHEMA = "reference_tracer.extremes/1"
TABLE, JSON = "extremes.txt", "extremes.json"
PANELS = 12  # sweeps of one picture

_LOST = "Rays missed or wrong, in percent; + rays that cross more triangles than there are"
_FIRST = "First scale at which a ray is missed or wrong; + at which one crosses too many; . never"
_LITERAL = "(The literal textbook is left out: it loses rays from the first scale of nearly all.)"
_UNITS = {  # what the numbers of a row are, for the reader of the JSON
    "rays": "rays of the scene; the counts below are of rays",
    "seen": "rays whose certified ray sees a surface",
    "missed": "the certified ray sees a surface, the method none",
    "wrong": "the method sees another surface, or one where there is none",
    "order": "those of the wrong that see what is truly crossed, but is not the nearest",
    "doubled": "the method crosses more triangles than the certified ray does",
    "refused": "triangles and rays that are not finite in this precision",
    "largest_t_error": "ulp of the certified t in float64, where both see the same; null: nowhere",
    "exact": "share of the pairs of a ray and a triangle that integer arithmetic decided",
    "judged": "rays that were held against the definition, in integers, with every surface",
}
_SHORT = {m.value: m.record.short for m in MEASURED}
_WIDTH = 12  # of a column of the tables


def table(rows: Sequence[ExtremesRow]) -> str:
    """Return the sweeps as text: for each scale, the percentage of rays that each method loses.

    Behind a plus: those that cross more triangles than there are.
    """
    methods = _shown(rows)
    lines: list[Sequence[str] | str] = []
    for name, sweep in by_scenario(rows).items():
        lines.append("")
        if s := BY_NAME.get(name):
            lines.append(f"{s.title} ({scale_of(name)}): {s.explanation}")
        by = {(r.scale, r.method, r.precision): r for r in sweep}
        for scale in dict.fromkeys(r.scale for r in sweep):
            lines.append([written(scale), *(_lost(by.get((scale, *m))) for m in methods)])
    return _text(_LOST, methods, lines, (_WIDTH,))


def _shown(rows: Sequence[ExtremesRow] | Sequence[BreakingPoint]) -> list[tuple[str, str]]:
    """Return the methods and precisions but the literal textbook, which loses rays everywhere."""
    found = dict.fromkeys((r.method, r.precision) for r in rows)
    return [m for m in found if m[0] != "textbook_literal"]


def _text(
    title: str,
    methods: Sequence[tuple[str, str]],
    lines: Sequence[Sequence[str] | str],
    least: Sequence[int],
    left: Sequence[int] = (),
) -> str:
    """Return a table that ends with the methods' columns; `least`, `left` are for the others."""
    empty = [""] * len(least)
    names = [*empty, *(_SHORT.get(method, method) for method, _ in methods)]
    head = names, [*empty, *(precision for _, precision in methods)]
    widths = [*least, *[_WIDTH] * len(methods)]
    return "\n".join([title, _LITERAL, "", *columns([*head, *lines], left, least=widths)])


def _lost(row: ExtremesRow | None) -> str:
    if row is None:
        return ""
    doubled = f" +{percent(row.doubled / row.rays)}" if row.doubled else ""
    return f"{percent(row.share)}{doubled}" if row.lost or row.doubled else "."


def breaking_table(rows: Sequence[ExtremesRow]) -> str:
    """Return as text at which scale each method first misses a ray or sees a wrong surface.

    Behind a plus: where a ray first crosses more triangles than there are.
    """
    points = breaking_points(rows)
    methods = _shown(points)
    by = {(p.scenario, p.method, p.precision): p for p in points}
    scales = {name: s.scale_name for name, s in BY_NAME.items()}
    lines: list[Sequence[str] | str] = [""]
    for name in dict.fromkeys(p.scenario for p in points):
        cells = (_first_scale(by.get((name, *m))) for m in methods)
        lines.append([name, scales.get(name, ""), *cells])
    least = 18, 2 + max(map(len, scales.values()))
    return _text(_FIRST, methods, lines, least, left=(0, 1))


def _first_scale(point: BreakingPoint | None) -> str:
    if point is None or point.doubled is None:
        return written(point and point.lost)
    return f"{written(point.lost)} +{written(point.doubled)}"


def to_dict(rows: Sequence[ExtremesRow]) -> dict[str, Any]:
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


def write(directory: str | Path, rows: Sequence[ExtremesRow]) -> None:
    """Write `extremes.txt`, `extremes.json` and the pictures, all or none, in a folder.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    names = TABLE, *(f"{name}.svg" for name in picture_names()), JSON
    with replacing(Path(directory), names) as new:
        text = f"{breaking_table(rows)}\n\n\n{table(rows)}\n"
        (new / TABLE).write_text(text, encoding="utf-8")
        write_json(new / JSON, to_dict(rows))
        for name, picture in pictures(rows).items():
            (new / f"{name}.svg").write_text(picture, encoding="utf-8")


def picture_names() -> list[str]:
    """Return the names of all pictures that there may be."""
    pages = math.ceil(len(SCENARIOS) / PANELS)
    return ["breaking_points", *(f"sweeps_{page + 1}" for page in range(pages))]


def pictures(rows: Sequence[ExtremesRow]) -> dict[str, str]:
    """Return the name and the SVG of every picture."""
    found = {}
    if groups := list(by_scenario(rows).values()):
        found["breaking_points"] = extreme_plots.breaking_picture(rows)
        pages = math.ceil(len(groups) / PANELS)
        each = math.ceil(len(groups) / pages)
        for page in range(1, pages + 1):
            shown = groups[(page - 1) * each : page * each]
            found[f"sweeps_{page}"] = extreme_plots.sweeps_picture(shown, f"{page} of {pages}")
    return found

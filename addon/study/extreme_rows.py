"""What was measured of numerical stability: rows, the breaking points in them, and tables of both.

`extremes.py` measures them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .scenarios.sweeps import SCENARIOS

NAMES = {
    "textbook_literal": "literal",
    "textbook": "textbook",
    "moller_trumbore": "Möller–T.",
    "watertight": "watertight",
    "certified": "certified",
}


@dataclass(frozen=True)
class Row:
    """What a method in a precision makes of a scenario at a scale; counts are of rays.

    Parameters
    ----------
    scenario, scale, across
        Which scene: `across` is the second scale of a map's, else None.
    method, precision : str
    rays, seen : int
        All rays, and those whose certified ray sees a surface.
    missed : int
        The certified ray sees a surface, the method nothing.
    doubled : int
        The method says to cross more triangles than the certified ray does.
    wrong : int
        The method sees another surface than the certified one (and than its ties, where a ray
        meets an edge), or one where there is none.
    order : int
        Of those, how many see what is truly crossed, but is not the nearest.
    refused : int
        Triangles and rays that are not finite in this precision, and so are left out.
    largest_t_error : float or None
        In ulp of the certified t (float64), over rays that see the same surface; None without one.
        For the certified row, against the exact t of the judged rays: at most 1/2.
    exact : float or None
        For the certified row: share of the pairs of a ray and a triangle that whole numbers
        decided.
    judged : int
        For the certified row: rays that whole numbers judged.
    """

    scenario: str
    scale: float
    method: str
    precision: str
    rays: int
    missed: int
    doubled: int
    wrong: int
    refused: int
    order: int = 0
    largest_t_error: float | None = None
    exact: float | None = None
    judged: int = 0
    seen: int = 0
    across: float | None = None

    @property
    def lost(self) -> int:
        """Rays that see nothing or something else than they should."""
        return self.missed + self.wrong

    @property
    def share(self) -> float:
        """`lost` as a share of the rays."""
        return self.lost / self.rays


@dataclass(frozen=True)
class BreakingPoint:
    """The first scale of a scenario at which a method goes wrong, each way; None for never."""

    scenario: str
    method: str
    precision: str
    missed: float | None
    wrong: float | None
    doubled: float | None
    lost: float | None  # the first of `missed` and `wrong`

    @property
    def never(self) -> bool:
        """Whether the method holds at every scale."""
        return self.lost is None and self.doubled is None


def breaking_points(rows: Sequence[Row]) -> list[BreakingPoint]:
    """Return where each method first goes wrong in each sweep, in the order of the rows.

    Rows of a map have two scales, and no first one: they are left out.
    """
    sweeps: dict[tuple[str, str, str], list[Row]] = {}
    for row in rows:
        if row.across is None:
            sweeps.setdefault((row.scenario, row.method, row.precision), []).append(row)
    return [
        BreakingPoint(*key, *(_first(sweep, of) for of in ("missed", "wrong", "doubled", "lost")))
        for key, sweep in sweeps.items()
    ]


def _first(sweep: Sequence[Row], of: str) -> float | None:
    return next((row.scale for row in sweep if getattr(row, of)), None)


def written(scale: float | None) -> str:
    """Return a scale in few letters: 1e+08 as 1e8, 179.999 as it is."""
    if scale is None:
        return "-"
    if scale == 0 or 1e-2 <= abs(scale) < 1e4:
        return f"{scale:.10g}"
    mantissa, exponent = f"{scale:.1e}".split("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}"


def _columns(rows: Sequence[Row] | Sequence[BreakingPoint]) -> list[tuple[str, str]]:
    """Return the methods and precisions but the literal textbook, which loses rays everywhere."""
    found = dict.fromkeys((r.method, r.precision) for r in rows)
    return [c for c in found if c[0] != "textbook_literal"]


_LITERAL = "(The literal textbook is left out: it loses rays from the first scale of nearly all.)"
_CELL = 14
_SCALE = 12


def _head(columns: list[tuple[str, str]], first: int) -> list[str]:
    names = ["".ljust(first), "".ljust(first)]
    for method, precision in columns:
        names[0] += NAMES.get(method, method).rjust(_CELL)
        names[1] += precision.rjust(_CELL)
    return names


def table(rows: Sequence[Row]) -> str:
    """Return the sweeps as text: of each scene the rays, in percent, that each method loses.

    Behind a plus: those for which it crosses more triangles than there are.
    """
    columns = _columns(rows)
    known = {s.name: s for s in SCENARIOS}
    lines = [
        "Rays missed or wrong, in percent; + rays that cross more triangles than there are",
        _LITERAL,
        "",
        *_head(columns, _SCALE),
    ]
    sweeps: dict[str, dict[float, dict[tuple[str, str], Row]]] = {}
    for r in rows:
        if r.across is None:
            sweeps.setdefault(r.scenario, {}).setdefault(r.scale, {})[r.method, r.precision] = r
    for name, sweep in sweeps.items():
        lines.append("")
        if name in known:
            scenario = known[name]
            unit = f", {scenario.unit}" if scenario.unit else ""
            lines += [f"{scenario.title} ({scenario.scale_name}{unit}): {scenario.explanation}"]
        for scale, cells in sweep.items():
            line = written(scale).rjust(_SCALE)
            line += "".join(_cell(cells[c]).rjust(_CELL) if c in cells else "" for c in columns)
            lines.append(line)
    return "\n".join(lines)


def _cell(row: Row) -> str:
    doubled = f" +{_percent(row.doubled / row.rays)}" if row.doubled else ""
    return f"{_percent(row.share)}{doubled}" if row.lost or row.doubled else "."


def _percent(share: float) -> str:
    """Return a share in percent; what is not all is not written as all, nor some as none."""
    if share in (0, 1):
        return f"{100 * share:.0f}"
    return f"{min(max(100 * share, 0.1), 99.9):.1f}"


def breaking_table(rows: Sequence[Row]) -> str:
    """Return as text at which scale each method first misses a ray or sees a wrong surface.

    Behind a plus: where it first crosses more triangles than there are.
    """
    points = breaking_points(rows)
    columns = _columns(points)
    by = {(p.scenario, p.method, p.precision): p for p in points}
    known = {s.name: s for s in SCENARIOS}
    first = 2 + max(20 + len(s.scale_name) for s in SCENARIOS)
    lines = [
        "First scale at which a ray is missed or wrong; + at which one crosses too many; . never",
        _LITERAL,
        "",
        *_head(columns, first),
        "",
    ]
    for name in dict.fromkeys(p.scenario for p in points):
        title = name.ljust(20) + (known[name].scale_name if name in known else "")
        cells = (by.get((name, *c)) for c in columns)
        lines.append(
            title[: first - 1].ljust(first) + "".join(_point(p).rjust(_CELL) for p in cells)
        )
    return "\n".join(lines)


def _point(point: BreakingPoint | None) -> str:
    if point is None or point.never:
        return "."
    lost = "." if point.lost is None else written(point.lost)
    return lost if point.doubled is None else f"{lost} +{written(point.doubled)}"

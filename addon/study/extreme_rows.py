"""What was measured of numerical stability: rows, and the breaking points in them.

`extremes.py` measures them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


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
        For the certified row, against the oracle's exact t: at most 1/2.
    exact : float or None
        For the certified row: share of the pairs of a ray and a triangle that integers
        decided.
    judged : int
        For the certified row: rays about which the oracle was asked.
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

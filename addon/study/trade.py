"""The rows of a trade, and the columns that they have."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class TradeRow:
    """One choice of method, precision, samples and size; then what was measured of it."""

    method: str
    precision: str
    samples: int  # colour is the mean of samples x samples rays a pixel
    width: int
    height: int
    seconds: float  # the median of `rounds`
    wrong_pixels: int  # those that see another surface than the certified picture does
    largest_t_error: float | None  # metres along the view axis; None: nowhere a surface in common
    peak_bytes: int  # of the working arrays and the picture, beside the scene
    coverage_error: float  # root mean square of RGBA against the converged picture
    rounds: tuple[float, ...] = ()  # seconds of each repeat; a round measured every row once
    best_pixels: bool = False  # no row of this resolution beats it in time and wrong pixels
    best_coverage: bool = False  # no row beats it in time and coverage error

    @property
    def pixels(self) -> int:
        """The number of pixels in the picture."""
        return self.width * self.height

    @property
    def size(self) -> str:
        """The picture's size and its rays a pixel, as words."""
        rays = f", {self.samples} × {self.samples} rays" if self.samples > 1 else ""
        return f"{self.width} × {self.height}{rays}"

    @property
    def fastest(self) -> float:
        """Seconds of the shortest repeat."""
        return min(self.rounds, default=self.seconds)

    @property
    def slowest(self) -> float:
        """Seconds of the longest repeat."""
        return max(self.rounds, default=self.seconds)

    @property
    def best(self) -> bool:
        """Whether no other row beats it, in wrong pixels or in coverage."""
        return self.best_pixels or self.best_coverage


@dataclass(frozen=True)
class Column:
    """One thing that is measured of each row, and how it is shown.

    The tables, the page, the panel, the plot and the JSON read it from here; `tradeoff.py` measures
    it.
    """

    name: str  # the field of `TradeRow`
    head: str  # above it in a table
    show: Callable[[TradeRow], str]
    unit: str = ""  # what its number is, for the reader of the JSON; empty: the JSON leaves it out
    best: str = ""  # the field that says that no other row beats this one here

    def shown(self, row: TradeRow) -> str:
        """Return its number in a row as text, with a star if no other row beats this one.

        Without one there is room for it, so that the numbers stand below one another.
        """
        if not self.best:
            return self.show(row)
        return self.show(row) + (" *" if getattr(row, self.best) else "  ")


def _t_error(row: TradeRow) -> str:
    return "-" if row.largest_t_error is None else f"{row.largest_t_error:.1e}"


COLUMNS = (
    Column(
        "seconds",
        "seconds",
        lambda r: f"{r.seconds:.4f}",
        unit="seconds, the median of the rounds",
    ),
    Column("rounds", "(min - max)", lambda r: f"({r.fastest:.4f} - {r.slowest:.4f})"),
    Column(
        "wrong_pixels",
        "wrong pixels",
        lambda r: f"{r.wrong_pixels:,}",
        unit="pixels that see another surface than the certified picture does",
        best="best_pixels",
    ),
    Column(
        "largest_t_error",
        "t error, m",
        _t_error,
        unit="metres along the view axis, where both see the same; null: nowhere",
    ),
    Column(
        "peak_bytes",
        "MiB",
        lambda r: f"{r.peak_bytes / 2**20:.1f}",
        unit="bytes of the working arrays and the picture",
    ),
    Column(
        "coverage_error",
        "coverage",
        lambda r: f"{r.coverage_error:.4f}",
        unit="root mean square of linear RGBA against the converged picture",
        best="best_coverage",
    ),
)


@dataclass(frozen=True)
class Trade:
    """The measurements on a scene, and the advice that follows from them."""

    scene: str
    rows: list[TradeRow]
    advice: str
    converged: int  # samples a pixel and direction of the picture that coverage is held against

    @property
    def whole(self) -> list[TradeRow]:
        """The rows of the largest picture with one sample: the methods, side by side."""
        return whole(self.rows)


def whole(rows: Sequence[TradeRow]) -> list[TradeRow]:
    """Return those of the largest picture with one sample."""
    width = max(r.width for r in rows)
    return [r for r in rows if r.width == width and r.samples == 1]

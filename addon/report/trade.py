"""A `Trade` -> a table, `tradeoff.json`, and the plot of time against error."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .. import images
from ..study.trade import Row, Trade
from .folders import finite, replacing, write_json
from .tables import columns
from .trade_plot import picture

SCHEMA = "reference_tracer.tradeoff/1"
TABLE, JSON, PLOT = "tradeoff.txt", "tradeoff.json", "tradeoff.png"

_UNITS = {
    "seconds": "seconds, the median of the rounds",
    "wrong_pixels": "pixels whose surface, seen through the centre, is none of the certified ones",
    "largest_t_error": "metres along the view axis, where both see the same; null: nowhere",
    "peak_bytes": "bytes of the working arrays and the picture",
    "coverage_error": "root mean square of linear RGBA against the converged picture",
}
_HEAD = (
    *("method", "precision", "seconds", "(min - max)", "wrong pixels  ", "t error, m", "MiB"),
    "coverage  ",
)


def table(trade: Trade) -> str:
    """Return the rows as text, a block for each size; a star marks those that no other beats."""
    counts = [(f"{r.wrong_pixels:,}", f"({r.wrong_pixels / r.pixels:.2%})") for r in trade.rows]
    blocks: dict[str, list[list[str]]] = {}
    for r, wrong in zip(trade.rows, columns(counts, left=(), gap=" "), strict=True):
        rays = "one ray" if r.samples == 1 else f"{r.samples} x {r.samples} rays"
        blocks.setdefault(f"{r.width} x {r.height} pixels, {rays} each", []).append(
            _cells(r, wrong)
        )
    lines = [line for title, rows in blocks.items() for line in ("", title, *rows)]
    k = trade.converged
    return "\n".join(
        [
            *columns([_HEAD, *lines], left=(0, 1, 3), gap=" "),
            "",
            "* no other row beats it, as far as the rounds agree on which is faster: beside wrong",
            "  pixels, in time and wrong pixels, of the same size; beside coverage, in time and",
            "  coverage, of all. Coverage is the root mean square of RGBA's difference from",
            f"  {k} x {k} rays a pixel at the largest size.",
            "",
            trade.advice,
        ]
    )


def _cells(r: Row, wrong: str) -> list[str]:
    pixels, coverage = (" *" if best else "  " for best in (r.best_pixels, r.best_coverage))
    t_error = "-" if r.largest_t_error is None else f"{r.largest_t_error:.1e}"
    return [
        *(r.method, r.precision, f"{r.seconds:.4f}", f"({r.fastest:.4f} - {r.slowest:.4f})"),
        *(wrong + pixels, t_error, f"{r.peak_bytes / 2**20:.1f}"),
        f"{r.coverage_error:.4f}{coverage}",
    ]


def to_dict(trade: Trade) -> dict[str, Any]:
    """Return what `tradeoff.json` holds."""
    return {
        "schema": SCHEMA,
        "scene": trade.scene,
        "advice": trade.advice,
        "converged_samples": trade.converged,
        "units": _UNITS,
        "rows": [_row(r) for r in trade.rows],
    }


_HELD = (  # of a row
    *("method", "precision", "samples", "width", "height", "seconds", "fastest", "slowest"),
    *("wrong_pixels", "largest_t_error", "peak_bytes", "coverage_error"),
    *("best", "best_pixels", "best_coverage"),
)


def _row(r: Row) -> dict[str, Any]:
    found = {name: getattr(r, name) for name in _HELD}
    return found | {n: finite(found[n]) for n in ("largest_t_error", "coverage_error")}


def write(directory: str | Path, trade: Trade) -> None:
    """Write `tradeoff.txt`, `tradeoff.json` and `tradeoff.png`, all or none.

    Parameters
    ----------
    directory : path
        Made where it is not there.
    trade : Trade

    Raises
    ------
    MissingLibraryError
        If there can be no plot. The table and the JSON are there all the same.
    OSError
        If the folder cannot be written.
    """
    with replacing(Path(directory), (TABLE, PLOT, JSON)) as new:
        (new / TABLE).write_text(table(trade) + "\n", encoding="utf-8")
        write_json(new / JSON, to_dict(trade))
        images.save_png(new / PLOT, picture(trade))

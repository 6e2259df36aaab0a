"""A `Trade` -> a table, `tradeoff.json` and the plot of what is gained against what is lost."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..images import SavePng
from ..study.trade import Row, Trade
from .folders import replacing
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


def table(trade: Trade) -> str:
    """Return the rows as text, a block for each size; those that no other beats have a star."""
    head, *lines = _lines(trade.rows)
    blocks: dict[str, list[str]] = {}
    for r, line in zip(trade.rows, lines, strict=True):
        rays = "one ray" if r.samples == 1 else f"{r.samples} x {r.samples} rays"
        blocks.setdefault(f"{r.width} x {r.height} pixels, {rays} each", []).append(line)
    k = trade.converged
    return "\n".join(
        [
            head,
            *(line for title, lines in blocks.items() for line in ("", title, *lines)),
            "",
            "* no other row beats it, as far as the rounds agree on which is faster: beside wrong",
            "  pixels, in time and wrong pixels, of the same size; beside coverage, in time and",
            "  coverage, of all. Coverage is the root mean square of RGBA's difference from",
            f"  {k} x {k} rays a pixel at the largest size.",
            "",
            trade.advice,
        ]
    )


_COLUMNS = (  # and on which side their cells are flush
    *(("method", str.ljust), ("precision", str.ljust), ("seconds", str.rjust)),
    *(("(min - max)", str.ljust), ("wrong pixels  ", str.rjust), ("t error, m", str.rjust)),
    *(("MiB", str.rjust), ("coverage  ", str.rjust)),
)


def _lines(rows: Sequence[Row]) -> list[str]:
    """Return the head and a line for each row; columns are as wide as what is in them."""
    counts, shares = [f"{r.wrong_pixels:,}" for r in rows], [_share(r) for r in rows]
    wide, wider = max(map(len, counts)), max(map(len, shares))
    wrong = [f"{c:>{wide}} {s:>{wider}}" for c, s in zip(counts, shares, strict=True)]
    cells = [[name for name, _ in _COLUMNS], *map(_cells, rows, wrong)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    sides = [side for _, side in _COLUMNS]
    return [
        " ".join(side(c, w) for side, c, w in zip(sides, row, widths, strict=True)).rstrip()
        for row in cells
    ]


def _share(r: Row) -> str:
    return f"({r.wrong_pixels / r.pixels:.2%})"


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


def _row(r: Row) -> dict[str, Any]:
    names = (
        *("method", "precision", "samples", "width", "height", "seconds", "fastest", "slowest"),
        *("wrong_pixels", "largest_t_error", "peak_bytes", "coverage_error"),
        *("best", "best_pixels", "best_coverage"),
    )
    found = {name: getattr(r, name) for name in names}
    odd = (n for n in ("largest_t_error", "coverage_error") if not _is_finite(found[n]))
    return found | dict.fromkeys(odd)  # JSON has no infinity


def _is_finite(value: float | None) -> bool:
    return value is not None and bool(np.isfinite(value))


def write(directory: str | Path, trade: Trade, save_png: SavePng) -> None:
    """Write `tradeoff.txt`, `tradeoff.json` and `tradeoff.png`, all or none.

    Parameters
    ----------
    directory : path
        Made where it is not there.
    trade : Trade
    save_png : callable
        Writes an (h, w, 4) uint8 picture, row 0 at the bottom: `images.save_png`, or Blender's own.

    Raises
    ------
    MissingLibraryError
        If there can be no plot. The table and the JSON are there all the same.
    OSError
        If the folder cannot be written.
    """
    text = json.dumps(to_dict(trade), indent=2, allow_nan=False)
    with replacing(Path(directory), (TABLE, PLOT, JSON)) as new:
        (new / TABLE).write_text(table(trade) + "\n", encoding="utf-8")
        (new / JSON).write_text(text + "\n", encoding="utf-8")
        save_png(new / PLOT, picture(trade))

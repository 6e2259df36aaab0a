"""A `Trade` -> a table, `tradeoff.json` and the plot of what is gained against what is lost."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from ..study.trade import Row, Trade
from .files import SavePng
from .folders import replacing
from .trade_plot import picture

SCHEMA = "reference_tracer.tradeoff/1"
TABLE, JSON, PLOT = "tradeoff.txt", "tradeoff.json", "tradeoff.png"

_UNITS = {
    "seconds": "seconds, the median of the rounds",
    "wrong_pixels": "pixels whose surface, seen through the centre, is none of the certified ones",
    "largest_t_error": "metres along the view axis, where both see the same surface",
    "peak_bytes": "bytes of the working arrays and the picture",
    "coverage_error": "root mean square of linear RGBA against the converged picture",
}


def table(trade: Trade) -> str:
    """Return the rows as text, a block for each size; those that no other beats have a star."""
    blocks: dict[str, list[str]] = {}
    for r in trade.rows:
        rays = "one ray" if r.samples == 1 else f"{r.samples} x {r.samples} rays"
        blocks.setdefault(f"{r.width} x {r.height} pixels, {rays} each", []).append(_line(r))
    k = trade.converged
    head = (
        f"{'method':<17}{'precision':<10}{'seconds':>7} {'(min - max)':<17}{'wrong pixels':>16}"
        f"{'t error, m':>13}{'MiB':>7}{'coverage':>10}"
    )
    return "\n".join(
        [
            head,
            *(line for title, lines in blocks.items() for line in ("", title, *lines)),
            "",
            "* no other row beats it, as far as was measurable: in time and wrong pixels, of the",
            "  same size; in time and coverage, of all. Coverage is the root mean square of RGBA's",
            f"  difference from {k} x {k} rays a pixel at the largest size.",
            "",
            trade.advice,
        ]
    )


def _line(r: Row) -> str:
    pixels, coverage = (" *" if best else "" for best in (r.best_pixels, r.best_coverage))
    return (
        f"{r.method:<17}{r.precision:<10}{r.seconds:>7.4f} "
        f"{f'({r.fastest:.4f} - {r.slowest:.4f})':<17}"
        f"{r.wrong_pixels:>7,} {f'({r.wrong_pixels / r.pixels:.2%})':>8}{pixels:<2}"
        f"{r.largest_t_error:>11.1e}{r.peak_bytes / 2**20:>7.1f}"
        f"{r.coverage_error:>10.4f}{coverage}"
    )


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
    # JSON has no infinity.
    return found | {
        name: None for name in ("largest_t_error", "coverage_error") if not np.isfinite(found[name])
    }


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

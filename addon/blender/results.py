"""The latest of each kind of result, for the panels, and the images that show it.

Not stored in the .blend: it speaks of one moment.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..compare.comparison import Comparison
from ..compare.engines import EngineRow
from ..explain.derivation import Derivation
from ..images import MissingLibraryError
from ..methods import Method
from ..report import engines as engines_report
from ..report import extremes as extremes_report
from ..report import trade as trade_report
from ..report.comparison import difference
from ..study.extremes import BreakingPoint, Row, breaking_points
from ..study.trade import Trade
from . import images


@dataclass(frozen=True, eq=False)
class Result:
    """What a panel shows; computed once, since panels are drawn many times a second."""

    file: str
    content: Comparison | Derivation | Trade | tuple[BreakingPoint, ...] | tuple[EngineRow, ...]
    lines: tuple[str, ...]  # what to say, the first of them first; last why there is no picture
    scene: str | None = None  # None: of no scene
    rows: tuple[Row, ...] = ()  # of the extremes, as they were measured


_latest: dict[type, Result] = {}


def keep_comparison(context: Any, comparison: Comparison) -> Result:
    """Remember a comparison, and put its three pictures into images of Blender's."""
    images.show(images.TRACED, comparison.frame.color)
    images.show(images.BLENDER, comparison.picture)
    shown = images.show(images.DIFFERENCE, difference(comparison))
    images.show_in_editor(context, shown)
    return _keep(Comparison, comparison, comparison.lines(), comparison.manifest.scene)


def keep_engines(context: Any, rows: Sequence[EngineRow]) -> Result:
    """Remember the table of several engines."""
    return _keep(EngineRow, tuple(rows), engines_report.lines(rows), context.scene.name)


def keep_trade(context: Any, trade: Trade) -> Result:
    """Remember a trade, and show its plot if there can be one."""
    why = _show_plots(context, lambda: [(images.TRADE, trade_report.picture(trade))], "trade")
    return _keep(Trade, trade, [trade.advice, *why], trade.scene)


def keep_extremes(context: Any, rows: Sequence[Row]) -> Result:
    """Remember where each method breaks, and show the pictures of it if there can be any."""

    def plots() -> Iterable[tuple[str, NDArray[np.uint8]]]:
        return ((images.plot_name(n), p) for n, p in extremes_report.pictures(rows))

    lines = [_extremes_sentence(rows), *_show_plots(context, plots, "extremes")]
    return _keep(BreakingPoint, tuple(breaking_points(rows)), lines, rows=rows)


def _extremes_sentence(rows: Sequence[Row]) -> str:
    """Return in one sentence whether the certified method holds, and which other holds longest."""
    wrong = sum(r.lost + r.doubled for r in rows if not Method(r.method).is_plain)
    sentence = f"Certified gets {f'{wrong:,} rays' if wrong else 'no ray'} wrong"
    points = [p for p in breaking_points(rows) if Method(p.method).is_plain]
    holds = Counter({(p.method, p.precision): 0 for p in points})
    holds.update((p.method, p.precision) for p in points if p.never)
    if holds:
        [((method, precision), count)] = holds.most_common(1)
        total = len({p.scenario for p in points})
        sentence += (
            f"; of the other methods, {Method(method).words} in {precision} holds in the most "
            f"sweeps: {count} of {total}"
            if count
            else f"; every other method breaks in each of {total} sweeps"
        )
    return sentence + "."


def keep_derivation(scene: Any, derivation: Derivation, sentence: str) -> Result:
    """Remember the derivation of a pixel of a scene."""
    return _keep(Derivation, derivation, [sentence], scene.name)


def _show_plots(
    context: Any, plots: Callable[[], Iterable[tuple[str, NDArray[np.uint8]]]], command: str
) -> list[str]:
    """Show pictures, the last one in an image editor; return why not, if there can be none."""
    try:
        shown = None
        for name, picture in plots():
            shown = images.show(name, picture)
        if shown:
            images.show_in_editor(context, shown)
        return []
    except MissingLibraryError:
        return [
            "No picture: this Blender's Python has no Matplotlib. For one, run "
            f'"{sys.executable}" -m pip install matplotlib, and start Blender again; or use '
            f"reftrace {command} outside Blender"
        ]


def _keep(
    kind: type,
    content: Any,
    lines: Iterable[str],
    scene: str | None = None,
    rows: Sequence[Row] = (),
) -> Result:
    _latest[kind] = Result(bpy.data.filepath, content, tuple(lines), scene, tuple(rows))
    return _latest[kind]


def latest(kind: type, scene: Any) -> Result | None:
    """Return the latest result of a kind, if it is of this scene in the file that is open.

    The kinds are Comparison, Derivation, EngineRow, Trade and BreakingPoint.
    """
    found = _latest.get(kind)
    if found and found.file == bpy.data.filepath and found.scene in (None, scene.name):
        return found
    return None


def forget() -> None:
    """Drop all results, as when another file is opened."""
    _latest.clear()

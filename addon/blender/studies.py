"""The trade and the extremes, up to where Blender is no longer needed, and their files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..images import MissingLibraryError
from ..methods import Method
from ..study import tradeoff
from ..study.extremes import Row, breaking_points, measure
from ..study.scenarios.sweeps import ALL
from ..study.trade import Trade
from ..tracer.progress import Work
from .compare import export_open_file

EVERY = "ALL"  # in place of a scenario's name


def trade(context: Any, width: int | None = None, samples: int = tradeoff.SAMPLES) -> Work[Trade]:
    """Export the context's scene at once; return the work of measuring its trade.

    The scene is exported as a render has it, in a window too: the numbers are those of `reftrace`.

    Raises
    ------
    SceneError
        If the scene cannot be traced.
    """
    scene, manifest, _ = export_open_file(context)
    return tradeoff.measure(scene, width, samples, manifest.scene)


def extremes(scenario: str = EVERY, rays: int | None = None) -> Work[list[Row]]:
    """Return the work of tracing every scenario, or all of one name, by every method.

    A map has a scenario for each of its rows.
    """
    return measure([s for s in ALL if scenario in (EVERY, s.name)], rays)


def write(report: Any, folder: Path | None, found: Any) -> None:
    """Write a study as its module of `report` does, if to a folder; without Matplotlib no plot."""
    try:
        if folder:
            report.write(folder, found)
    except MissingLibraryError as error:
        print(f"Reference Tracer: {error}")


def extremes_sentence(rows: Sequence[Row]) -> str:
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

"""Every judge that is here against the same tracer.

All pictures are drawn at once; what is returned then holds nothing of Blender's.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy

from ..arguments import words
from ..compare.case import Case
from ..compare.engines import EngineRow
from ..report import comparison as comparison_report
from ..report import engines as engines_report
from ..report import page
from ..scene import SceneError
from ..tracer.progress import Work, scaled
from .compare import compared, gather, made
from .judges import JUDGES


def compare_all(context: Any, directory: str = "", **choices: Any) -> Work[tuple[EngineRow, ...]]:
    """Have every engine draw the scene; return the work of comparing each.

    Parameters
    ----------
    context : bpy.types.Context
    directory : str
        Where each comparison goes to a folder of its own, and the table; nothing is written if
        empty.
    **choices
        Of :func:`compare.gather`.

    Raises
    ------
    SceneError
        If no engine makes a picture.
    OSError
        If the folder cannot be written.
    """
    folder = made(directory) if directory else None
    here = [j.name for j in JUDGES.values() if not (j.needs_window and bpy.app.background)]
    drawn = [(name, _drawn(context, name, choices)) for name in here]
    if all(isinstance(d, str) for _, d in drawn):
        raise SceneError(f"no engine makes a picture of this scene: {drawn[0][1]}")
    return _compared(drawn, folder)


def _drawn(context: Any, engine: str, choices: dict[str, Any]) -> Case | str:
    """Return what is gathered for an engine, or why it makes no picture."""
    try:
        return gather(context, judge=engine.upper(), **choices)
    except (SceneError, RuntimeError) as error:  # one engine cannot draw what others can
        return words(error)


def _compared(
    drawn: list[tuple[str, Case | str]], folder: Path | None
) -> Work[tuple[EngineRow, ...]]:
    rows = []
    for number, (engine, gathered) in enumerate(drawn):
        if isinstance(gathered, str):
            rows.append(EngineRow(engine, "failed", error=gathered))
            continue
        share = 1 / len(drawn)
        part = 0.9 if folder else 1.0  # of the share; the rest is what the page shows besides
        work = compared(gathered)
        comparison = yield from scaled(work, number * share, part * share)
        rows.append(EngineRow.of(comparison))
        if folder:
            finding = page.extras(comparison)
            extras = yield from scaled(finding, (number + part) * share, (1 - part) * share)
            comparison_report.write(folder / engine, comparison, extras)
    if folder:
        engines_report.write(folder, rows)
    return tuple(rows)

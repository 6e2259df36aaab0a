"""Compare All Engines: has each engine of this Blender draw the scene, and compares each picture.

These are Blender's own, and those that add-ons register.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
from bpy.types import Context

from ...causes.case import Case
from ...comparison.comparing import compared
from ...comparison.engines import EngineRow
from ...comparison.verdict import Verdict
from ...errors import words
from ...pictures.source import SizeError
from ...report import comparison as comparison_report
from ...report import engines as engines_report
from ...scene import SceneError
from ...tracer.progress import Work, scaled
from ..drawing.engines import others
from ..drawing.judges import JUDGES
from .compare import gather_case
from .open_file import Choices


def compare_all(
    context: Context, folder: Path | None = None, **choices: Any
) -> Work[tuple[EngineRow, ...]]:
    """Have every engine draw the scene at once; return the work of comparing each.

    Each comparison goes to a folder of its own in this one, and the table into it; nothing is
    written without one. The choices are the fields of :class:`Choices`.

    Raises
    ------
    SceneError
        If no engine makes a picture.
    """
    known = (*JUDGES.values(), *others().values())
    here = [j.name for j in known if not (j.needs_window and bpy.app.background)]
    drawn: list[tuple[str, Case | str]] = []  # or why there is no picture
    for name in here:
        try:
            drawn.append((name, gather_case(context, judge=name.upper(), **choices)))
        except (
            SceneError,
            SizeError,
            RuntimeError,
        ) as error:  # one engine cannot draw what others can
            drawn.append((name, words(error)))
    if all(isinstance(d, str) for _, d in drawn):
        raise SceneError(f"no engine makes a picture of this scene: {drawn[0][1]}")
    return _all_compared(drawn, folder, Choices.of(context.scene, choices).diagnose)


def _all_compared(
    drawn: list[tuple[str, Case | str]], folder: Path | None, diagnose: bool
) -> Work[tuple[EngineRow, ...]]:
    rows = []
    for number, (engine, gathered) in enumerate(drawn):
        if isinstance(gathered, str):
            rows.append(EngineRow(engine, Verdict.FAILED, error=gathered))
            continue
        work = compared(gathered)
        if folder:
            work = comparison_report.written(folder / engine, gathered, diagnose)
        comparison = yield from scaled(work, number / len(drawn), 1 / len(drawn))
        rows.append(EngineRow.of(comparison))
    if folder:
        engines_report.write(folder, rows)
    return tuple(rows)

"""Writes the table, the JSON and the page of an animation, and says which frames are whole."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import starmap
from pathlib import Path

from ..comparison.animation import FrameRow, worst_first
from ..comparison.verdict import Verdict
from ..wording import count_of
from . import comparison, page
from .folders import write_all, write_text
from .plots import Entry, Panel, Plot, Scale, Series
from .shown import data
from .tables import columns
from .templates import html

SCHEMA = "reference_tracer.animation/1"
JSON, PAGE = "animation.json", "animation.html"
_MADE_BY = "made_by.json"  # in the folder of a frame that is whole
_HEAD = "frame", "agree", "explained", "unexplained", "verdict"
_LISTED = 10  # of the worst frames, on a terminal
_PICTURED = 6  # of the worst frames, on the page
_SHOWN = {"blender.png": "the picture", "difference.png": "causes"}
_CURVES = {"explained": "#0072b2", "unexplained": "#d55e00"}  # colours of the page's two curves


def folder_of(directory: str | Path, frame: int) -> Path:
    """Return the folder of a frame's comparison."""
    return Path(directory) / f"frame_{frame:04d}"


def mark_whole(directory: Path, frame: int, made_by: object) -> None:
    """Note what a frame was made by, once its files are complete."""
    folder = folder_of(directory, frame)
    text = json.dumps({"made_by": made_by, "bytes": _sizes(folder)}, indent=2)
    write_text(folder / _MADE_BY, text + "\n")


def row_of_whole(directory: Path, frame: int, made_by: object) -> FrameRow | None:
    """Return the row of a frame that is whole and made by this; any other is no longer marked."""
    folder = folder_of(directory, frame)
    try:
        found = json.loads((folder / _MADE_BY).read_text("utf-8"))
        if made_by and found == {"made_by": made_by, "bytes": _sizes(folder)}:
            return FrameRow.of(frame, json.loads((folder / comparison.JSON).read_text("utf-8")))
    except (OSError, ValueError, KeyError):
        pass
    (folder / _MADE_BY).unlink(missing_ok=True)
    return None


def _sizes(folder: Path) -> dict[str, int]:
    return {name: (folder / name).stat().st_size for name in comparison.NAMES}


def write(directory: Path, title: str, frames: range, rows: Sequence[FrameRow]) -> None:
    """Write the rows that are done of the requested frames, as a table and as a page.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    held = {
        "schema": SCHEMA,
        "title": title,
        "asked_for": [frames[0], frames[-1], frames.step],
        "frames": [row._asdict() for row in worst_first(rows)],
        "verdict": verdict(rows),
    }
    write_all(directory, {PAGE: _page(title, frames, rows, directory), JSON: held})


def verdict(rows: Sequence[FrameRow]) -> Verdict:
    """Return the gravest verdict."""
    return Verdict.gravest(row.verdict for row in rows) if rows else Verdict.CANCELLED


def line(row: FrameRow) -> str:
    """Return what came of a frame, as a line."""
    counts = f"agree {row.agree:,} / explained {row.explained:,} / unexplained {row.unexplained:,}"
    return f"frame {row.frame}: {row.error or counts}"


def lines(frames: range, rows: Sequence[FrameRow]) -> list[str]:
    """Return the table of the worst frames, and the verdict of all."""
    table = columns([_HEAD, *map(_cells, worst_first(rows)[:_LISTED])], left=(4,))
    more = [f"and {len(rows) - _LISTED:,} more, in {PAGE}"] if len(rows) > _LISTED else []
    done = f"{len(rows):,} of {count_of(len(frames), 'frame is', 'frames are')} done"
    return [*table, *more, done, f"verdict: {verdict(rows)}"]


def _cells(row: FrameRow) -> list[str]:
    if row.error:
        return [str(row.frame), "-", "-", "-", f"{row.verdict}: {row.error}"]
    counts = row.agree, row.explained, row.unexplained
    why = f": {row.excused:,} px rest on rounding alone" if row.excused else ""
    return [str(row.frame), *(f"{n:,}" for n in counts), f"{row.verdict}{why}"]


def _page(title: str, frames: range, rows: Sequence[FrameRow], directory: Path) -> str:
    return html(
        {
            "title": title,
            "summary": ", ".join(lines(frames, rows)[-2:]),
            "plots": [data(_curves(frames, [r for r in rows if not r.error]))],
            "worst": list(_pictures(directory, rows)),
            "head": _HEAD,
            "frames": [{"link": _link(row), "cells": _cells(row)} for row in worst_first(rows)],
        },
        "animation.html",
    )


def _pictures(directory: Path, rows: Sequence[FrameRow]) -> Iterator[dict[str, object]]:
    """Yield the worst frames in which something differs, with their files' pictures."""
    worst = [r for r in worst_first(rows) if r.explained or r.unexplained][:_PICTURED]
    for row in worst:
        pictures = []
        for name, what in _SHOWN.items():
            with suppress(OSError):
                stored = (folder_of(directory, row.frame) / name).read_bytes()
                png = base64.b64encode(stored).decode("ascii")
                pictures.append({"png": png, "alt": f"frame {row.frame}: {what}"})
        if pictures:
            counts = f"{row.unexplained:,} unexplained, {row.explained:,} explained"
            yield {
                "link": _link(row),
                "words": f"frame {row.frame}: {counts}",
                "bad": bool(row.unexplained),
                "pictures": pictures,
            }


def _link(row: FrameRow) -> str:
    """Return where a frame's page is; "" if it failed: what is there is of an earlier run."""
    return "" if row.error else f"{folder_of('', row.frame).as_posix()}/{page.NAME}"


def _curves(frames: range, rows: Sequence[FrameRow]) -> Plot:
    """Plot how many pixels of each frame differ; a point says its frame's numbers."""
    most = max((max(r.explained, r.unexplained) for r in rows), default=0)
    series = {
        kind: Series(
            color,
            [(r.frame, getattr(r, kind), line(r)) for r in sorted(rows)],
            kind == "unexplained",
            width=3,
        )
        for kind, color in _CURVES.items()
    }
    x = Scale(frames[0], max(frames[-1], frames[0] + 1), "integers")
    y = Scale(0, max(most, 1), "integers")
    title = "Pixels that differ, by frame"
    panel = Panel(title, "frame", "pixels", x, y, [*series.values()])
    return Plot(title, count_of(len(rows), "frame"), [panel], [*starmap(Entry, series.items())])

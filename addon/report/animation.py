"""The frames of an animation -> a table, its JSON and its page; and which of them are whole."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape
from pathlib import Path
from string import Template
from typing import Any

from ..compare.animation import FrameRow, worst_first
from . import comparison, page
from .folders import replacing, write_json, write_text
from .tables import columns

SCHEMA = "reference_tracer.animation/1"
JSON, PAGE = "animation.json", "animation.html"
_MADE_BY = "made_by.json"  # in the folder of a frame that is whole
_HEAD = "frame", "agree", "explained", "unexplained", "verdict"
_LISTED = 10  # of the worst frames, on a terminal
_WIDTH, _HEIGHT = 1000, 240  # of the page's curve


def folder_of(directory: str | Path, frame: int) -> Path:
    """Return the folder of a frame's comparison."""
    return Path(directory) / f"frame_{frame:04d}"


def mark_whole(directory: Path, frame: int, made_by: Any) -> None:
    """Say what a frame was made by, whose files are whole now."""
    folder = folder_of(directory, frame)
    text = json.dumps({"made_by": made_by, "bytes": _sizes(folder)}, indent=2)
    write_text(folder / _MADE_BY, text + "\n")


def row_of_whole(directory: Path, frame: int, made_by: Any) -> FrameRow | None:
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
    """Write the rows that are done of the frames that are asked for, as a table and as a page.

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
    with replacing(directory, (PAGE, JSON)) as new:
        text = _page(title, frames, rows)
        (new / PAGE).write_text(text, encoding="utf-8", errors="backslashreplace")
        write_json(new / JSON, held)


def verdict(rows: Sequence[FrameRow]) -> str:
    """Return the gravest verdict."""
    return worst_first(rows)[0].verdict if rows else "cancelled"


def line(row: FrameRow) -> str:
    """Return what came of a frame, as a line."""
    counts = f"agree {row.agree:,} / explained {row.explained:,} / unexplained {row.unexplained:,}"
    return f"frame {row.frame}: {row.error or counts}"


def lines(frames: range, rows: Sequence[FrameRow]) -> list[str]:
    """Return the table of the worst frames, and the verdict of all."""
    table = columns([_HEAD, *map(_cells, worst_first(rows)[:_LISTED])], left=(4,))
    more = [f"and {len(rows) - _LISTED:,} more, in {PAGE}"] if len(rows) > _LISTED else []
    done = f"{len(rows):,} of {len(frames):,} frames are done"
    return [*table, *more, done, f"verdict: {verdict(rows)}"]


def _cells(row: FrameRow) -> list[str]:
    counts = row.agree, row.explained, row.unexplained
    counts = ("-" if row.error else f"{n:,}" for n in counts)
    return [str(row.frame), *counts, f"{row.verdict}: {row.error}" if row.error else row.verdict]


def _page(title: str, frames: range, rows: Sequence[FrameRow]) -> str:
    compared = sorted((r for r in rows if not r.error), key=lambda r: r.frame)
    most = max((max(r.explained, r.unexplained) for r in compared), default=0)
    table = ["".join(f"<th>{name}</th>" for name in _HEAD)]
    for row in worst_first(rows):
        frame, *cells = map(escape, _cells(row))
        table.append("".join(f"<td>{c}</td>" for c in (_linked(row, frame), *cells)))
    return Template(page.template("animation.html")).substitute(
        title=escape(title),
        summary=", ".join(lines(frames, rows)[-2:]),
        first=frames[0],
        last=frames[-1],
        most=f"{most:,}",
        curves="\n".join(
            _curve(frames, compared, kind, most) for kind in ("explained", "unexplained")
        ),
        table="\n".join(f"<tr>{cells}</tr>" for cells in table),
    )


def _linked(row: FrameRow, content: str) -> str:
    name = comparison.JSON if row.error else page.NAME
    return f'<a href="{folder_of("", row.frame).as_posix()}/{name}">{content}</a>'


def _curve(frames: range, rows: Sequence[FrameRow], kind: str, most: int) -> str:
    """Draw how many pixels there are of a kind, each frame's point a link to its page."""
    places = [
        f"{_WIDTH * (row.frame - frames[0]) / max(frames[-1] - frames[0], 1):.1f} "
        f"{_HEIGHT * (1 - getattr(row, kind) / max(most, 1)):.1f}"
        for row in rows
    ]
    dots = (
        _linked(r, f'<circle r="4" transform="translate({p})"><title>{line(r)}</title></circle>')
        for r, p in zip(rows, places, strict=True)
    )
    path = f'<path d="M{"L".join(places)}" />' if rows else ""
    return f'<g class="{kind}">{path}{"".join(dots)}</g>'

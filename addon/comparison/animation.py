"""The result of an animation, compared frame by frame."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from ..files.checked_json import Content
from .verdict import Verdict

_NAMED = re.compile(r"(-?\d{1,7})(?:-(-?\d{1,7})(?::(\d{1,7}))?)?")
_LAST = 1_048_574  # Blender's largest frame number


def frames_named(text: str) -> range | None:
    """Return the frames that a user names; None for `all`, which is the scene's own range.

    Raises
    ------
    ValueError
        If the text names no frames.
    """
    if text == "all":
        return None
    if found := _NAMED.fullmatch(text):
        first = int(found[1])
        last = int(found[2] or first)
        step = int(found[3] or 1)
        if -_LAST <= first <= last <= _LAST and step:
            return range(first, last + 1, step)
        if last < first:
            raise ValueError(f"is {text}, which ends before it begins: {last}-{first} does not")
    raise ValueError(
        f"is {text}; it must be 1-250, 1-250:5 for every fifth, 7, or all, for example"
    )


class FrameRow(NamedTuple):
    """The result of one frame: counts of pixels, or why it was not compared."""

    frame: int
    verdict: Verdict = Verdict.FAILED
    agree: int = 0
    explained: int = 0
    unexplained: int = 0
    excused: int = 0  # of those that rest on rounding, if they are too many; see `excused.py`
    error: str = ""

    @classmethod
    def of(cls, frame: int, found: Content) -> FrameRow:
        """Return the row of a comparison, as its JSON holds it."""
        p = found["pixels"]
        explained = p["differ"] - p["unexplained"]
        rests = found["excused"]
        excused = rests["pixels"] if rests["share"] > rests["most"] else 0
        return cls(
            frame, Verdict(found["verdict"]), p["agree"], explained, p["unexplained"], excused
        )


def worst_first(rows: Iterable[FrameRow]) -> list[FrameRow]:
    """Sort rows by verdict, then by unexplained pixels, then by all that differ."""

    def gravity(row: FrameRow) -> tuple[int, ...]:
        return -row.verdict.gravity, -row.unexplained, -row.explained, row.frame

    return sorted(rows, key=gravity)

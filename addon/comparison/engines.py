"""Compares several engines' pictures with the certified one: where each is wrong, and why."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..causes.cause import UNEXPLAINED
from ..causes.checks.unmodelled import drawn_over
from ..causes.counts import EXAMPLES, PixelCounts
from ..causes.explain import BY_NUMBER, CAUSES
from ..diagnosis.fault_rows import FaultRow
from ..files.checked_json import Content
from ..pictures.identity import NOTHING, UNKNOWN
from .comparison import Comparison
from .verdict import Verdict

SCHEMA = "reference_tracer.engines/1"


class EngineRow(NamedTuple):
    """The result of one engine's picture."""

    engine: str
    verdict: Verdict
    counts: PixelCounts | None = None  # None: there is no picture
    wrong: tuple[Content, ...] = ()
    wrong_objects: int | None = None  # pixels that show another object; None: not known
    error: str = ""  # why there is no picture
    not_judged: tuple[str, ...] = ()  # lines on what cannot be judged, and why
    self_check: tuple[FaultRow, ...] = ()

    @classmethod
    def of(cls, comparison: Comparison) -> EngineRow:
        """Return the row of a comparison."""
        identity = comparison.identity
        return cls(
            comparison.case.picture.source.name,
            comparison.verdict,
            comparison.counts,
            tuple(_wrong(comparison)),
            None if identity is None else identity.shows().other_object,
            not_judged=(*comparison.not_judged(), *comparison.case.picture.source.remarks),
            self_check=comparison.self_check,
        )

    def to_dict(self) -> dict[str, object]:
        """Return the row as JSON can hold it."""
        counts = self.counts and self.counts.to_dict()
        if counts:
            del counts["examples"]
        return {
            "engine": self.engine,
            "verdict": self.verdict,
            "pixels": counts,
            "wrong": list(self.wrong),
            "wrong_objects": self.wrong_objects,
            "error": self.error,
            "not_judged": list(self.not_judged),
            "self_check": [fault.to_dict() for fault in self.self_check],
        }


def _wrong(comparison: Comparison) -> list[Content]:
    """Return the first pixels that differ, the unexplained ones first: both sides, and why."""
    causes, frame = comparison.causes, comparison.frame
    identity = comparison.identity
    drawn = drawn_over(comparison.case.picture)
    differ = np.isin(causes.cause, [c for c in CAUSES if c.explains or c == UNEXPLAINED])
    places = np.argwhere(differ)
    order = np.argsort(causes.cause[differ] != UNEXPLAINED, kind="stable")
    out = []
    for y, x in places[order][:EXAMPLES]:
        row = {
            "pixel": [int(x), int(y)],
            "traced": _name(comparison.scene.objects, int(frame.object_index[y, x])),
            "triangle": int(frame.triangle_index[y, x]),
            "cause": BY_NUMBER[causes.cause[y, x]].label,
            "why": comparison.why(x, y),
        }
        if identity is not None:
            row["shown"] = _name(identity.names, int(identity.shown[y, x]))
        if drawn[y, x] != NOTHING:
            row["beneath"] = str(comparison.manifest.unmodelled[drawn[y, x]])
        out.append(row)
    return out


def _name(names: Sequence[str], index: int) -> str:
    return {NOTHING: "nothing", UNKNOWN: "not known"}.get(index) or names[index]


def worst(rows: Sequence[EngineRow]) -> Verdict:
    """Return the gravest verdict; an engine that made no picture is a warning."""
    return Verdict.gravest(row.verdict if row.counts else Verdict.WARNINGS for row in rows)


def to_dict(rows: Sequence[EngineRow]) -> dict[str, object]:
    """Return all engines as JSON can hold them."""
    engines = [row.to_dict() for row in rows]
    return {"schema": SCHEMA, "engines": engines, "verdict": worst(rows)}

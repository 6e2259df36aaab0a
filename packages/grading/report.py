"""A judgement as JSON can hold it, by `judge.schema.json`; `class_folder.py` writes it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from .judging import Judgement
from .picture import Look
from .subjects.subject import Subject
from .tables import explain

SCHEMA = "reference_tracer.judge/1"

Student = dict[str, Any]  # what the JSON has of one
Pages = Sequence[tuple[Student, str]]  # several, with the paths of their pages

_UNITS = {
    "score": "0 to 100: score_as_is, or what the file would get with its mistakes put right, less "
    "20 for each, where they explain all of its answers",
    "score_as_is": "the mean over the checks and all scenes of the weighted shares",
    "total": "of the interior: pixels (checks: cases) where something is, or is said to be, hit",
    "shares": "of the total the first, as of the right surface; of what has that right the others",
    "boundary": "pixels where float64 may see another surface: counted apart, not in the score",
    "leaking": "edges that two triangles share, a ray through which misses both: not in the score",
    "stride": "every so many pixels were judged, in both directions",
    "pixel": "[x, y] of the picture, or of its border, from the lower left",
    "given": "of a scene in metres, world space",
    "seconds": "that the student's function itself has taken",
}


def to_dict(subject: Subject, students: Sequence[Student]) -> dict[str, Any]:
    """Return what `judge.json` holds of some students."""
    return {
        "schema": SCHEMA,
        "units": _UNITS,
        "subject": subject.name,
        "weights": subject.weights,
        "checks": subject.groups,
        "students": list(students),
    }


def student(j: Judgement) -> Student:
    """Return what is said of one student."""
    return {
        "file": j.name,
        "verdict": j.verdict,
        "score": j.score,
        "score_as_is": j.as_is,
        "seconds": round(j.seconds, 6),
        "printed_bytes": j.printed,
        "printed": j.said,
        "errors": [{"where": where} | error.to_dict() for where, error in j.errors],
        "faults": [asdict(fault) for fault in j.faults],
        "shared_edges": asdict(j.edges) if j.edges else None,
        "checks": j.checks.to_dict() if j.checks else None,
        "wrong_cases": [asdict(case) for case in j.wrong],
        "scenes": [_scene(found) for found in j.looks],
    }


def _scene(found: Look) -> dict[str, Any]:
    judged = found.judged
    height, width = judged.shape
    return {
        "name": judged.name,
        "source": judged.source,
        "width": width,
        "height": height,
        "stride": judged.stride,
        "first": judged.first,
        "seconds": round(found.seconds, 6),
        "pixels": found.counts,
        "tally": found.tally.to_dict(),
        "examples": [asdict(e) | {"explain": explain(judged, e)} for e in found.examples],
    }

"""Formats for other programs: a table, JUnit's XML, Gradescope's results.

Each takes the students with their pages' paths, and yields files: a path in the folder, its text.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable, Iterator
from pathlib import PurePosixPath

from reference_tracer.report.junit import Judged, junit

from .judging import CHECKS
from .report import Pages, Student
from .tables import VERDICTS, wrong_names

Files = Iterator[tuple[str, str]]


def as_csv(pages: Pages) -> Files:
    """Yield a table with a row for each student."""
    text = io.StringIO(newline="")
    table = csv.writer(text)
    table.writerow(("file", "score", "score_as_is", "verdict", "what is wrong"))
    for s, _ in pages:
        name = s["file"]
        if name.startswith(("=", "+", "-", "@", "\t", "\r")):
            name = f"'{name}"  # so that a spreadsheet takes it for no formula
        table.writerow((name, s["score"], s["score_as_is"], s["verdict"], wrong_names(s)))
    yield "judge.csv", text.getvalue()


def as_junit(pages: Pages) -> Files:
    """Yield JUnit's XML: a suite for each student, a case for the checks and for each scene."""
    suites = {s["file"]: [_judged(s, *part) for part in _parts(s)] for s, _ in pages}
    yield "judge.xml", junit("reftrace judge", suites)


def _judged(s: Student, name: str, score: float, right: bool) -> Judged:
    if right:
        return Judged(name)
    message = f"{score:.1f} of 100: {wrong_names(s)}"
    return Judged(name, message, "\n".join(_sentences(s)))


def as_gradescope(pages: Pages) -> Files:
    """Yield what an autograder of Gradescope leaves as results.json, for each student."""
    for s, page in pages:
        tests = [{"name": name, "score": v, "max_score": 100.0} for name, v, _ in _parts(s)]
        found = {
            "score": s["score"],
            "execution_time": s["seconds"],
            "output": "\n".join([f"{VERDICTS[s['verdict']].capitalize()}.", *_sentences(s)]),
            "output_format": "text",
            "tests": tests,
        }
        path = f"gradescope/{PurePosixPath(page).stem}/results.json"
        yield path, json.dumps(found, indent=1, ensure_ascii=False) + "\n"


FORMATS: dict[str, Callable[[Pages], Files]] = {
    "csv": as_csv,
    "gradescope": as_gradescope,
    "json": lambda pages: iter(()),  # judge.json is always there
    "junit": as_junit,
}


def _parts(s: Student) -> list[tuple[str, float, bool]]:
    """Return the checks and each scene: name, score, and whether all is right."""
    tallies = [(CHECKS, s["checks"]), *((k["name"], k["tally"]) for k in s["scenes"])]
    well = {CHECKS: not s["faults"]}  # some show in no share of a score
    parts = [
        (name, t["score"], t["score"] == 100 and well.get(name, True)) for name, t in tallies if t
    ]
    return parts + [(error["where"], 0.0, False) for error in s["errors"]]


def _sentences(s: Student) -> list[str]:
    errors = [f"{e['where']}: {e['message']}" for e in s["errors"]]
    return errors + [f"{f['name']}: {f['sentence']}" for f in s["faults"]]

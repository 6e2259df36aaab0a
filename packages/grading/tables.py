"""Judgements of students' files -> text: a table for each, and a row for each of a class."""

from __future__ import annotations

import os
import shlex
import subprocess
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from reference_tracer.report.tables import columns, percent
from reference_tracer.wording import count_of

from .judged_scene import JudgedScene
from .judging import CHECKS, Judgement
from .picture import EXCUSED, Mark
from .tally import COST, Tally
from .wrong_case import WrongCase

VERDICTS = {
    "right": "all right",
    "boundary": "right but for pixels where float64 may see either surface",
    "wrong": "wrong",
    "failed": "failed",
}
MARKS = {
    Mark.RIGHT: "right",
    Mark.EDGE: "at an edge, within rounding",
    Mark.DEPTH_TIE: "two surfaces at one depth",
    Mark.MISSED: "missed",
    Mark.FALSE_HIT_IN_FRONT: "hit a triangle that the ray misses, in front of what is seen",
    Mark.FALSE_HIT: "hit, but there is nothing",
    Mark.WRONG_ORDER: "not the nearest",
    Mark.WRONG_T: "wrong t",
    Mark.WRONG_BARYCENTRICS: "wrong barycentrics",
    Mark.WRONG_T_AND_BARYCENTRICS: "wrong t and wrong barycentrics",
    Mark.RAISED: "an exception is raised",
}
NO_BOUNDARY = (
    "boundary -: no ray that counts there passes an edge, or two surfaces, within rounding"
)


def explain(judged: JudgedScene, case: WrongCase) -> str:
    """Return the command that derives a wrong pixel, step by step."""
    source = Path(judged.source)
    if source.exists() and source.resolve().is_relative_to(Path.cwd()):
        source = Path(os.path.relpath(source))
    joined = subprocess.list2cmdline if os.name == "nt" else shlex.join
    pixel = map(str, case.pixel or ())
    return joined(["reftrace", "explain", str(source), "--pixel", *pixel, *judged.camera_options])


def lines(j: Judgement) -> list[str]:
    """Return what a student wants to know, a fact a line."""
    out = [f"{j.name}: {VERDICTS[j.verdict]}, score {j.score:.1f} of 100"]
    if j.score > j.as_is:
        out += wrapped(put_right(j))
    for where, error in j.errors:
        out += wrapped(f"its own error, in {where}: {error.message}")
        out += [f"    {line}" for line in error.lines]
    for fault in j.faults:
        out += wrapped(f"{fault.name} ({fault.pairs:,} checks): {fault.sentence}")
    if j.leaks:
        out += wrapped(j.leaks)
    if j.printed:
        first = j.said.strip().splitlines()[:1]
        out.append(f"  it prints ({count_of(j.printed, 'byte')}): {' '.join(first)[:120]}")
    if rows := counts(j):
        out += ["", *columns(rows), *notes(rows)]
    out += _wrong_pixels(j)
    return out


def wrapped(text: str) -> list[str]:
    """Return a fact in lines that a terminal has room for."""
    return textwrap.wrap(text, 96, initial_indent="  ", subsequent_indent="    ")


def put_right(j: Judgement) -> str:
    """Return why a file has more points than its answers."""
    mistakes = count_of(len(j.alike.wrong) if j.alike else 0, "mistake")
    rest = "all is right" if j.put_right == 100 else f"it has {j.put_right:.1f}"
    return f"{j.as_is:.1f} as it is: with {mistakes} put right {rest}, less {COST:g} for each"


def counts(j: Judgement) -> list[tuple[str, ...]]:
    """Return a table of the counts of what was finished, its head first; empty if nothing was."""
    found = [(CHECKS, j.checks)] if j.checks else []
    found += [(k.judged.name, k.tally) for k in j.looks]
    head = "", "counted", *j.subject.weights, "boundary", "score"
    return [head, *(_row(*each) for each in found)] if found else []


def notes(rows: Sequence[Sequence[str]]) -> list[str]:
    """Return what a reader wants to know of a table of counts: what no boundary means."""
    return [NO_BOUNDARY] if any(border == "-" for *_, border, _ in rows) else []


def _row(name: str, tally: Tally) -> tuple[str, ...]:
    border = f"{tally.boundary_right:,} of {tally.boundary:,}" if tally.boundary else "-"
    if not tally.total:
        return name, "0", *("-" for _ in tally.shares), border, "-"
    shares = (f"{percent(v)} %" for v in tally.shares.values())
    return name, f"{tally.total:,}", *shares, border, f"{tally.score:.1f}"


def _wrong_pixels(j: Judgement) -> list[str]:
    out = []
    for found in j.looks:
        counts = [
            f"{n:,} {MARKS[m]}{' (not counted)' if m in EXCUSED else ''}"
            for m in Mark
            if m != Mark.RIGHT and (n := found.counts[m.name.lower()])
        ]
        if counts:
            out += ["", f"{found.judged.name}: {'; '.join(counts)}"]
            out += [f"  {named(e)}: {explain(found.judged, e)}" for e in _one_each(found.examples)]
    return out


def _one_each(cases: Sequence[WrongCase]) -> list[WrongCase]:
    """Return the first case of each mark."""
    return list({e.group: e for e in reversed(cases)}.values())[::-1]


def named(case: WrongCase) -> str:
    """Return which pixel of a scene it is, and what is wrong there; of a check its group."""
    if case.pixel is None:
        return case.group
    return f"{case.pixel} {case.object}, {MARKS[Mark[case.group.upper()]]}"


def wrong_names(s: Mapping[str, Any]) -> str:
    """Return the names of what is wrong with a student, as `judge.json` has him, each once."""
    names = [e["kind"] for e in s["errors"]] + [f["name"] for f in s["faults"]]
    return ", ".join(dict.fromkeys(names))


def class_table(students: Sequence[Mapping[str, Any]]) -> list[str]:
    """Return a row for each of several students, as `judge.json` has them."""
    rows = [("file", "score", "verdict", "what is wrong")]
    for s in students:
        rows.append((s["file"], f"{s['score']:.1f}", VERDICTS[s["verdict"]], wrong_names(s)))
    return columns(rows, left=(0, 2, 3))

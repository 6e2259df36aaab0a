"""A page for each student, and one for the teacher: no network, no script, pictures within.

Whatever comes from a student's file or a scene is escaped.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path
from urllib.parse import quote

import numpy as np
from reference_tracer.arrays import Bytes
from reference_tracer.files import png
from reference_tracer.files.images import data_uri, to_display
from reference_tracer.wording import count_of

from .judging import Judgement
from .picture import Look, Mark
from .report import Pages
from .student_error import StudentError
from .subjects.subject import Subject
from .tables import MARKS, VERDICTS, counts, explain, named, notes, put_right, wrong_names
from .wrong_case import WrongCase

_STYLE = Path(__file__).with_name("page.css")
MARK_COLORS = {  # sRGB; told apart without telling red from green (after Okabe and Ito)
    Mark.EDGE: (70, 70, 70),
    Mark.DEPTH_TIE: (86, 180, 233),
    Mark.MISSED: (213, 60, 0),
    Mark.FALSE_HIT_IN_FRONT: (112, 40, 122),
    Mark.FALSE_HIT: (204, 121, 167),
    Mark.WRONG_ORDER: (0, 80, 178),
    Mark.WRONG_T: (0, 158, 115),
    Mark.WRONG_BARYCENTRICS: (236, 200, 30),
    Mark.WRONG_T_AND_BARYCENTRICS: (122, 98, 12),
    Mark.RAISED: (255, 0, 255),
}
_DIM = 0.35
_WARNING = (
    "These numbers were made by <strong>running the students' own code</strong>, in a process of "
    "its own with a time limit, in bubblewrap where that works. Elsewhere that is not a sandbox: "
    "the code could do whatever the one who started it may. This page itself runs nothing."
)


def page(j: Judgement) -> str:
    """Return the page of one student, which names no other."""
    return _whole(f"{j.name}, judged", [_student(j)])


def class_page(pages: Pages, title: str) -> str:
    """Return the teacher's page: a table of all students, with links to their pages.

    `title` is what the students' work is called, as "ray/triangle tests".
    """
    rows = []
    for s, link in pages:
        name = f'<a href="{quote(link)}">{escape(s["file"])}</a>'
        verdict = _verdict(s["verdict"])
        rows.append((name, f"{s['score']:.1f}", verdict, escape(wrong_names(s))))
    table = _table(("file", "score", "verdict", "what is wrong"), rows, words=(0, 2, 3))
    warning = f'<p class="warning">{_WARNING}</p>'
    return _whole(f"Students’ {title}, judged", [warning, table])


def _whole(title: str, content: Sequence[str]) -> str:
    named = f"<title>{escape(title)}</title>"
    parts = [
        "<!doctype html>",
        f'<html lang="en"><head><meta charset="utf-8">{named}',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<style>{_STYLE.read_text(encoding='utf-8')}</style></head><body><main>",
        f"<h1>{escape(title)}</h1>",
        *content,
        "</main></body></html>",
        "",
    ]
    return "\n".join(parts)


def _verdict(verdict: str) -> str:
    return f'<span class="verdict {verdict}">{VERDICTS[verdict]}</span>'


def _table(names: Sequence[str], rows: Sequence[Sequence[str]], words: Sequence[int] = (0,)) -> str:
    """Return a table of cells that are HTML already; the columns of `words` are flush left."""
    kind = [' class="words"' if k in words else "" for k in range(len(names))]
    top = "".join(f'<th scope="col"{k}>{h}</th>' for k, h in zip(kind, names, strict=True))
    body = "".join(
        "<tr>"
        + "".join(f"<td{k}>{cell}</td>" for k, cell in zip(kind, cells, strict=True))
        + "</tr>\n"
        for cells in rows
    )
    return f'<div class="wide"><table><thead><tr>{top}</tr></thead>\n{body}</table></div>'


def _student(j: Judgement) -> str:
    parts = [f'<p><span class="score">{j.score:.1f}</span> of 100 {_verdict(j.verdict)}</p>']
    parts += [f"<p>{put_right(j)}.</p>"] * (j.score > j.as_is)
    parts += [_error(where, error) for where, error in j.errors]
    if j.faults:
        parts.append("<h3>What is wrong</h3><ul>")
        for f in j.faults:
            text = f"<code>{f.name}</code> ({f.pairs:,} checks): {escape(f.sentence)}"
            parts.append(f"<li>{text}.</li>")
        parts.append("</ul>")
    if j.leaks:
        parts.append(f"<p>{escape(j.leaks)}.</p>")
    if j.printed:
        parts.append(f"<details><summary>It prints {count_of(j.printed, 'byte')}</summary>")
        parts.append(f"<pre>{escape(j.said)}</pre></details>")
    if rows := counts(j):
        names, *cells = rows
        parts.append(_table(names, [tuple(map(escape, row)) for row in cells]))
        parts += [f"<p>{note}.</p>" for note in notes(rows)]
    parts += [_wrong_case(j.subject, case) for case in j.wrong]
    parts += [_scene(j.subject, found) for found in j.looks]
    return "\n".join(parts)


def _error(where: str, error: StudentError) -> str:
    trace = "\n".join(error.lines)
    return (
        f'<div class="error"><strong>The file’s own error, in {escape(where)}</strong> '
        f"({error.kind}): {escape(error.message)}<pre>{escape(trace)}</pre></div>"
    )


def _wrong_case(subject: Subject, case: WrongCase, command: str = "") -> str:
    arrays = [f"{name} = np.array([{value!r}])" for name, value in case.given.items()]
    place = f"[{case.place}]" if case.place else ""
    lines = (
        "import numpy as np",
        *arrays,
        f"# certified{place}: {_listed(case.certified)}",
        f"# answered{place}:  {_listed(case.student)}",
        f"print({subject.form.signature})",
    )
    text = escape("\n".join(lines))
    title = f"A wrong {'case' if case.pixel is None else 'pixel'}: {escape(named(case))}"
    steps = f"<p>Step by step: <code>{escape(command)}</code></p>" if command else ""
    return f"<details><summary>{title}</summary><pre>{text}</pre>{steps}</details>"


def _listed(numbers: Sequence[float | None]) -> str:
    return ", ".join("no hit" if v is None else repr(v) for v in numbers)


def _scene(subject: Subject, found: Look) -> str:
    judged = found.judged
    pictures = (
        ("the student’s", to_display(found.color)),
        ("certified", to_display(judged.color)),
        ("wrong pixels", marked(found)),
    )
    figures = "".join(
        f'<figure><img alt="{escape(judged.name)}: {title}" src="{data_uri(png.encode(picture))}">'
        f"<figcaption>{title}</figcaption></figure>"
        for title, picture in pictures
    )
    legend = " ".join(
        f'<span class="mark" style="--c: rgb{color}">{n:,} {MARKS[m]}</span>'
        for m, color in MARK_COLORS.items()
        if (n := found.counts[m.name.lower()])
    )
    every = f", every {judged.stride}th pixel of a row and column" if judged.stride > 1 else ""
    h, w = judged.shape
    parts = [f"<h3>{escape(judged.name)}</h3>"]
    parts.append(f'<div class="pictures">{figures}</div>')
    parts.append(f"<p>{w} × {h} pixels{every}. {legend or 'All are right.'}</p>")
    parts += [_wrong_case(subject, case, explain(judged, case)) for case in found.examples]
    return "\n".join(parts)


def marked(found: Look) -> Bytes:
    """Return the map of marks over the dimmed certified picture, (h, w, 4) sRGB."""
    grey = to_display(found.judged.color)[..., :3].mean(axis=2, keepdims=True)
    out = np.full((*found.mark.shape, 4), 255, np.uint8)
    out[..., :3] = 255 - _DIM * (255 - grey)
    for mark, color in MARK_COLORS.items():
        out[found.mark == mark, :3] = color
    return out

"""Writes what came of the kit's scenes: a table, a page, a badge, JSON and JUnit's XML."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path
from string import Template

from reference_tracer import __version__
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.report import page as comparison_page
from reference_tracer.report.folders import write_all
from reference_tracer.report.junit import junit
from reference_tracer.report.tables import columns
from reference_tracer.wording import count_of

from .judging import Program, Result

PAGE, BADGE, JUNIT, JSON = NAMES = "index.html", "badge.svg", "junit.xml", "conformance.json"
SCHEMA = "reference_tracer.conformance/1"
_TITLE = "Conformance"
_COLORS = {  # of a badge, by the gravest verdict: dark enough for white words
    Verdict.AGREE: "#00703c",
    Verdict.WARNINGS: "#7a5a00",
}
_BAD = "#a8001c"
_LETTER = 0.64 * 11  # of a badge: the width of a letter, with room; no font is known here
_LEFT = 122.64  # and of its left half
_HEAD = "scene", "verdict", "what is wrong"


def write(folder: Path, program: Program, results: Sequence[Result]) -> None:
    """Write the page of all scenes, the badge, JUnit's XML and the JSON; all or none.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    write_all(
        folder,
        {
            PAGE: _page(program, results),
            BADGE: badge(results),
            JUNIT: junit("reftrace conform", {program.command: [r.judged for r in results]}),
            JSON: _content(program, results),
        },
    )


def verdict(results: Sequence[Result]) -> Verdict:
    """Return the gravest verdict."""
    return Verdict.gravest(r.verdict for r in results)


def summary(results: Sequence[Result]) -> str:
    """Return how many scenes agree, in words."""
    scenes = count_of(len(results), "scene agrees", "scenes agree")
    return f"{agreeing(results)} of {scenes}"


def agreeing(results: Sequence[Result]) -> int:
    """Return how many scenes agree."""
    return sum(r.verdict is Verdict.AGREE for r in results)


def lines(results: Sequence[Result]) -> list[str]:
    """Return the table, and the sum."""
    rows = [(r.kit.name, str(r.verdict), r.judged.failure) for r in results]
    return [*columns([_HEAD, *rows], left=(0, 1, 2)), summary(results)]


def badge(results: Sequence[Result]) -> str:
    """Return an SVG that says how many scenes agree, in the colour of the gravest verdict."""
    count = f"{agreeing(results)} of {len(results)}"
    right = len(count) * _LETTER + 10
    return _filled(
        BADGE,
        summary=summary(results),
        count=count,
        color=_COLORS.get(verdict(results), _BAD),
        right=f"{right:.7g}",
        middle=f"{_LEFT + right / 2:.7g}",
        width=f"{_LEFT + right:.7g}",
    )


def _filled(name: str, **words: str) -> str:
    """Return a template that lies beside this file, with words in place of their names."""
    text = Path(__file__).with_name(name).read_text(encoding="utf-8")
    return Template(text).substitute(words)


def _content(program: Program, results: Sequence[Result]) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "version": __version__,
        "command": program.command,
        "verdict": verdict(results),
        "scenes": [
            {
                "name": r.kit.name,
                "what": r.kit.sentence,
                "verdict": r.verdict,
                "wrong": r.judged.failure,
                "detail": r.judged.detail if r.judged.failure else "",
                "seconds": round(r.judged.seconds, 3),
            }
            for r in results
        ],
    }


def _page(program: Program, results: Sequence[Result]) -> str:
    return _filled(
        "page.html",
        title=escape(f"{_TITLE}: {summary(results)}"),
        badge=badge(results),
        command=f"<code>{escape(program.command)}</code>",
        rows="\n".join(map(_row, results)),
        version=escape(f"Reference Tracer {__version__}"),
    )


def _row(result: Result) -> str:
    name = escape(result.kit.name)
    if result.judged.failure and result.verdict is not Verdict.FAILED:
        name = f'<a href="{name}/{comparison_page.NAME}">{name}</a>'
    kind = result.verdict if result.verdict in _STYLED else Verdict.WARNINGS
    cells = (
        name,
        escape(result.kit.sentence),
        f'<span class="{kind}">{result.verdict}</span>',
        escape(result.judged.failure),
    )
    return f"<tr>{''.join(f'<td>{c}</td>' for c in cells)}</tr>"


_STYLED = Verdict.AGREE, Verdict.DIFFERENCES, Verdict.FAILED

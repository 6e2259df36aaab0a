"""`reftrace extremes`: finds where every method breaks."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from ...report import extremes as report
from ...report import folders
from ...study import extremes as study
from ...tracer.progress import result_of
from ...wording import show
from ..arguments import Place, place_from
from ..parser import AGREE, COUNT, Parser
from ..running import progress_bar


def add(parser: Parser) -> None:
    """Add the command's options."""

    def run(given: Namespace) -> int:
        return extremes(given.out, given.rays, place_from(given))

    parser.runs(run, "reftrace extremes --out out/")
    parser.add_argument(
        "--out", required=True, type=parser.path, metavar="DIR", help="folder for what is found"
    )
    parser.add_argument(
        "--rays", type=COUNT, metavar="N", help="trace about this many rays through each scene"
    )


def extremes(out: Path, rays: int | None, place: Place) -> int:
    """Measure, and print the breaking points; `rays` are those through each scene, about."""
    with folders.made(out):
        with place as chosen, progress_bar() as progress:
            rows = result_of(study.measure(rays=rays, **chosen), progress)
        show(*report.breaking_table(rows).split("\n"))
        report.write(out, rows)
        show(f"written to {out}")
    return AGREE

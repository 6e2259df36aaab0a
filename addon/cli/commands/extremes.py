"""`reftrace extremes`: finds where every method breaks."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path

from ...report import extremes as report
from ...report import folders
from ...study import extremes as study
from ...tracer.progress import result_of
from ...wording import show
from ..arguments import Place, place_from
from ..parser import AGREE, COUNT, Parser
from ..running import progress_bar


@dataclass(frozen=True)
class ExtremesOptions:
    """The options of `reftrace extremes`."""

    out: Path
    rays: int | None  # through each scene, about
    place: Place


def add(parser: Parser) -> None:
    """Add the command's options."""

    def run(given: Namespace) -> int:
        return extremes(ExtremesOptions(given.out, given.rays, place_from(given)))

    parser.runs(run, "reftrace extremes --out out/")
    parser.add_argument(
        "--out", required=True, type=parser.path, metavar="DIR", help="folder for what is found"
    )
    parser.add_argument(
        "--rays", type=COUNT, metavar="N", help="trace about this many rays through each scene"
    )


def extremes(options: ExtremesOptions) -> int:
    """Measure, and print the breaking points."""
    with folders.made(options.out):
        with options.place as place, progress_bar() as progress:
            rows = result_of(study.measure(rays=options.rays, **place), progress)
        show(*report.breaking_table(rows).split("\n"))
        report.write(options.out, rows)
        show(f"written to {options.out}")
    return AGREE

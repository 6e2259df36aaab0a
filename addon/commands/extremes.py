"""`reftrace extremes`: where every method breaks."""

from __future__ import annotations

import argparse
from pathlib import Path

from ..report import folders
from ..report.progress_bar import progress_bar
from ..tracer.progress import result_of
from .parts import Commands, command, write_study


def add(commands: Commands) -> None:
    """Add the command."""
    parser = command(
        commands,
        "extremes",
        run,
        "find where every method breaks: far away, tiny, edge-on, and so on",
        "reftrace extremes --out out/",
    )
    parser.add_argument("--out", required=True, metavar="DIR", help="folder for what is found")
    parser.add_argument("--rays", type=int, metavar="N", help="about so many through each scene")


def run(options: argparse.Namespace) -> int:
    """Measure, and print the breaking points."""
    from ..report import extremes as report
    from ..study import extremes

    with folders.made(Path(options.out)):
        with progress_bar() as progress:
            rows = result_of(extremes.measure(rays=options.rays), progress)
        print(report.breaking_table(rows))
        write_study(options.out, lambda: report.write(options.out, rows))
    return 0

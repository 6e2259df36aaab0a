"""`reftrace bench`: the tracer's speed beside its peers'."""

from __future__ import annotations

import argparse
from pathlib import Path

from reference_tracer.arguments import INTERRUPTED, add_bench
from reference_tracer.commands.parts import Commands, command, write_study
from reference_tracer.report import folders
from reference_tracer.report.progress_bar import progress_bar


def add(commands: Commands) -> None:
    """Add the command."""
    add_bench(
        command(
            commands,
            "bench",
            run,
            "measure the speed of the tracer beside embreex, Cycles and others",
            "reftrace bench --quick --out out/bench",
        )
    )


def run(options: argparse.Namespace) -> int:
    """Measure, and print the table."""
    from . import report
    from .run import run as measured

    with folders.made(Path(options.out)):
        with progress_bar() as progress:
            bench, baseline = measured(options, progress)
        print(report.table(bench, baseline))
        write_study(options.out, lambda: report.write(options.out, bench, baseline))
    return INTERRUPTED if bench.interrupted else 0

"""`reftrace bench`: the tracer's speed beside its peers'."""

from __future__ import annotations

import argparse
from pathlib import Path

from reference_tracer.cli.commands.parts import command
from reference_tracer.cli.parser import Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders


def add(parser: Parser) -> None:
    """Add the command's options."""
    command(
        parser,
        run,
        "reftrace bench --quick --out out/bench",
    )
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="by default all")
    parser.add_argument("--quick", action="store_true", help="fewer and smaller: under 2 minutes")
    parser.add_argument(
        "--out", default="out/bench", metavar="DIR", help="folder for what is found (%(default)s)"
    )
    parser.add_argument(
        "--baseline", metavar="FILE", help="bench.json of an earlier run: say what has changed"
    )
    parser.add_argument("--repeats", type=int, metavar="N", help="rounds (default 5; quick 3)")


def run(options: argparse.Namespace) -> int:
    """Measure, and print the table."""
    from . import report
    from .run import run as measured

    with folders.made(Path(options.out)):
        with progress_bar() as progress:
            bench, baseline = measured(options, progress)
        print(report.table(bench, baseline))
        report.write(options.out, bench, baseline)
        print(f"written to {options.out}")
    return bench.interrupted

"""`reftrace bench`: the tracer's speed beside its peers'."""

from __future__ import annotations

import shutil
from argparse import Namespace
from pathlib import Path

from reference_tracer.cli.parser import INTEGER, Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders
from reference_tracer.wording import show

from .options import BenchOptions


def add(parser: Parser) -> None:
    """Add the command's options."""

    def run(given: Namespace) -> int:
        scenes = tuple(given.scenes)
        return bench(BenchOptions(given.out, scenes, given.quick, given.repeats))

    parser.runs(run, "reftrace bench --quick --out out/bench")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="default: all of them")
    parser.add_argument("--quick", action="store_true", help="fewer and smaller: under 2 minutes")
    parser.add_argument(
        "--out",
        type=parser.path,
        default=Path("out/bench"),
        metavar="DIR",
        help="folder for what is found (default %(default)s)",
    )
    parser.add_argument(
        "--repeats", type=INTEGER, metavar="N", help="rounds (default 5, or 3 with --quick)"
    )


def bench(options: BenchOptions) -> int:
    """Measure, and print the table."""
    from . import report
    from .run import run
    from .tables import table

    with folders.made(options.out):
        with progress_bar() as progress:
            measured = run(options, progress)
        out = options.out / report.UNFINISHED if measured.interrupted else options.out
        if measured.rows or not measured.interrupted:
            report.write(out, measured)
        show(*table(measured).split("\n"), *([f"written to {out}"] if out.exists() else []))
        if not measured.interrupted:
            shutil.rmtree(options.out / report.UNFINISHED, ignore_errors=True)
    return measured.interrupted

"""`reftrace bench`: the tracer's speed beside its peers'."""

from __future__ import annotations

import shutil
from argparse import Namespace
from pathlib import Path

from reference_tracer.cli.parser import INTEGER, Parser
from reference_tracer.cli.running import progress_bar
from reference_tracer.report import folders
from reference_tracer.wording import show


def add(parser: Parser) -> None:
    """Add the command's options."""
    parser.runs(bench, "reftrace bench --quick --out out/bench")
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


def bench(given: Namespace) -> int:
    """Measure, and print the tables."""
    from .plan import plan
    from .results import UNFINISHED, write
    from .run import run
    from .tables import table

    wanted = plan(given.scenes, given.quick, given.repeats)
    with folders.made(given.out):
        with progress_bar() as progress:
            measured = run(wanted, given.out, progress)
        out = given.out / UNFINISHED if measured.interrupted else given.out
        if measured.found or not measured.interrupted:
            write(out, measured)
        show(*table(measured).split("\n"), *([f"written to {out}"] if out.exists() else []))
        if not measured.interrupted:
            shutil.rmtree(given.out / UNFINISHED, ignore_errors=True)
    return measured.interrupted

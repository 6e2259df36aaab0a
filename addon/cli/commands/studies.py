"""`reftrace trade` and `reftrace extremes`: what tracing costs, and where every method breaks."""

from __future__ import annotations

import argparse
from contextlib import nullcontext
from pathlib import Path

from ...report import folders
from ...tracer.progress import result_of
from ...tracer.settings import Settings
from ..arguments import settings_from
from ..camera_options import add_camera, choice_from
from ..opening import SOURCES, load
from ..parser import Parser, add_options
from ..running import progress_bar
from .parts import command


def add_trade(parser: Parser) -> None:
    """Add the command's options."""
    command(parser, trade, "reftrace trade sample_scenes/suzanne.blend --out out/", SOURCES)
    add_options(parser, "trade")
    add_camera(parser, width=160, height=90, of_scenes=True)


def trade(options: argparse.Namespace) -> None:
    """Measure, and print the table."""
    from ...report import trade as report
    from ...study import tradeoff

    with folders.made(Path(options.out)) if options.out else nullcontext():
        scene, _ = load(options.scene, choice_from(options, options.scene))
        samples = settings_from(options, Settings(samples=tradeoff.SAMPLES)).samples
        with options.place(options) as place, progress_bar() as progress:
            work = tradeoff.measure(scene, options.width, samples, options.scene.name, **place)
            found = result_of(work, progress)
        print(report.table(found))
        if options.out:
            report.write(options.out, found)
            print(f"written to {options.out}")


def add_extremes(parser: Parser) -> None:
    """Add the command's options."""
    command(parser, extremes, "reftrace extremes --out out/")
    add_options(parser, "extremes")


def extremes(options: argparse.Namespace) -> None:
    """Measure, and print the breaking points."""
    from ...report import extremes as report
    from ...study.extremes import measure

    with folders.made(Path(options.out)):
        with options.place(options) as place, progress_bar() as progress:
            rows = result_of(measure(rays=options.rays, **place), progress)
        print(report.breaking_table(rows))
        report.write(options.out, rows)
        print(f"written to {options.out}")

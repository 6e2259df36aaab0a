"""Runs a benchmark, of which each result is written once it is there."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from reference_tracer.report import folders
from reference_tracer.tracer import signals
from reference_tracer.tracer.progress import Event, Work, result_of, scaled
from reference_tracer.wording import show

from .commands import measure_commands
from .measure import measure
from .plan import Plan
from .results import TIMES, UNFINISHED, Bench

SCENES = 0.8  # their share of the time, about


def run(wanted: Plan, out: Path, progress: Callable[[Event], None]) -> Bench:
    """Measure; Ctrl-C ends it, and what was measured until then is what there is.

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    bench = Bench()
    written = 0

    def keep(event: Event) -> None:
        nonlocal written
        progress(event)
        if len(bench.found) > written:  # so that even a crash leaves what was measured
            folders.make(out / UNFINISHED)
            bench.dump(out / UNFINISHED / TIMES)
            written = len(bench.found)

    try:
        with closing(_all(wanted, bench, out)) as work:
            result_of(work, keep)
    except KeyboardInterrupt:
        bench.interrupted, word = signals.ended()
        signals.answered()
        show(f"reftrace: {word}: {len(bench.found)} times were measured", file=sys.stderr)
    return bench


def _all(wanted: Plan, bench: Bench, directory: Path) -> Work[None]:
    share = SCENES if wanted.commands else 1.0
    yield from scaled(measure(wanted, bench, directory), 0.0, share)
    yield from scaled(measure_commands(wanted, bench, directory), share, 1 - share)

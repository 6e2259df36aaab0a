"""The options of `reftrace bench` -> a `Bench`, of which each row is written once it is there."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

from reference_tracer.report import folders
from reference_tracer.tracer import signals
from reference_tracer.tracer.progress import Event, Work, result_of, scaled
from reference_tracer.wording import show

from .commands import measure_commands
from .measure import METHODS, measure
from .options import BenchOptions
from .plan import Plan, plan
from .report import UNFINISHED, write_json
from .rows import Bench, machine
from .spread import measure_spread

SCENES = 0.8  # their share of the time, about


def run(options: BenchOptions, progress: Callable[[Event], None]) -> Bench:
    """Measure; Ctrl-C ends it, and what was measured until then is what there is.

    Raises
    ------
    SceneError
        If the options name a scene that is not there.
    OSError
        If the folder cannot be written.
    """
    wanted = plan(list(options.scenes), options.quick, options.repeats)
    unfinished = options.out / UNFINISHED
    bench = Bench(machine(hasattr(os, "sched_setaffinity")), wanted.quick)
    written = 0

    def keep(event: Event) -> None:
        nonlocal written
        progress(event)
        if len(bench.rows) > written:  # so that even a crash leaves what was measured
            folders.make(unfinished)
            write_json(unfinished, bench)
            written = len(bench.rows)

    try:
        with closing(_all(wanted, bench, options.out)) as work:
            result_of(work, keep)
    except KeyboardInterrupt:
        bench.interrupted, word = signals.ended()
        signals.answered()
        done = f"{len(bench.rows) // len(METHODS)} of {len(wanted.cases)} pictures"
        show(f"reftrace: {word}: {done} were measured", file=sys.stderr)
    return bench


def _all(wanted: Plan, bench: Bench, directory: Path) -> Work[None]:
    share = SCENES if wanted.commands else 1.0
    yield from scaled(measure(wanted, bench, directory), 0.0, share)
    yield from scaled(measure_commands(wanted, bench, directory), share, (1 - share) / 2)
    yield from scaled(measure_spread(wanted, bench, directory), (1 + share) / 2, (1 - share) / 2)

"""A `Bench` as text: pyperf's own tables of ours beside each peer, and of commands."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from pyperf import Benchmark, BenchmarkSuite, Run

from .commands import COMMAND, RULER
from .results import Bench

# Who is the measure, and who is held against it.
PAIRS = (
    ("moller_trumbore, trace", "certified, trace"),
    ("embreex_trace", "certified, trace"),
    ("embreex_ids", "certified, picture"),
    ("embreex_trace", "certified, outputs"),
    ("rtree", "certified, trace"),
    ("bvhtree", "certified, trace"),
    ("moller_trumbore, render", "certified, render"),
    ("cycles", "certified, render"),
    ("workbench", "certified, render"),
    (RULER, COMMAND),
)


def table(bench: Bench) -> str:
    """Return all of it as lines."""
    parts = [*_beside(bench)] or ["nothing was measured"]
    if bench.interrupted:
        parts.append("Interrupted: this is what was done.")
    return "\n\n".join([*parts, *(["\n".join(bench.notes)] if bench.notes else [])])


def _beside(bench: Bench) -> Iterator[str]:
    """Yield pyperf's table of each pair, of what both of it have done."""
    with TemporaryDirectory() as folder:
        for pair in PAIRS:
            shared = [
                what
                for what, who in bench.found
                if who == pair[0] and (what, pair[1]) in bench.found
            ]
            files = [Path(folder, f"{who.replace(', ', '_')}.json") for who in pair]
            if shared:
                for who, file in zip(pair, files, strict=True):
                    named = [_named(bench, what, who) for what in shared]
                    BenchmarkSuite(named).dump(str(file), replace=True)
                words = [sys.executable, "-m", "pyperf", "compare_to", "--table", *map(str, files)]
                said = subprocess.run(words, capture_output=True, text=True, check=True).stdout
                yield said.rstrip()


def _named(bench: Bench, what: str, who: str) -> Benchmark:
    """Return what somebody has done, under its name alone: pyperf compares what is named alike."""
    own = bench.found[what, who]
    return Benchmark([Run(own.get_values(), metadata={"name": what}, collect_metadata=False)])

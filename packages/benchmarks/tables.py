"""A `Bench` as text: pyperf's own tables of ours beside each peer, and what commands take."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from reference_tracer.report.tables import columns

from .peers import MissingPeerError
from .report import suite
from .rows import Bench

# A peer, and what of ours is held against it.
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
)


def table(bench: Bench) -> str:
    """Return all of it as lines."""
    if not bench.rows and not bench.commands:
        return "\n".join(["nothing was measured", *_notes(bench)])
    parts = [*_beside(bench), list(_commands(bench)), list(_notes(bench))]
    return "\n\n".join("\n".join(part) for part in parts if part)


def _beside(bench: Bench) -> Iterator[list[str]]:
    """Yield pyperf's table of each pair; nothing where pyperf is not installed."""
    by: dict[str, dict[str, list[float]]] = {}
    for name, seconds in bench.times.items():
        case, _, who = name.partition(": ")
        by.setdefault(who, {})[case] = seconds
    with TemporaryDirectory() as folder:
        for pair in PAIRS:
            shared = [case for case in by.get(pair[0], {}) if case in by.get(pair[1], {})]
            files = [Path(folder, f"{who.replace(', ', '_')}.json") for who in pair]
            try:
                for who, file in zip(pair, files, strict=True):
                    if kept := suite({case: (by[who][case], "second") for case in shared}):
                        kept.dump(str(file), replace=True)
            except MissingPeerError:
                return
            if shared:
                words = [sys.executable, "-m", "pyperf", "compare_to", "--table", *map(str, files)]
                said = subprocess.run(words, capture_output=True, text=True, check=True).stdout
                yield said.rstrip().splitlines()


def _commands(bench: Bench) -> Iterator[str]:
    if not bench.commands:
        return
    rows = [("", "CPU s", "x import bpy (least - most)", "waited")]
    for c in bench.commands:
        times = f"{c.ratio:.2f} ({c.ratio_least:.2f} - {c.ratio_most:.2f})"
        waited = "-" if c.waited_s is None else f"{c.waited_s:.2f} s"
        rows.append((c.name, f"{c.cpu_s:.2f}", times, waited))
    yield "commands, in processes of their own; x import bpy: in the same round"
    yield from columns(rows)


def _notes(bench: Bench) -> Iterator[str]:
    yield from bench.notes
    if bench.machine.get("one_core"):
        yield "Everything ran on one core. embreex, in float32, traces alone: without its tree."
    if bench.interrupted:
        yield "Interrupted: these are the rows that were done."

"""The results of a benchmark, as pyperf keeps, compares and plots them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.report import folders

from .rounds import Facts, Runners

try:
    from pyperf import Benchmark, BenchmarkSuite, Run
except ImportError as error:
    raise MissingLibraryError(
        f'reftrace bench needs pyperf: pip install "reference_tracer[bench]" ({error})'
    ) from error

TIMES, TABLE = "times.json", "bench.txt"
UNFINISHED = "unfinished"  # the folder in the results' of a run until it ends
LIBRARIES = "numpy", "embreex", "trimesh", "rtree", "bpy"


@dataclass
class Bench:
    """What was measured so far."""

    # By what was done (a picture or a command), and by whom.
    found: dict[tuple[str, str], Benchmark] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)  # what was left out, and why
    interrupted: int = 0  # by a signal: the exit code for it

    def keep(
        self,
        what: str,
        who: str,
        values: Iterable[float],
        facts: Facts | None = None,
    ) -> None:
        """Keep values, one a round, and what else is known of them; a clock may see no time."""
        if seen := [value for value in values if value > 0]:
            metadata = {"name": f"{what}: {who}", **machine(), **(facts or {})}
            self.found[what, who] = Benchmark(
                [Run(seen, metadata=metadata, collect_metadata=False)]
            )

    def keep_rounds(self, what: str, runners: Runners) -> None:
        """Keep what runners have taken, by their names; say who could not run."""
        for who, runner in runners.items():
            if runner.failed:
                self.note(f"{what}: {who}: {runner.failed}")
            self.keep(what, who, runner.seconds, facts=runner.facts)

    def note(self, text: str) -> None:
        """Say something, once."""
        if text not in self.notes:
            self.notes.append(text)

    def dump(self, path: Path) -> None:
        """Write a file for pyperf; whoever reads it meanwhile, or stops us, finds a whole one."""
        if self.found:
            with folders.replacing_file(path) as new:
                BenchmarkSuite(list(self.found.values())).dump(str(new), replace=True)


@cache
def machine() -> Facts:
    """Return the facts of this machine that times depend on, as pyperf finds them."""
    facts: Facts = Run([1.0]).get_metadata()
    return facts | {f"version_{name}": _version(name) for name in LIBRARIES}


def _version(library: str) -> str:
    try:
        return version(library)
    except PackageNotFoundError:
        return "not installed"


def write(directory: Path, bench: Bench) -> None:
    """Write the table, and what pyperf reads.

    Parameters
    ----------
    directory : Path
        Made where it is not there.
    bench : Bench

    Raises
    ------
    OSError
        If the folder cannot be written.
    """
    from .tables import table

    with folders.replacing(directory, (TIMES, TABLE)) as new:
        bench.dump(new / TIMES)
        (new / TABLE).write_text(table(bench) + "\n", encoding="utf-8")

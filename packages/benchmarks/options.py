"""The options of a benchmark."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class BenchOptions:
    """The options of `reftrace bench`."""

    out: Path
    scenes: tuple[str, ...] = ()  # all of them, if none is named
    quick: bool = False
    repeats: int | None = None  # rounds

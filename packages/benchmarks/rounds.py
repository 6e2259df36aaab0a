"""Timing in rounds: each round runs everyone once, in turn, so that a slow moment is shared."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from statistics import median

from reference_tracer.tracer.progress import Progress, Work

from .peers import MissingPeerError


@dataclass
class Runner:
    """Someone who is timed.

    Parameters
    ----------
    run : callable
        Does the work once; returns the seconds that it takes, for a whole picture.
    allowed : float, optional
        Seconds that it may spend in all, after which it sits out; without, it is in every round.
    """

    run: Callable[[], float]
    allowed: float | None = None
    seconds: dict[int, float] = field(default_factory=dict)  # by round, for a whole picture
    spent: list[float] = field(default_factory=list)  # seconds that really went by
    failed: str = ""  # why it cannot run

    @property
    def median(self) -> float | None:
        """Seconds, None where it was never run."""
        return median(self.seconds.values()) if self.seconds else None

    def takes_part(self) -> bool:
        """Whether it can run, and may once more."""
        next_time = sum(self.spent) + max(self.spent, default=0.0)
        return not self.failed and (self.allowed is None or next_time <= self.allowed)


@dataclass(frozen=True)
class Ratio:
    """One time against another: the median of the rounds that have both, the least, the most."""

    median: float
    least: float
    most: float


def ratio(runner: Runner, other: Runner) -> Ratio | None:
    """Return a runner's time against another's, None where no round has both."""
    common = runner.seconds.keys() & other.seconds.keys()
    found = [runner.seconds[k] / other.seconds[k] for k in common if other.seconds[k] > 0]
    return Ratio(median(found), min(found), max(found)) if found else None


def in_rounds(runners: list[Runner], repeats: int, budget: float) -> Work[int]:
    """Run everyone `repeats` times, or as often as `budget` seconds allow; returns the rounds.

    The first round warms up, and is forgotten; where there is no time for another, or a runner
    may not take part in another, it is what counts.
    """
    yield from _round(runners, 0, 0.0, 1 / (repeats + 1))
    each = sum(sum(r.spent) for r in runners if r.allowed is None)
    count = min(repeats, int(budget / each)) if each else repeats
    for number in range(1, count + 1):
        # Every other round goes backwards, so that none has always the same one before it.
        ordered = runners if number % 2 else runners[::-1]
        yield from _round(ordered, number, number / (count + 1), 1 / (count + 1))
    for r in runners:
        if len(r.seconds) > 1:
            r.seconds.pop(0, None)
    yield Progress(1.0)
    return max(count, 1)


def _round(runners: list[Runner], number: int, start: float, size: float) -> Work[None]:
    for done, r in enumerate(runners, start=1):
        if r.takes_part():
            began = time.perf_counter()
            try:
                r.seconds[number] = r.run()
            except MissingPeerError as error:
                r.failed = str(error)
            r.spent.append(time.perf_counter() - began)
        yield Progress(start + size * done / len(runners))

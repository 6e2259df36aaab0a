"""Timing in rounds: each round runs everyone once, in turn, so that a slow moment is shared."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

from reference_tracer.tracer.progress import Progress, Work

from .peers import MissingPeerError

Facts = dict[str, str | float]  # what is known of a time, besides


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
    seconds: list[float] = field(default_factory=list)  # of each round, for a whole picture
    spent: list[float] = field(default_factory=list)  # seconds that really went by
    facts: Facts = field(default_factory=dict)  # what else is known of it
    failed: str = ""  # why it cannot run

    def takes_part(self) -> bool:
        """Whether it can run, and may once more."""
        next_time = sum(self.spent) + max(self.spent, default=0.0)
        return not self.failed and (self.allowed is None or next_time <= self.allowed)


Runners = dict[str, Runner]  # by who is timed


def in_rounds(runners: list[Runner], repeats: int, budget: float) -> Work[None]:
    """Run everyone `repeats` times, or as often as `budget` seconds allow.

    The first round warms up, and is forgotten; where there is no time for another, or a runner
    may not take part in another, it is what counts.
    """
    yield from _round(runners, 0.0, 1 / (repeats + 1))
    each = sum(sum(r.spent) for r in runners if r.allowed is None)
    count = min(repeats, int(budget / each)) if each else repeats
    for number in range(1, count + 1):
        # Every other round goes backwards, so that none has always the same one before it.
        ordered = runners if number % 2 else runners[::-1]
        yield from _round(ordered, number / (count + 1), 1 / (count + 1))
    for r in runners:
        r.seconds = r.seconds[1:] or r.seconds
    yield Progress(1.0)


def _round(runners: list[Runner], start: float, size: float) -> Work[None]:
    for done, r in enumerate(runners, start=1):
        if r.takes_part():
            began = time.perf_counter()
            try:
                r.seconds.append(r.run())
            except MissingPeerError as error:
                r.failed = str(error)
            r.spent.append(time.perf_counter() - began)
        yield Progress(start + size * done / len(runners))

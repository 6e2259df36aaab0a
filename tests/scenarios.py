"""The scenarios, a few of them: what takes seconds instead of minutes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from reference_tracer.study.scenarios.sweeps import ALL, Scenario


def quick(scenarios: Sequence[Scenario] = ALL) -> tuple[Scenario, ...]:
    """Return the scenarios with their first, middle and last scale only, in small pictures.

    Of a map's rows, too, the first, the middle and the last.
    """
    rows = {name: [s for s in scenarios if s.name == name] for name in {s.name for s in scenarios}}
    return tuple(
        replace(s, scales=_ends_and_middle(s.scales), width=8, height=6)
        for s in scenarios
        if s in _ends_and_middle(rows[s.name])
    )


def _ends_and_middle(some: Sequence) -> tuple:
    return tuple(some[k] for k in sorted({0, len(some) // 2, len(some) - 1}))

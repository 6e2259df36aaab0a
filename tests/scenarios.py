"""The scenarios, a few of them: what takes seconds instead of minutes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from reference_tracer.study.scenarios.sweeps import SCENARIOS, Scenario


def quick(scenarios: Sequence[Scenario] = SCENARIOS) -> tuple[Scenario, ...]:
    """Return the scenarios with their first, middle and last scale only, in small pictures."""
    return tuple(
        replace(s, scales=_ends_and_middle(s.scales), width=8, height=6) for s in scenarios
    )


def _ends_and_middle(some: Sequence) -> tuple:
    return tuple(some[k] for k in sorted({0, len(some) // 2, len(some) - 1}))

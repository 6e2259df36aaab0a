"""Cases by the hundred: a sample of them every day, all of them in `make torture`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def sampled(every: int) -> pytest.MarkDecorator:
    """Give a test `every`: it takes one of so many of its cases, or in the long run all."""
    return pytest.mark.parametrize("every", [every, pytest.param(1, marks=pytest.mark.torture)])


def daily(cases: Iterable[Any], every: int = 2) -> list[Any]:
    """Return the cases of a parameter: one of so many is run every day, the others in the long run.

    A case of several parameters is a tuple.
    """
    return [
        pytest.param(
            *(case if isinstance(case, tuple) else (case,)),
            marks=[pytest.mark.torture] if number % every else [],
        )
        for number, case in enumerate(cases)
    ]

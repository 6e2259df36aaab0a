"""Cases by the hundred: a sample of them every day, all of them in `make torture`."""

from __future__ import annotations

import pytest


def sampled(every: int) -> pytest.MarkDecorator:
    """Give a test `every`: it takes one of so many of its cases, or in the long run all."""
    return pytest.mark.parametrize("every", [every, pytest.param(1, marks=pytest.mark.torture)])

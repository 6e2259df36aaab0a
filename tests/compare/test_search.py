"""The search among a fault's numbers: what is told lies in the interval that is told with it."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.compare.faults.search import Search
from reference_tracer.tracer.progress import result_of


@pytest.mark.parametrize("seed", range(80, 90))
def test_what_is_told_lies_between_its_ends(seed):
    """Of plateaus that lie anywhere: one is told, and both ends are as good, less the margin."""
    rng = np.random.default_rng(seed)
    count = rng.integers(5, 40)
    middle = np.sort(rng.uniform(-3, 3, count))
    half, height = rng.uniform(0.002, 0.05, count), rng.integers(1, 100, count)

    def right(values):
        return int(np.max(height[np.abs(values[0] - middle) < half], initial=0))
        yield

    search = Search(right, (1.0,))
    guess = result_of(search.guess([(0.0,)]))
    assert guess.low <= guess.values <= guess.high
    most = result_of(search.right(guess.values))
    assert most > 0
    ends = guess.low[0] + search.finest, guess.high[0] - search.finest
    assert all(result_of(search.right((end,))) >= most for end in ends)

"""The search among a fault's numbers: what is told lies in the interval that is told with it."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.diagnosis.faults.search import Search
from reference_tracer.tracer.progress import result_of

SEED = 27


@pytest.mark.parametrize("seed", range(80, 90))
def test_what_is_told_lies_between_its_ends(seed):
    """Of plateaus that lie anywhere: one is told, and both ends are as good, less the margin."""
    rng = np.random.default_rng(seed)
    count = rng.integers(5, 40)
    middle = np.sort(rng.uniform(-3, 3, count))
    half, height = rng.uniform(0.002, 0.05, count), rng.integers(1, 100, count)

    def right(values):
        return np.arange(100) < np.max(height[np.abs(values[0] - middle) < half], initial=0)
        yield

    search = Search(right, (1.0,))
    guess = result_of(search.guess([(0.0,)]))
    assert guess.low <= guess.values <= guess.high
    most = result_of(search.count(guess.values))
    assert most > 0
    ends = guess.low[0] + search.finest, guess.high[0] - search.finest
    assert all(result_of(search.count((end,))) >= most for end in ends)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_pixels_that_do_not_change_are_not_looked_at_again(count):
    """Each pixel is right on one side of an edge: with fewer looked at, as much is told."""
    rng = np.random.default_rng(SEED + count)
    edges = rng.normal(size=(4000, count))
    away = rng.uniform(-2, 2, 4000)  # units from the right numbers to each edge
    right_numbers = rng.uniform(-0.2, 0.2, count)
    looked_at = []

    def right(values, some=slice(None)):
        beside = edges[some] @ (np.array(values) - right_numbers)
        looked_at.append(len(beside))
        return (beside > away[some]) == (away[some] < 0)
        yield

    told = []
    for among in (None, lambda some: lambda values: right(values, some)):
        looked_at.clear()
        search = Search(right, np.ones(count), among=among)
        guess = result_of(search.guess([(0.0,) * count], 1 / 8))
        told.append((guess.low, guess.values, guess.high, sum(looked_at)))
    assert told[0][:3] == told[1][:3]
    assert told[1][3] < told[0][3] / 3
    assert np.abs(told[0][1] - right_numbers).max() < 0.01


def test_pixels_are_the_same_only_between_the_places_along_the_axes():
    """What nothing is seen of is no way in which they are: a step there is looked at anew."""
    edges = np.random.default_rng(SEED).uniform(-1, 1, 2000)

    def right(values, some=slice(None)):
        found = (values[0] > edges[some]) == (0.1 > edges[some])
        return found & ((abs(values[1]) < 3) | (abs(edges[some] - 0.1) < 0.2))
        yield

    for among in (None, lambda some: lambda values: right(values, some)):
        search = Search(right, [[0.5], [0.0]], unseen=np.array([[0.0], [0.5]]), among=among)
        guess = result_of(search.guess([(0.0, 0.0)], 1 / 8))
        assert abs(guess.values[0] - 0.1) < 0.01
        assert 2.75 < guess.high[1] < 4 and -4 < guess.low[1] < -2.75


@pytest.mark.parametrize("seed", [242, 266, 290])
def test_a_bound_is_not_taken_for_a_count(seed):
    """Where fewer pixels are wanted than the best place has, all of them are looked at."""
    rng = np.random.default_rng(seed)
    edges = rng.normal(size=(600, 3))
    edges /= np.linalg.norm(edges, axis=1, keepdims=True)
    away = rng.uniform(-2, 2, 600)
    truth = rng.uniform(-0.6, 0.6, 3)

    def right(values, some=slice(None)):
        beside = edges[some] @ (np.array(values) - truth)
        return (beside > away[some]) == (away[some] < 0)
        yield

    guesses = []
    for among in (None, lambda some: lambda values: right(values, some)):
        search = Search(right, np.ones(3), among=among)
        guesses.append(result_of(search.guess([(0.0,) * 3], 1 / 8)))
    widths = [np.subtract(guess.high, guess.low).max() for guess in guesses]
    assert widths[1] < 1.5 * widths[0]
    assert result_of(right(guesses[1].values)).sum() >= result_of(right(guesses[0].values)).sum()


def test_a_plateau_has_an_end():
    """All numbers are as good: none is told that is farther away than is looked at."""

    def right(values):
        return np.ones(4, bool)
        yield

    guess = result_of(Search(right, np.ones(3)).guess([(0.0, 0.0, 0.0)]))
    assert np.abs((guess.low, guess.high)).max() < 1e5

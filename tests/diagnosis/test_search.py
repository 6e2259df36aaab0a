"""The search among a fault's numbers: what is told lies in the interval that is told with it."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.diagnosis.faults.matching import Matches, fitted
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

    search = Search(right, np.eye(1))
    guess = result_of(search.guess([(0.0,)]))
    assert guess.low <= guess.values <= guess.high
    most = result_of(search.count(guess.values))
    assert most > 0
    ends = guess.low[0] + search.finest, guess.high[0] - search.finest
    assert all(result_of(search.count((end,))) >= most for end in ends)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_the_place_with_the_most_right_pixels_is_found(count):
    """Each pixel is right on one side of an edge: next to all are, near the right numbers."""
    rng = np.random.default_rng(SEED + count)
    edges = rng.normal(size=(4000, count))
    away = rng.uniform(-2, 2, 4000)  # units from the right numbers to each edge
    right_numbers = rng.uniform(-0.2, 0.2, count)

    def right(values):
        beside = edges @ (np.array(values) - right_numbers)
        return (beside > away) == (away < 0)
        yield

    guess = result_of(Search(right, np.eye(count)).guess([(0.0,) * count], 1 / 8))
    assert np.abs(np.subtract(guess.values, right_numbers)).max() < 0.01
    if count == 1:
        assert guess.low <= tuple(right_numbers) <= guess.high


def test_what_is_not_seen_is_left_open():
    """Nothing changes along an axis, up to an end: that is not searched, but told."""
    edges = np.random.default_rng(SEED).uniform(-1, 1, 2000)

    def right(values):
        found = (values[0] > edges) == (0.1 > edges)
        return found & ((abs(values[1]) < 3) | (abs(edges - 0.1) < 0.2))
        yield

    search = Search(right, np.array([[0.5], [0.0]]), unseen=np.array([[0.0], [0.5]]))
    guess = result_of(search.guess([(0.0, 0.0)], 1 / 8))
    assert abs(guess.values[0] - 0.1) < 0.01
    assert 2.75 < guess.high[1] < 4 and -4 < guess.low[1] < -2.75


def test_of_what_is_not_seen_no_far_place_is_told():
    """It is open to one side: the middle between its ends is as good, and says nothing."""

    def right(values):
        x, y = values
        return np.full(100, abs(x - y - 0.3) < 0.02 and x + y > 0.1)
        yield

    search = Search(right, np.array([[0.5], [-0.5]]), unseen=np.array([[0.5], [0.5]]))
    guess = result_of(search.guess([(0.25, -0.05)], 1 / 8))
    assert np.abs(guess.values).max() < 1 and guess.high[0] > 10
    assert guess.low <= guess.values <= guess.high


def test_a_plateau_has_an_end():
    """All numbers are as good: none is told that is farther away than is looked at."""

    def right(values):
        return np.ones(4, bool)
        yield

    guess = result_of(Search(right, np.eye(3)).guess([(0.0, 0.0, 0.0)]))
    assert np.abs((guess.low, guess.high)).max() < 1e5


def test_of_edges_behind_the_camera_nothing_is_fitted():
    places = Matches(np.ones((3, 20)), np.ones((2, 20)), np.tile(np.eye(2), (20, 1, 1)))
    assert fitted(places, lambda units: np.full((2, 20), np.nan), 1) is None
    assert fitted(places, lambda units: np.ones((2, 20)) + units, 1).share == 1

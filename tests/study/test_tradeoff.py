"""What is measured of the trade: every row whole, judged by the certified picture."""

from __future__ import annotations

import time
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.methods import Method
from reference_tracer.rendering import frame_of
from reference_tracer.study import tradeoff
from reference_tracer.study.converged import converged, coverage_error, samples_of
from reference_tracer.study.tradeoff import measure
from reference_tracer.study.truth import largest_t_error
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Precision, Settings

pytestmark = pytest.mark.slow

LADDER = {(m.value, p.value) for m in Method if not m.is_proven for p in Precision}
LADDER |= {("certified", "float64")}


@pytest.fixture(scope="module", autouse=True)
def few_rounds():
    """Time each row seldom: that takes most of the time."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tradeoff, "SHORT", 0.0)
        yield


@pytest.fixture(scope="module")
def ball(make):
    camera = make.camera(80, 60, eye=(1.1, -1.3, 0.9), target=(0.02, 0.01, 0.03))
    return make.scene(camera, make.mesh(trimesh.creation.icosphere(2)))


@pytest.fixture(scope="module")
def trade(ball):
    return result_of(measure(ball, 40, samples=3, name="ball"))


@pytest.fixture(scope="module")
def whole(trade):
    return {(r.method, r.precision): r for r in trade.whole}


@pytest.mark.parametrize("compared", [1, 8, 33, 64])
def test_the_converged_picture_has_twice_the_samples_of_all_others(ball, compared):
    """Else the finest choice would be held against itself, and be without an error."""
    small = tradeoff.at_width(ball, 8)
    count = samples_of(48, compared)
    assert count >= 2 * compared
    truth = result_of(converged(small, count))
    pixels = small.seen_by(small.camera.divided(count))
    every = result_of(frame_of(pixels, Settings("certified"))).color
    mean = every.reshape(6, count, 8, count, 4).mean(axis=(1, 3), dtype=np.float64)
    assert np.allclose(truth, mean, atol=1e-5)


def test_every_choice_has_its_row(trade):
    """Every method and precision at three widths; more samples at the largest."""
    one = {(r.method, r.precision, r.width, r.height) for r in trade.rows if r.samples == 1}
    assert one == {(*c, *size) for c in LADDER for size in ((40, 30), (20, 15), (10, 8))}
    more = {(r.samples, r.width) for r in trade.rows if r.samples > 1}
    assert more == {(2, 40), (3, 40)}
    assert any(r.samples == 3 and r.method == "certified" for r in trade.rows)
    assert len(trade.rows) == len({(r.method, r.precision, r.samples, r.width) for r in trade.rows})


def test_certified_is_the_reference(trade):
    for r in trade.rows:
        if r.method == "certified":
            assert r.wrong_pixels == 0 and r.largest_t_error == 0


def test_coverage_error_by_hand():
    truth = np.zeros((2, 4, 4))
    truth[:, :2] = 1.0
    assert coverage_error(truth, truth) == 0
    assert coverage_error(truth[:1, ::2], truth) == 0  # enlarged to what it is
    assert coverage_error(1 - truth, truth) == 1
    wrong = truth.copy()
    wrong[0, 0, 3] = 0.5  # of 32 numbers
    assert coverage_error(wrong, truth) == pytest.approx(np.sqrt(0.25 / 32))
    assert coverage_error(truth[:, :1], truth) == pytest.approx(np.sqrt(0.5))
    assert coverage_error(np.ones((3, 5, 4)), np.ones((7, 8, 4))) == 0


def test_largest_t_error_looks_where_both_see_the_same(ball):
    certified = Frame.empty(
        replace(ball, camera=replace(ball.camera, width=4, height=1, region=None))
    )
    certified.instance_index[:] = [[0, 0, 0, NOTHING]]
    certified.triangle_index[:] = [[3, 4, 5, NOTHING]]
    certified.t[:] = [[1.0, 2.0, 3.0, np.inf]]
    frame = Frame.empty(replace(ball, camera=replace(ball.camera, width=4, height=1, region=None)))
    assert largest_t_error(frame, certified) is None
    frame.instance_index[:], frame.triangle_index[:] = certified.instance_index, [[3, 4, 9, -1]]
    frame.t[:] = [[1.25, 1.5, 99.0, np.inf]]
    assert largest_t_error(frame, certified) == 0.5


@pytest.mark.parametrize("width", [1, 2, 3, 5])
def test_tiny_pictures(ball, width):
    trade = result_of(measure(ball, width, 1))
    assert {(r.method, r.precision) for r in trade.whole} == LADDER
    assert trade.whole[0].width == width and trade.advice


def stopped_after(work, seen):
    """Close work at the first step at which `seen` is true."""
    for _ in work:
        if seen():
            work.close()
            return True
    return False


def test_cancelled_while_memory_is_watched(ball):
    assert not tracemalloc.is_tracing()
    assert stopped_after(measure(ball, 16, 1), tracemalloc.is_tracing)
    assert not tracemalloc.is_tracing()


def test_who_watches_memory_already_goes_on(ball):
    tracemalloc.start()
    try:
        held = bytearray(50_000_000)
        rows = result_of(measure(ball, 8, 1)).rows
        assert tracemalloc.is_tracing()
        assert max(r.peak_bytes for r in rows) < len(held) / 2
    finally:
        tracemalloc.stop()


def test_what_happens_between_the_steps_takes_no_time(ball, monkeypatch):
    clock = [0.0]

    def perf_counter():
        clock[0] += 1.0  # each look at the clock; so each step takes one second
        return clock[0]

    monkeypatch.setattr(time, "perf_counter", perf_counter)

    def others(event):
        clock[0] += 1e6

    trade = result_of(measure(ball, 8, 1), others)
    assert all(r.seconds < 1e6 for r in trade.rows)


@pytest.mark.parametrize(
    ("seconds", "rounds"),
    [
        ((0.2, 0.3, 0.4), 3),  # long: noise does not matter as much
        ((0.05,) * 4, 4),
        ((0.05, 0.09, 0.051, 0.05), 4),  # one was disturbed
        ((0.05, 0.06, 0.06, 0.05, 0.05), 5),  # two were
        ((0.05, 0.06) * 2 + (0.07,) * 3, 7),
    ],
)
def test_rows_are_repeated_until_noise_no_longer_shows(ball, monkeypatch, seconds, rounds):
    def timed(choice):
        choice.rounds.append(seconds[len(choice.rounds)])
        yield 1.0

    monkeypatch.setattr(tradeoff, "SHORT", 0.1)
    monkeypatch.setattr(tradeoff, "_repeat", timed)
    choices = tradeoff.choose(ball, 8, 1)
    result_of(tradeoff._time_all(choices))
    assert {len(c.rounds) for c in choices} == {rounds}

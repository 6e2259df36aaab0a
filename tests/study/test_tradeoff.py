"""What is measured of the trade: every row whole, judged by the certified picture."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import Region, SceneError
from reference_tracer.study import tradeoff
from reference_tracer.study.tradeoff import at_width, converged, coverage_error, levels, measure
from reference_tracer.study.truth import largest_t_error
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Precision, Settings

from ..oracle import scene_sights

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


def test_every_choice_has_its_row(trade):
    """Every method and precision at three widths; more samples at the largest."""
    one = {(r.method, r.precision, r.width, r.height) for r in trade.rows if r.samples == 1}
    assert one == {(*c, *size) for c in LADDER for size in ((40, 30), (20, 15), (10, 8))}
    more = {(r.samples, r.width) for r in trade.rows if r.samples > 1}
    assert more == {(2, 40), (3, 40)}
    assert any(r.samples == 3 and r.method == "certified" for r in trade.rows)
    assert len(trade.rows) == len({(r.method, r.precision, r.samples, r.width) for r in trade.rows})


def test_every_row_is_whole(trade):
    for r in trade.rows:
        assert tradeoff.REPEATS <= len(r.rounds) <= tradeoff.MORE_REPEATS
        assert 0 < r.fastest <= r.seconds <= r.slowest
        assert r.seconds == np.median(r.rounds)
        assert 0 <= r.wrong_pixels <= r.pixels == r.width * r.height
        assert 0 <= r.largest_t_error < 1 and 0 < r.coverage_error < 1
    assert trade.scene == "ball" and trade.converged == 16


def test_certified_is_the_reference(trade):
    for r in trade.rows:
        if r.method == "certified":
            assert r.wrong_pixels == 0 and r.largest_t_error == 0


def test_the_literal_method_loses_many(whole):
    """A ray that misses the front of the ball sees its back, or nothing: both are wrong."""
    for precision in Precision:
        assert 0.2 < whole["textbook_literal", precision.value].wrong_pixels / 1200 < 0.7


@pytest.mark.parametrize("method", ["textbook", "moller_trumbore", "watertight"])
def test_the_others_are_right_but_for_a_few(whole, method):
    assert whole[method, "float64"].wrong_pixels == 0
    assert whole[method, "float64"].largest_t_error < 1e-14  # the ball is 2 m away
    assert whole[method, "float32"].wrong_pixels <= 12
    assert 1e-9 < whole[method, "float32"].largest_t_error < 1e-5


def test_wrong_pixels_are_those_that_the_oracle_rejects(ball, trade):
    """No ray of this scene meets an edge, so that each pixel has one answer."""
    scene = at_width(ball, 20)
    answers = [sight.seen[1] for sight in scene_sights(scene)]
    assert len(set(answers)) > 50
    for method, precision in LADDER:
        wrong = render(scene, Settings(method, precision)).triangle_index.ravel() != answers
        [row] = (
            r for r in trade.rows if (r.method, r.precision, r.width) == (method, precision, 20)
        )
        assert row.wrong_pixels == wrong.sum()


def test_coverage_gets_better_with_samples_and_pixels(trade):
    error = {(r.width, r.samples): r.coverage_error for r in trade.rows if r.method == "certified"}
    assert error[10, 1] > error[20, 1] > error[40, 1] > error[40, 2] > error[40, 3]


def test_the_converged_picture_is_that_of_as_many_samples(ball):
    """Also in bands; the rays are the same but for a rounding, so an edge may move by a sample."""
    small = at_width(ball, 20)
    expected = render(small, Settings(Method.WATERTIGHT, samples=8)).color
    found = result_of(converged(small, 8))
    assert np.abs(found - expected).max() < 1.5 / 64
    assert np.count_nonzero(np.abs(found - expected) > 1e-6) < 0.01 * expected.size


def test_the_converged_picture_is_the_same_in_bands(ball, monkeypatch):
    small = at_width(ball, 20)
    expected = result_of(converged(small, 4))
    monkeypatch.setattr(tradeoff, "BAND", 1000)  # three rows
    assert np.array_equal(result_of(converged(small, 4)), expected)


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


def test_the_whole_picture_is_measured(ball):
    """A border is left out: the picture is that of the whole camera."""
    bordered = replace(ball, camera=replace(ball.camera, region=Region(3, 4, 9, 8)))
    assert result_of(measure(bordered, 8, 1)).whole[0].pixels == 8 * 6


@pytest.mark.parametrize("width", [1, 2, 3, 5])
def test_tiny_pictures(ball, width):
    trade = result_of(measure(ball, width, 1))
    assert {(r.method, r.precision) for r in trade.whole} == LADDER
    assert trade.whole[0].width == width and trade.advice


def test_the_width_is_by_default_at_most_the_cameras(ball, monkeypatch):
    assert tradeoff.choose(ball, 80, 1)[0].scene.camera.width == 80
    taken = []
    monkeypatch.setattr(tradeoff, "choose", lambda scene, width, samples: taken.append(width))
    for scene in (ball, at_width(ball, 1920)):
        with pytest.raises(TypeError):  # there are no choices to measure
            next(measure(scene))
    assert taken == [80, tradeoff.WIDTH]


def test_a_scene_without_a_surface(make):
    trade = result_of(measure(make.scene(make.camera(8, 6)), samples=2))
    assert all(r.wrong_pixels == r.coverage_error == 0 for r in trade.rows)
    assert all(r.largest_t_error is None for r in trade.rows)
    assert trade.advice.startswith("Nothing is seen")


@pytest.mark.parametrize("width, samples", [(0, 1), (-3, 1), (8, 0), (8, -1), (8, 65)])
def test_out_of_range(ball, width, samples):
    with pytest.raises(SceneError if width < 1 else ValueError):
        result_of(measure(ball, width, samples))


def test_levels():
    assert [levels(n) for n in (1, 2, 3, 4, 6, 8)] == [
        [1],
        [1, 2],
        [1, 2, 3],
        [1, 2, 4],
        [1, 2, 4, 6],
        [1, 2, 4, 8],
    ]


def test_progress_never_goes_back(ball):
    shares = []
    result_of(measure(ball, 8, 2), shares.append)
    assert (np.diff(shares) > -1e-12).all()  # but for the rounding of a sum
    assert 0 <= shares[0] < 0.1 and shares[-1] == pytest.approx(1)


def test_memory_is_that_of_the_work(trade, whole):
    """At least the picture's own arrays, and more for a larger one."""
    for r in trade.rows:
        assert r.peak_bytes > 100 * r.pixels
    small = next(r for r in trade.rows if r.width == 10 and r.method == "certified")
    assert small.peak_bytes < whole["certified", "float64"].peak_bytes


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


@pytest.mark.parametrize("steps", [0, 1, 10, 100])
def test_cancelled_at_any_step(ball, steps):
    work = measure(ball, 16, 1)
    for _ in range(steps):
        next(work)
    work.close()
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


def test_what_others_take_between_the_steps_is_not_counted(ball):
    """As Blender's interface does while it is running."""
    work, held = measure(ball, 16, 1), []
    while True:
        try:
            next(work)
        except StopIteration as stop:
            trade = stop.value
            break
        if tracemalloc.is_tracing() and len(held) < 20:
            held.append(bytearray(20_000_000))
    assert held and max(r.peak_bytes for r in trade.rows) < 10_000_000


def test_what_happens_between_the_steps_takes_no_time(ball, monkeypatch):
    clock = [0.0]

    def perf_counter():
        clock[0] += 1.0  # each look at the clock; so each step takes one second
        return clock[0]

    monkeypatch.setattr(tradeoff.time, "perf_counter", perf_counter)
    work, steps = measure(ball, 8, 1), 0
    while True:
        try:
            next(work)
        except StopIteration as stop:
            trade = stop.value
            break
        clock[0] += 1000.0
        steps += 1
    assert all(r.seconds < steps for r in trade.rows)


def test_rounds_are_interleaved_and_turn_around(ball, monkeypatch):
    """A row's repeats are apart, with all others between them."""
    order = []

    def noted(choice):
        order.append(choice)
        choice.rounds.append(1.0)  # long enough that there are no more rounds
        yield 1.0

    monkeypatch.setattr(tradeoff, "_repeat", noted)
    choices = tradeoff.choose(ball, 8, 2)
    result_of(tradeoff._time_all(choices))
    assert order == [*choices, *reversed(choices), *choices]


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

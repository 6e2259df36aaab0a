"""Seconds and wrong pixels of every method and precision."""

from __future__ import annotations

from dataclasses import replace

import pytest
import trimesh
from reference_tracer.scene import Region
from reference_tracer.study import tradeoff
from reference_tracer.study.judge import judge
from reference_tracer.study.tradeoff import measure, table, wrong_pixels
from reference_tracer.tracer.render import render
from reference_tracer.tracer.settings import Method, Precision, Settings
from reference_tracer.tracer.visibility import NOTHING


@pytest.fixture(scope="module")
def ball(make):
    camera = make.camera(80, 60, eye=(1.1, -1.3, 0.9), target=(0.02, 0.01, 0.03))
    return make.scene(camera, make.mesh(trimesh.creation.icosphere(2)))


@pytest.fixture(scope="module")
def rows(ball):
    return {(r.method, r.precision): r for r in measure(ball, 40)}


def test_every_choice_has_its_row(rows):
    assert set(rows) == {(m.value, p.value) for m in Method for p in Precision}
    assert all(r.pixels == 40 * 30 and r.seconds > 0 for r in rows.values())


def test_the_literal_method_loses_many(rows):
    """A ray that misses the front of the ball sees its back, or nothing: both are wrong."""
    for precision in Precision:
        share = rows["textbook_literal", precision.value].wrong_pixels / 1200
        assert 0.2 < share < 0.7


@pytest.mark.parametrize("method", ["textbook", "moller_trumbore"])
def test_the_others_are_right_but_for_a_few(rows, method):
    assert rows[method, "float64"].wrong_pixels == 0
    assert rows[method, "float32"].wrong_pixels <= 12


def test_wrong_pixels_counts_each_wrong_one(ball):
    camera = replace(ball.camera, width=20, height=15, region=None)
    small = replace(ball, camera=camera)
    answers = [names for tile in judge(small) for names in tile]
    frame = render(small, Settings())
    assert wrong_pixels(frame, answers) == 0
    frame.triangle_index[3:5, :7] = 999
    frame.instance_index[8, 2] = NOTHING - 1
    assert wrong_pixels(frame, answers) == 15


def test_the_whole_picture_is_judged(ball):
    """A border is left out: the picture is that of the whole camera."""
    bordered = replace(ball, camera=replace(ball.camera, region=Region(3, 4, 9, 8)))
    assert all(r.pixels == 8 * 6 for r in measure(bordered, 8))


def test_progress(ball):
    shares = []
    measure(ball, 8, shares.append)
    assert shares == sorted(shares) and shares[-1] == pytest.approx(1)


def test_table(rows):
    lines = table(list(rows.values())).splitlines()
    assert len(lines) == 1 + len(rows) and len({len(line) for line in lines}) == 1
    base = next(line for line in lines if line.split()[:2] == ["textbook", "float64"])
    assert " 1.00 " in base
    worst = rows["textbook_literal", "float64"]
    assert f"{worst.wrong_pixels:,} ({worst.wrong_pixels / 1200:.2%})" in table([*rows.values()])


def test_times_are_medians(ball, monkeypatch):
    """Of each choice's repeats the middle one counts, so that one slow moment does not."""
    ticks = iter(range(10_000))
    monkeypatch.setattr(tradeoff.time, "perf_counter", lambda: float(next(ticks)) ** 2)
    seconds = [r.seconds for r in measure(ball, 4)]
    assert seconds == sorted(seconds) and len(set(seconds)) == len(seconds)

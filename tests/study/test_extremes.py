"""The study of numerical stability: what is counted, against what, and where methods break."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.methods import Method
from reference_tracer.study import extremes
from reference_tracer.study.extremes import ExtremesRow, breaking_points, measure, written
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.study.truth import sample, truth_of
from reference_tracer.tracer.hits import NOTHING
from reference_tracer.tracer.progress import result_of

from ..cases import rising
from ..sampled import daily
from ..scenarios import quick

pytestmark = pytest.mark.slow

BY_NAME = {s.name: s for s in SCENARIOS}


def at(name, *scales, judged=2):
    """Rows of a scenario by (method, precision, scale)."""
    rows = result_of(measure([replace(BY_NAME[name], scales=scales)], judged=judged))
    return {(r.method, r.precision, r.scale): r for r in rows}


@pytest.fixture(scope="module")
def rows():
    """Every scenario, in small pictures at three scales."""
    return result_of(measure(quick()))


def faults(rows):
    return [(r.scenario, r.scale) for r in rows if r.lost or r.doubled]


def certified(rows):
    return [r for r in rows if r.method == "certified"]


def test_certified_is_never_wrong(rows):
    some = certified(rows)
    assert faults(some) == []
    assert sum(r.judged for r in some) == extremes.JUDGED * len(some)
    assert {r.exact > 0 for r in some} == {True, False}
    assert all(r.largest_t_error is None or r.largest_t_error == 0 for r in some)


@pytest.mark.torture
def test_certified_is_never_wrong_at_any_scale():
    every = result_of(measure(judged=64))
    assert faults(certified(every)) == []
    assert len(certified(every)) == sum(len(s.scales) for s in SCENARIOS)
    for method in Method:
        if not method.is_proven:
            assert faults([r for r in every if r.method == method])


# As predicted: where a method still holds, and the share of rays that it loses further on.
@pytest.mark.parametrize(
    ("name", "method", "precision", "holds", "breaks", "least", "most"),
    daily(
        [
            ("far_from_origin", "textbook", "float32", 1e3, 1e6, 0.01, 0.3),
            ("far_from_origin", "textbook", "float32", 1e3, 1e8, 0.99, 1),
            ("far_from_origin", "watertight", "float32", 1e3, 1e8, 0.99, 1),
            ("far_from_origin", "textbook", "float64", 1e10, 1e15, 0.03, 0.5),
            ("needles", "textbook", "float32", 1e1, 1e3, 0.8, 1),
            ("needles", "watertight", "float32", 1e5, 1e9, 0.6, 1),
            ("needles", "textbook", "float64", 1e5, 1e9, 0.9, 1),
            ("needles", "watertight", "float64", 1e12, 1e15, 0.005, 0.5),
            ("grazing", "watertight", "float32", 1e-3, 1e-8, 0.2, 1),
            ("grazing", "textbook", "float64", 1e-10, 1e-15, 0.1, 0.6),
            ("tiny", "textbook", "float32", 1e-6, 1e-12, 0.99, 1),
            ("tiny", "textbook", "float64", 1e-60, 1e-80, 0.3, 0.9),
            ("tiny", "watertight", "float64", 1e-60, 1e-300, 1, 1),
            ("huge", "textbook", "float32", 1e6, 1e10, 0.5, 1),
            ("huge", "textbook", "float64", 1e60, 1e80, 1, 1),
            ("far_camera", "watertight", "float32", 1e3, 1e6, 0.1, 0.6),
            ("far_camera", "textbook", "float64", 1e10, 1e14, 0.03, 0.4),
            ("narrow_view", "watertight", "float32", 1e-4, 1e-8, 0.9, 1),
            ("close_planes", "watertight", "float64", 1024, 1, 0.05, 0.9),
        ],
        3,
    ),
)
def test_plain_methods_break_where_predicted(name, method, precision, holds, breaks, least, most):
    found = at(name, holds, breaks)
    assert found[method, precision, holds].lost == 0
    assert least <= found[method, precision, breaks].share <= most


def test_half_of_all_rays_are_lost_by_the_literal_textbook():
    r = at("far_from_origin", 0.0)["textbook_literal", "float64", 0.0]
    assert 0.2 < r.share < 0.7


def test_what_is_not_finite_is_refused_and_counted():
    scenario = replace(BY_NAME["non_finite"], scales=(0.0, 0.1))
    scene = scenario.build(0.1, 32, 24)
    mesh = scene.meshes[0]
    broken = (np.abs(mesh.vertices) > 1).any(axis=1)[mesh.triangles].any(axis=1)
    for r in result_of(measure([scenario], judged=2)):
        assert r.refused == (broken.sum() if r.scale else 0)
    found = at("huge", 1e300)
    float32 = found["watertight", "float32", 1e300]
    triangles = BY_NAME["huge"].build(1e300, 32, 24).triangle_count
    assert float32.refused == triangles + float32.rays
    assert found["certified", "float64", 1e300].refused == 0


@pytest.fixture(scope="module")
def truth():
    scenario = BY_NAME["corners_and_edges"]
    return scenario, result_of(truth_of(scenario.build(6.0, 16, 12)))


def judged_row(truth, frame=None, count=None, odd=True, judged=16):
    scenario, true = truth
    count = true.count if count is None else count
    true = replace(true, frame=frame or true.frame, count=count)
    return extremes._certified_row(replace(scenario, odd=odd), 6.0, true, judged)


def tampered(frame, **changes):
    """A frame with one of its arrays changed everywhere."""
    values = {name: np.full_like(getattr(frame, name), value) for name, value in changes.items()}
    return replace(frame, **values)


def test_the_definition_finds_what_is_wrong_with_a_certified_frame(truth):
    frame = truth[1].frame
    assert faults([judged_row(truth)]) == []
    assert judged_row(truth, tampered(frame, triangle_index=0)).wrong >= 15
    gone = tampered(frame, instance_index=NOTHING, triangle_index=NOTHING)
    assert judged_row(truth, gone).missed == 16 * 12
    kept = frame.t.copy()
    frame.t[:] = np.nextafter(kept, 0)
    assert judged_row(truth).largest_t_error > 0.5
    frame.t[:] = kept


def test_all_rays_are_held_against_how_often_they_must_cross(truth):
    count = truth[1].count
    assert judged_row(truth, count=count + 1).missed > 16 * 12 - 17
    assert judged_row(truth, count=count + 1).doubled == 16
    assert judged_row(truth, count=count + 1, odd=None).missed == 0
    assert judged_row(truth, count=0 * count, odd=None).wrong == 16 * 12 - 16
    assert judged_row(truth, count=0 * count, odd=None).missed == 16


def test_the_sample_has_what_integers_decided(truth):
    frame = truth[1].frame
    certainty = np.full_like(frame.certainty, Certainty.BOUND)
    certainty.flat[[3, 70, 100]] = Certainty.EXACT, Certainty.AMBIGUOUS, Certainty.EXACT
    pixels = sample(replace(frame, certainty=certainty), 10)
    assert {3, 70, 100} <= set(pixels) and len(set(pixels)) == 10
    assert len(sample(frame, 10_000)) == 16 * 12


def test_steps_and_stopping():
    scenario = replace(BY_NAME["needles"], scales=(10.0, 1e3), width=8, height=6)
    shares, _ = rising(measure([scenario]))
    assert shares[0] == 0 and shares[-1] == 1 and len(shares) > 20
    stopped = measure([scenario])
    next(stopped)
    stopped.close()


def row(scale, missed=0, wrong=0, doubled=0, scenario="tiny", method="watertight"):
    return ExtremesRow(scenario, scale, method, "float64", 200, missed, doubled, wrong, 0)


def test_breaking_points():
    rows = [row(1.0), row(0.1, doubled=1), row(0.01, wrong=2), row(1e-3, missed=1), row(1e-4)]
    rows += [row(1.0, method="certified")]
    first, second = breaking_points(rows)
    assert (first.doubled, first.wrong, first.missed, first.lost) == (0.1, 0.01, 1e-3, 0.01)
    assert second.method == "certified"
    assert second.lost is second.doubled is second.wrong is second.missed is None


@pytest.mark.parametrize(
    ("scale", "words"),
    [(None, "."), (0.0, "0"), (1e8, "1e8"), (148376.0, "1.5e5"), (1e-12, "1e-12"), (128, "128")],
)
def test_scales_in_few_letters(scale, words):
    assert written(scale) == words

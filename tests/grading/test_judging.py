"""Scenes: every pixel's mark, the boundary, the score, examples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.rendering import render
from reference_tracer.scene import SceneError
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings
from reference_tracer_grading.examples import find_examples
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.judging import judge
from reference_tracer_grading.picture import Mark, look
from reference_tracer_grading.subjects.triangle import TRIANGLE
from reference_tracer_grading.tally import Tally, score_of
from reference_tracer_processes.running import Limits

from .conftest import plain

TEXTBOOK = plain(Method.TEXTBOOK)


@pytest.fixture(scope="module")
def two(make):
    """Two squares behind one another, no edge near the centre of a pixel."""
    front, back = make.quad(-3.1, 3.3, -2.7, 2.9, -5), make.quad(-9, 9, -8, 8.3, -9)
    scene = make.scene(make.camera(24, 18, half=1), front, back)
    return result_of(prepare("two", scene, pixels=None))


@pytest.fixture(scope="module")
def tied(make):
    """Squares whose edges run through the centres of pixels, and two in one plane."""
    camera = make.camera(16, 16, half=8, orthographic=True)
    quads = make.quad(-4.5, 4.5, -4.5, 4.5, -5), make.quad(-2.7, 2.3, -2.6, 2.2, -5)
    return result_of(prepare("tied", make.scene(camera, *quads), pixels=None))


def marks(found):
    return {name: n for name, n in found.counts.items() if n}


def test_right_everywhere(two):
    found = result_of(look(two, TEXTBOOK))
    assert marks(found) == {"right": 24 * 18} and found.tally.score == 100
    assert (found.color == two.color).all() and not two.boundary.any()


def only(instance_z, change):
    """The textbook, with another answer for triangles at this z."""

    def intersect(o, d, p):
        t, s = TEXTBOOK(o, d, p)
        at = p[:, 0, 2] == instance_z
        return change(t, at), s

    return intersect


def test_missed_false_and_order(two):
    front = two.instance == 0
    missed = result_of(look(two, only(-5, lambda t, at: np.where(at, np.inf, t))))
    assert (missed.mark.ravel() == np.where(front, Mark.MISSED, Mark.RIGHT)).all()
    order = result_of(look(two, only(-9, lambda t, at: np.where(at, t / 3, t))))
    back = two.instance == 1
    expected = np.where(front, Mark.WRONG_ORDER, np.where(back, Mark.WRONG_T, Mark.RIGHT))
    assert (order.mark.ravel() == expected).all()

    def everything(o, d, p):
        t, s = TEXTBOOK(o, d, p)
        return np.where(p[:, 0, 2] == -5, 5.0, t), s

    false = result_of(look(two, everything))
    assert set(np.unique(false.mark)) == {Mark.RIGHT, Mark.FALSE_HIT_IN_FRONT}  # all is covered
    # Every candidate of the front square counts as hit, also beside the diagonal.
    assert false.tally.right["surface"] < false.tally.total and false.lost > 0


def test_false_hits_in_front_and_on_nothing(make, right):
    """u <= 1 and v <= 1 in place of u + v <= 1: parallelograms, over the sky and over surfaces."""
    text = right["moller_trumbore"].replace("(u + v <= 1)", "(u <= 1) & (v <= 1)")
    space = {}
    exec(text, space)
    ask = space["intersect"]
    behind = make.quad(-2.2, 0.31, -2.3, 2.2, -6)
    scene = make.scene(make.camera(), make.quad(-1.13, 0.93, -1.07, 1.21, -4), behind)
    front = replace(scene.meshes[0], triangles=[[1, 2, 0]], slots=None)
    scene = replace(scene, meshes=(front, *scene.meshes[1:]))
    subject = result_of(prepare("one", scene, pixels=None))
    found = result_of(look(subject, ask))
    shows = np.isfinite(subject.t).reshape(subject.shape)
    over, empty = found.mark == Mark.FALSE_HIT_IN_FRONT, found.mark == Mark.FALSE_HIT
    assert over.any() and empty.any()
    assert shows[over].all() and not shows[empty].any()
    examples = find_examples(found, ask)
    assert {e.group for e in examples} == {"false_hit_in_front", "false_hit"}
    for e in examples:
        assert e.object == "Quad" and e.certified[0] is None and e.student[0] is not None
    for mark in (Mark.FALSE_HIT_IN_FRONT, Mark.FALSE_HIT):
        rows = np.flatnonzero((found.mark == mark).any(axis=1))
        shown = [e.pixel[1] for e in examples if Mark[e.group.upper()] == mark]
        assert len(shown) == 3 and max(shown) - min(shown) >= (rows[-1] - rows[0]) / 3


def test_a_false_hit_behind_what_is_missed_is_a_miss(two):
    """The front square is not seen; what is then seen, wrongly, lies behind it."""

    def ask(o, d, p):
        return np.where(p[:, 0, 2] == -5, np.inf, 9.0), TEXTBOOK(o, d, p)[1]

    found = result_of(look(two, ask))
    assert (found.mark.ravel()[two.instance == 0] == Mark.MISSED).all()


def test_both_values_wrong(two):
    def ask(*q):
        t, s = TEXTBOOK(*q)
        return t + 0.01, s[:, [0, 2, 1]]

    found = result_of(look(two, ask))
    on = two.triangle != -1
    assert (found.mark.ravel()[on] == Mark.WRONG_T_AND_BARYCENTRICS).mean() > 0.98
    assert found.tally.right["t"] == 0


def test_wrong_values(two):
    on = two.triangle != -1
    swapped = result_of(look(two, lambda *q: (TEXTBOOK(*q)[0], TEXTBOOK(*q)[1][:, [0, 2, 1]])))
    assert (swapped.mark.ravel()[on] == Mark.WRONG_BARYCENTRICS).mean() > 0.98
    shares = swapped.tally.shares
    assert shares["surface"] == shares["t"] == 1 and shares["barycentrics"] < 0.02
    nan = result_of(look(two, lambda *q: (TEXTBOOK(*q)[0], TEXTBOOK(*q)[1] * np.nan)))
    assert (nan.mark.ravel()[on] == Mark.WRONG_BARYCENTRICS).all()


def test_edges_and_ties_are_never_held_against_anyone(tied):
    assert tied.boundary.sum() >= 36

    def generous(o, d, p):  # takes the edge for inside; and of two in a plane the other one
        t, s = TEXTBOOK(o, d, p)
        near = (s > -1e-14).all(axis=1) & (o[:, 2] - p[:, 0, 2] == 5)
        t = np.where(near, 5.0, t)
        return np.where(np.abs(p[:, :, 0]).max(axis=1) < 3, t * (1 - 2**-52), t), s

    def mean(o, d, p):
        t, s = TEXTBOOK(o, d, p)
        return np.where((s > 1e-14).all(axis=1), t, np.inf), s

    for ask in (generous, mean):
        found = result_of(look(tied, ask))
        assert set(marks(found)) <= {"right", "edge", "depth_tie"}
        assert found.tally.score == 100 and found.tally.all_right
    assert result_of(look(tied, mean)).lost > 0
    assert marks(result_of(look(tied, generous))) == {"right": 256}  # both are truly there


def test_nearly_in_one_plane(make):
    """One behind the other by the last digit of t: no sound float64 is to be held to it."""
    behind = np.nextafter(5.0, 6)
    quads = make.quad(-4.3, 4.1, -4.2, 4.4, -5), make.quad(-2.7, 2.3, -2.6, 2.2, -behind)
    scene = make.scene(make.camera(16, 16, half=8, orthographic=True), *quads)
    subject = result_of(prepare("near", scene, pixels=None))

    def exchanged(o, d, p):
        t, s = TEXTBOOK(o, d, p)
        return np.where(t == behind, 5.0, np.where(t == 5, behind, t)), s

    found = result_of(look(subject, exchanged))
    assert set(marks(found)) == {"right", "depth_tie"} and found.counts["depth_tie"] >= 16
    assert found.tally.score == 100


def test_infinite_planes_are_not_the_students(make):
    plane = np.array((0.0, 0, -7)), np.array((0.1, 0.2, 1.0))
    scene = make.scene(make.camera(), make.quad(-1.03, 1.07, -1.01, 1.02, -4), planes=[plane])
    subject = result_of(prepare("plane", scene, pixels=None))
    assert (subject.instance == 1).any()
    found = result_of(look(subject, TEXTBOOK))
    assert marks(found) == {"right": 24 * 18} and found.tally.total == (subject.instance == 0).sum()
    none = result_of(
        look(subject, lambda o, d, p: (np.full(len(o), np.inf), np.zeros((len(o), 3))))
    )
    assert set(marks(none)) == {"right", "missed"} and none.tally.score == 0


def test_what_is_behind_the_origin_cannot_be_judged(make):
    camera = make.camera(6, 4, orthographic=True, clip_start=-3.0)
    with pytest.raises(SceneError, match=r"scene of mine: the camera .* clip start is -3 m"):
        result_of(prepare("scene of mine", make.scene(camera, make.quad(-1, 1, -1, 1, -2))))


def test_stride(make):
    scene = make.scene(make.camera(50, 40), make.quad(-1.1, 0.9, -1.3, 1, -4))
    subject = result_of(prepare("s", scene, pixels=100))
    assert (subject.stride, subject.first, subject.shape) == (5, 2, (8, 10))
    frame = render(scene, Settings(Method.CERTIFIED))
    for k in range(80):
        x, y = subject.position(k)
        assert frame.triangle_index[y, x] == subject.triangle[k]
    assert result_of(look(subject, TEXTBOOK)).tally.score == 100


def test_examples(two):
    ask = only(-5, lambda t, at: np.where(at, np.inf, t))
    found = result_of(look(two, ask))
    examples = find_examples(found, ask)
    assert [e.group for e in examples] == ["missed"] * 3
    for e in examples:
        x, y = e.pixel
        assert found.mark[y, x] == Mark.MISSED and e.object == "Quad"
        origin, direction, triangle = map(np.array, e.given.values())
        t, *s = e.certified
        assert origin + t * direction == pytest.approx(s @ triangle) and t == 5
        assert e.student[0] is None


def tally(total, surface, t, barycentrics, boundary, boundary_right):
    right = {"surface": surface, "t": t, "barycentrics": barycentrics}
    return Tally(total, right, boundary, boundary_right, TRIANGLE.weights)


def test_scores():
    right = tally(10, 10, 10, 10, 3, 1)
    assert right.score == 100 and right.all_right
    nearly = tally(10**6, 10**6 - 1, 10**6 - 1, 10**6 - 1, 0, 0)
    assert nearly.score == 99.9 and not nearly.all_right
    assert tally(10, 0, 0, 0, 0, 0).score == 0 and tally(10, 10, 10, 0, 0, 0).score == 80
    assert score_of([right, None]) == 50 and score_of([None]) == 0 and score_of([]) == 0
    empty = tally(0, 0, 0, 0, 4, 4)
    assert empty.score == 100
    # Where nothing is counted, nothing is given for it.
    assert score_of([tally(10, 0, 0, 0, 0, 0), empty]) == 0 and score_of([empty, None]) == 0


def test_judge(two, checks, right, wrong_text, written):
    good = result_of(judge(written(right["textbook"]), checks, [two]))
    assert (good.verdict, good.score, good.faults, good.errors) == ("right", 100, [], [])
    bad = result_of(judge(written(wrong_text("s2_s3_swapped")), checks, [two]))
    assert bad.verdict == "wrong" and [f.name for f in bad.faults] == ["s2_s3_swapped"]
    assert 75 < bad.score < 85
    # A fault that no picture shows is one all the same.
    behind = result_of(judge(written(wrong_text("hits_behind")), checks, [two]))
    assert behind.verdict == "wrong" and behind.looks[0].tally.score == 100 > behind.score


def test_what_raises_is_wrong_and_the_rest_counts(two, checks, no_guard, written):
    """Named with its ray and triangle: asked one by one, only those that raise are wrong."""
    found = result_of(judge(written(no_guard), checks, [two]))
    [fault] = found.faults
    assert (fault.name, found.verdict, found.errors) == ("raises", "wrong", [])
    assert "ZeroDivisionError" in fault.sentence and "directions = [" in fault.sentence
    flat = checks.among("parallel", "empty")
    assert 0 < fault.pairs <= flat.sum() and found.checks.right["surface"] == 2600
    assert found.looks[0].tally.score == 100 and 90 < found.score < 100


def test_wrong_without_a_fault_is_named(two, checks, right, written):
    text = right["textbook"].replace(
        "x = o", "t *= 1 + 1e-9 * np.isin(triangles[:, 0, 0], (-3.1, 3.3))\n    x = o"
    )
    found = result_of(judge(written(text), checks, [two]))
    assert found.verdict == "wrong" and [f.name for f in found.faults] == ["unrecognised_pixels"]
    assert "in two" in found.faults[0].sentence


def test_boundary_verdict(tied, checks, right, written):
    strict = right["moller_trumbore"].replace(">= 0", "> 0")
    assert result_of(judge(written(strict), checks, [tied])).verdict == "boundary"


def test_failing_in_a_scene_only(two, tied, checks, right, written):
    """One scene is lost, the others are judged: by a process of its own again."""
    head, rest = right["textbook"].split("    o, d =")
    text = (
        f"{head}    if (directions == directions[0]).all(): raise OSError('no')\n    o, d ={rest}"
    )
    found = result_of(judge(written(text), checks, [tied, two]))
    assert found.verdict == "wrong" and found.errors == []
    assert [f.name for f in found.faults] == ["depends_on_the_call", "raises"]  # calls of one ray
    assert set(marks(found.looks[0])) == {"raised", "right"} and found.looks[0].tally.score == 0
    assert found.score == pytest.approx(66.6)
    slow = right["textbook"].replace(
        "    o, d =", "    import time; time.sleep(9.0 * (directions == directions[0]).all() * "
        "(len(directions) > 9))\n    o, d ="
    )  # fmt: skip
    found = result_of(judge(written(slow), checks, [tied, two], limits=Limits(seconds=5)))
    assert [(where, e.kind) for where, e in found.errors] == [("tied", "time")]
    assert [k.judged.name for k in found.looks] == ["two"]
    assert found.score == pytest.approx(66.6)

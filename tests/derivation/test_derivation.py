"""What a derivation says of a pixel: the proven picture's answer, and why all else is not it."""

from __future__ import annotations

import json
from itertools import product

import numpy as np
import pytest
from reference_tracer.certainty import Certainty
from reference_tracer.derivation import document, writers
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.formulas import Rejection
from reference_tracer.derivation.textbook import FLOATS, Arithmetic
from reference_tracer.methods import Method
from reference_tracer.projections import PROJECTIONS
from reference_tracer.rendering import render
from reference_tracer.report import pixel
from reference_tracer.report.shown import shown
from reference_tracer.scene import Mesh, SceneError
from reference_tracer.tracer.settings import Precision, Settings

FACING = [(-1, -1, -4), (1, -1, -4), (0, 1, -4)]  # the ray (0, 0, −1) meets it at t = 4


def shifted(x=0.0, y=0.0, z=0.0):
    return [(a + x, b + y, c + z) for a, b, c in FACING]


def reasons(scene, index=0):
    """Why the middle pixel does not see a triangle, the same in every arithmetic."""
    found = derive(scene, 1, 1)
    assert render(scene).instance_index[1, 1] == -1
    [test] = [t for t in found.tests if t.candidate.instance == index]
    said = {test.judgements[kind].reasons for kind in Arithmetic}
    assert len(said) == 1 and found.seen is None
    assert found.color == pytest.approx((0.2, 0.3, 0.4, 0.5))
    for text in (document.document_markdown(found), str(shown(found)), writers.json_text(found)):
        assert "nothing" in text
    return said.pop()


@pytest.mark.slow
def test_every_pixel_is_that_of_the_proven_picture(ball_scene):
    frame = render(ball_scene)
    h, w = frame.t.shape
    seen = set()
    for y in range(0, h, 2):
        for x in range(0, w, 2):
            found = derive(ball_scene, x, y, limit=2)
            answer = found.certified
            assert answer.seen == (frame.instance_index[y, x], frame.triangle_index[y, x])
            assert answer.t == frame.t[y, x] and answer.certainty == frame.certainty[y, x]
            assert answer.ties == frame.ties.get(y * w + x, frozenset())
            np.testing.assert_array_equal(np.float32(found.color), frame.color[y, x])
            seen.add(answer.seen[0])
    assert len(seen) >= 3


@pytest.mark.slow
def test_the_methods_answers_are_their_pictures(ball_scene):
    pixels = [(x, y) for y in range(0, 18, 4) for x in range(1, 24, 5)]
    answers = [derive(ball_scene, x, y).answers for x, y in pixels]
    methods = [m for m in Method if not m.is_proven]
    assert [(a.method, a.precision) for a in answers[0]] == list(product(methods, Precision))
    for k, (method, precision) in enumerate(product(methods, Precision)):
        frame = render(ball_scene, Settings(method, precision))
        for (x, y), said in zip(pixels, answers, strict=True):
            assert said[k].seen == (frame.instance_index[y, x], frame.triangle_index[y, x])
            assert said[k].t == frame.t[y, x]


@pytest.mark.parametrize(
    ("triangle", "reason"),
    [
        (shifted(x=0.7)[1:] + shifted(x=0.7)[:1], Rejection.S1_NEGATIVE),
        (shifted(x=0.7)[2:] + shifted(x=0.7)[:2], Rejection.S3_NEGATIVE),
        (shifted(x=0.7), Rejection.S2_NEGATIVE),
        (shifted(x=-0.7), Rejection.S1_NEGATIVE),
        (shifted(z=8), Rejection.BEHIND),
        (shifted(z=3.75), Rejection.BEFORE_CLIP_START),
        (shifted(z=-200), Rejection.BEYOND_CLIP_END),
        ([(0, 0, -4), (1, 0, -4), (-1, 0, -4)], Rejection.DEGENERATE),
        ([(0, -1, -3), (0, 1, -3), (0, 0, -9)], Rejection.PARALLEL),
    ],
)
@pytest.mark.parametrize("projection", PROJECTIONS.values(), ids=PROJECTIONS)
def test_why_not(one_triangle, triangle, reason, projection):
    # Through the middle of the picture both kinds of camera send the same ray.
    assert reasons(one_triangle(triangle, projection=projection)) == (reason,)


def test_planes(one_triangle):
    assert reasons(one_triangle(planes=[((0, -1, 0), (0, 1, 0))])) == (Rejection.PARALLEL,)
    assert reasons(one_triangle(planes=[((0, 0, 5), (0, 1, 2))])) == (Rejection.BEHIND,)
    found = derive(one_triangle(shifted(z=-9), planes=[((0, 0, -8), (0, 1, 2))]), 1, 1)
    assert found.seen.is_plane and found.seen.object == "Thing 1"
    assert found.color == pytest.approx((0.5, 0.5, 0, 1))  # alpha is 1 on every surface
    assert "infinite plane" in document.document_markdown(found)


def test_an_edge_is_ambiguous(one_triangle):
    left, right = [(-1, -1, -4), (0, -1, -4), (0, 1, -4)], [(0, -1, -4), (1, -1, -4), (0, 1, -4)]
    found = derive(one_triangle(left, right), 1, 1)
    assert found.certified.certainty == Certainty.AMBIGUOUS
    assert found.certified.ties == {(0, 0), (1, 0)}
    assert [t.judgements[Arithmetic.EXACT].accepted for t in found.tests] == [True, True]
    assert "may be said to see" in document.document_markdown(found)
    assert len(writers.to_dict(found)["certified"]["may_be_seen"]) == 2


def test_the_limit_keeps_what_is_seen_and_what_is_tied(one_triangle):
    farther = [shifted(z=-k) for k in range(1, 6)]
    tied = derive(
        one_triangle(*farther, FACING, FACING, FACING, planes=[((0, 0, -50), (0, 0, 1))]),
        1,
        1,
        limit=1,
    )
    names = [t.candidate.name for t in tied.tests]
    assert names == [(5, 0), (6, 0), (7, 0), (8, -1)]
    assert tied.pixel.left_out == 5 and tied.certified.seen == (5, 0)
    assert "5 are left out" in document.document_markdown(tied)
    whole = derive(one_triangle(*farther, FACING), 1, 1, limit=99)
    assert [t.candidate.instance for t in whole.tests] == [5, 0, 1, 2, 3, 4]  # by t
    assert whole.pixel.left_out == 0


def test_near_misses_come_first(one_triangle):
    found = derive(one_triangle(shifted(x=0.9), shifted(x=0.6), FACING), 1, 1)
    assert [t.candidate.instance for t in found.tests] == [2, 1, 0]


@pytest.mark.parametrize(("x", "y", "name"), [(3, 0, "x"), (-1, 0, "x"), (0, 3, "y"), (0, -1, "y")])
def test_outside_the_picture(one_triangle, x, y, name):
    with pytest.raises(SceneError, match=f"picture of 3 x 3: {name} must be between 0 and 2"):
        derive(one_triangle(FACING), x, y)
    with pytest.raises(SceneError, match="integer"):
        derive(one_triangle(FACING), 0.5, 1)


def test_colors_between_corners(make):
    quad = make.quad(-3, 3, -2, 2, -4)
    colors = np.random.default_rng(5).random((2, 3, 4)).astype(np.float32)
    scene = make.scene(make.camera(7, 5), Mesh(quad.vertices, quad.triangles, None, colors))
    frame = render(scene)
    for x, y in ((0, 0), (5, 3), (6, 1)):
        found = derive(scene, x, y)
        np.testing.assert_array_equal(np.float32(found.color), frame.color[y, x])
        [color] = [q for q in found.shading if q.key == "color"]
        exact = [float(v) for v in color.values[Arithmetic.EXACT]]
        np.testing.assert_allclose(exact, found.color[:3], rtol=1e-6)
        # Swapped as printed, the weights would give another colour: erratum 1.
        s = found.certified.s[[0, 2, 1]]
        swapped = (colors[found.certified.seen[1], :, :3] * s[:, None]).sum(axis=0)
        assert np.abs(swapped - exact).max() > 1e-3
        assert "weighed by s₁, s₂, s₃" in document.document_markdown(found)


def test_from_inside_what_is_behind_is_told(make):
    """A camera in a room: the wall behind it is met by the line, and rejected, not left out."""
    front, back = make.quad(-9, 9, -9, 9, -5, "Front"), make.quad(-9, 9, -9, 9, 5, "Back")
    across = Mesh(np.array([(-1, -1, 3), (1, -1, -9), (0, 2, -9.0)]), [[0, 1, 2]], name="Across")
    found = derive(make.scene(make.camera(9, 9), front, back, across), 4, 5)
    said = [(t.candidate.object, t.judgements[Arithmetic.EXACT]) for t in found.tests]
    assert ("Front", True) in [(name, j.accepted) for name, j in said]
    assert ("Back", (Rejection.BEHIND,)) in [(name, j.reasons) for name, j in said]
    assert "Across" in [name for name, _ in said]


@pytest.mark.parametrize("scale", [1e-150, 1e-30, 1e30, 1e150])
def test_at_the_ends_of_floats(one_triangle, scale):
    """Overflow and underflow are told, never raised, and JSON stays JSON."""
    scene = one_triangle((np.array(FACING) * (scale, scale, 1)).tolist())
    found = derive(scene, 1, 1)
    assert found.certified.t == 4
    assert not found.tests[0].judgements[Arithmetic.FLOAT32].accepted
    content = json.loads(writers.json_text(found))
    assert content["certified"]["t"] == 4
    assert "rejects what is truly hit" in document.document_markdown(found)
    pixel.html(found)


def test_a_miss_of_float32_is_said(make):
    """A thousand kilometres away float32 no longer knows where the triangles are."""
    from .conftest import ball

    scene = ball(make, far=1e6)
    told = {"accepts": 0, "rejects": 0}
    for x in range(8, 16):
        found = derive(scene, x, 9)
        text = document.document_markdown(found)
        for kind in FLOATS:
            wrong = {
                "accepts" if test.judgements[kind].accepted else "rejects"
                for test in found.tests
                if test.judgements[kind].accepted != test.judgements[Arithmetic.EXACT].accepted
            }
            for word, truly in (("accepts", "missed"), ("rejects", "hit")):
                said = f"{kind.capitalize()} {word} what is truly {truly}." in text
                assert said == (word in wrong), (x, kind)
                told[word] += said
    assert told["rejects"] > 0  # or the test has seen nothing

"""Counts, metrics and verdict of a comparison, and what of it JSON holds."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.cause import Causes
from reference_tracer.causes.counts import Counts, count_pixels
from reference_tracer.causes.explain import (
    AGREE,
    CAUSES,
    EDGE,
    NOT_DECIDABLE,
    NOT_TRACED,
    UNEXPLAINED,
)
from reference_tracer.comparison.comparing import compare, trace_and_compare
from reference_tracer.comparison.comparing import compared as driver
from reference_tracer.comparison.comparison import SCHEMA
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.manifest import ObjectEntry, Unmodelled
from reference_tracer.pictures.metrics import boundary
from reference_tracer.pictures.picture import Picture, SizeError, Source
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.rendering import render
from reference_tracer.scene import SceneError
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..cases import MANIFEST, case_of

BLENDER = {
    "version": "5.2.3",
    "source": "workbench",
    "sample_radius": 0.0,
    "renderer": "raster",
    "snapping": 1 / 256,
    "filter_radius": 0.0,
    "settings": {},
}
BY_KEY = {cause.key: cause for cause in CAUSES}
BOX = np.array([[-2.0, -2, -2.1], [0.1, 0.1, -2]])


@pytest.fixture
def scene(make):
    """Return two squares before a background, one before the other."""
    return make.scene(
        make.camera(20, 16),
        make.quad(-0.513, 0.4, -0.4, 0.411, -2),
        make.quad(-9, 0.2, -9, 0.3, -3),
    )


def compared(scene, picture, manifest=MANIFEST, frame=None):
    frame = frame or render(scene)
    return result_of(compare(replace(case_of(scene, picture), manifest=manifest), frame))


def mixed(scene):
    """Return a comparison of which one pixel in three is something else."""
    picture = render(scene).color.copy()
    picture.reshape(-1, 4)[::3] = 1
    hair = Unmodelled("Hair", "hair", bounds=BOX)
    return compared(scene, picture, replace(MANIFEST, unmodelled=(hair,)))


def test_counts_add_up(scene):
    found = mixed(scene)
    p = found.counts
    assert p.total == 320 == p.agree + p.differ + p.not_decidable + p.not_traced
    assert p.differ == p.explained + p.unexplained
    assert p.differ + p.not_decidable == sum(p.by_cause.values())
    assert p.by_cause["not_modelled"] > 10 and p.unexplained > 10
    assert set(p.by_cause) == {c.key for c in CAUSES if c not in (AGREE, NOT_TRACED)}
    for key in ("total", "agree", "differ", "explained", "unexplained", "not_decidable"):
        assert getattr(p, key) == getattr(p.interior, key) + getattr(p.boundary, key)
    assert p.boundary.total == boundary(found.frame).sum() > 0 < p.interior.total
    for name, n in p.by_cause.items():
        assert n == (found.causes.cause == BY_KEY[name]).sum()


def test_examples_are_spread(scene):
    picture = render(scene).color.copy()
    picture[2:14, 3:19] = (1, 0, 1, 1)
    found = compared(scene, picture)
    examples = found.counts.examples["unexplained"]
    rows, columns = np.nonzero(found.causes.cause == UNEXPLAINED)
    assert len(examples) == 10 and len({y for _, y in examples}) > 8
    assert examples[0] == [columns[0], rows[0]] and examples[-1] == [columns[-1], rows[-1]]


def test_undecidable_pixels_have_examples_too():
    causes = Causes.none((3, 4))
    causes.cause[1, 2] = NOT_DECIDABLE
    counted = count_pixels(causes, np.zeros((3, 4), bool))
    assert counted.examples == {"not_decidable": [[2, 1]]}


def test_equal_pictures_agree(scene):
    found = compared(scene, render(scene).color)
    assert found.verdict == "agree" and found.verdict.exit_code == 0
    assert "(certified, float64, 1 x 1 rays a pixel)" in "\n".join(found.lines())
    assert found.metrics.psnr == np.inf
    assert found.metrics.to_dict() == {
        "rmse": 0,
        "psnr": None,
        "ssim": pytest.approx(1),
        "largest_difference": {"value": 0, "pixel": [0, 0], "channel": 0},
    }


def test_verdicts(scene):
    """Each from what leads to it; differences weigh more than warnings."""
    picture = render(scene).color
    glass = Unmodelled("Glass", "transparency", bounds=BOX)
    torn = ObjectEntry("Torn", "MESH", True, left_out=1)
    for manifest in (replace(MANIFEST, unmodelled=(glass,)), replace(MANIFEST, objects=(torn,))):
        assert compared(scene, picture, manifest).verdict == "warnings"
        assert compared(scene, picture[::-1].copy(), manifest).verdict == "differences"
    assert mixed(scene).verdict == "differences"
    assert [Verdict(v).exit_code for v in ("agree", "warnings", "differences")] == [0, 1, 2]


def test_what_is_not_decidable_is_not_comparable(make):
    far = make.scene(
        make.camera(8, 6, eye=(1e7, 1e7, 0)), make.quad(1e7 - 1, 1e7, 1e7 - 1, 1e7 + 1, -2)
    )
    found = compared(far, render(far).color)
    assert found.verdict == "not comparable" and found.counts.not_decidable == 48
    assert any(line.startswith("100 % of this picture is not decidable") for line in found.lines())


def test_cancelled(scene):
    frame = Frame.empty(scene)
    frame.cancelled = True
    found = compared(scene, render(scene).color, frame=frame)
    assert found.verdict == "cancelled" and found.verdict.exit_code != 0
    assert found.counts.not_traced == found.counts.total


def test_metrics_find_the_largest_difference(scene):
    picture = render(scene).color.copy()
    picture[11, 7] += (0, 0.25, 0, 0)
    found = compared(scene, picture).metrics
    assert found.largest_difference == (pytest.approx(0.25), (7, 11), 1)
    assert found.rmse == pytest.approx(0.25 / np.sqrt(320 * 4))
    assert found.psnr == pytest.approx(-20 * np.log10(found.rmse))


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e30])
def test_json_is_strict_whatever_the_picture(scene, value):
    picture = render(scene).color.copy()
    picture[3, 4, 0] = value
    found = compared(scene, picture)
    again = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert again["verdict"] == "differences" and again["pixels"]["unexplained"] == 1


def test_json_has_what_is_promised(scene):
    found = mixed(scene)
    held = json.loads(json.dumps(found.to_dict(), allow_nan=False))
    assert held["schema"] == SCHEMA
    assert set(held) == {
        "schema",
        "scene",
        "blender",
        "tracer",
        "pixels",
        "excused",
        "metrics",
        "methods",
        "verdict",
        "causes",
        "transform",
        "shades",
        "background",
        "hidden",
        "identity",
        "certificate",
        "diagnosis",
        "self_check",
    }
    assert held["causes"]["edge"] == {
        "number": 1,
        "label": EDGE.label,
        "sentence": EDGE.sentence,
        "unit": "px",
    }
    assert set(held["causes"]) == {c.key for c in CAUSES}
    assert held["identity"] is held["certificate"] is None and held["self_check"] == []
    assert held["blender"] == BLENDER and held["pixels"] == found.counts.to_dict()
    assert held["scene"]["unmodelled"][0]["object"] == "Hair"
    tracer = held["tracer"]
    named = tracer["method"], tracer["precision"], tracer["samples"]
    assert named == ("certified", "float64", 1)
    assert tracer["triangles"] == 4 and tracer["pairs_tested"] > 0 and tracer["seconds"] >= 0
    assert set(held["metrics"]) == {"rmse", "psnr", "ssim", "largest_difference"}


def test_lines_say_the_verdict_and_every_cause(scene):
    found = mixed(scene)
    text = "\n".join(found.lines())
    assert f"{found.counts.agree} of 320 pixels agree" in text
    assert f"unexplained: {found.counts.unexplained}" in text
    assert f"not modelled: {found.counts.by_cause['not_modelled']}" in text
    assert "verdict: differences" in text and "workbench" in text
    assert "PSNR infinite" in "\n".join(compared(scene, render(scene).color).lines())


def test_a_verdict_says_what_it_leaves_out(scene):
    cause = np.zeros((4, 5), np.uint8)
    assert Verdict.AGREE.in_words(Counts.of(cause)) == "Agree"
    cause[0, :3] = EDGE
    assert Verdict.AGREE.in_words(Counts.of(cause)) == "Agree, but for 3 px at edges"
    cause[1] = UNEXPLAINED  # which no agreement leaves out
    said = "Differences: 5 px unexplained, 3 px at edges"
    assert Verdict.DIFFERENCES.in_words(Counts.of(cause)) == said
    assert mixed(scene).lines()[-1].startswith("verdict: differences: ")


@pytest.mark.parametrize("shape", [(16, 21, 4), (20, 16, 4), (16, 20, 3)])
def test_sizes_must_match(scene, shape):
    with pytest.raises(SizeError, match=f"{shape[1]} x {shape[0]}.*20 x 16"):
        compared(scene, np.zeros(shape, np.float32))


@pytest.mark.parametrize(
    ("sampling", "told"),
    [
        ({"sample_radius": 0.6}, "up to 0.6 px"),
        ({"sample_radius": 0.4965}, "up to 0.4.* px"),  # with the rounding of corners it is too far
        ({"snapping": 0.5}, "rounded to 0.5 px"),
        ({"sample_radius": 0.3, "snapping": 0.25}, "up to 0.3 px.*rounded to 0.25 px"),
    ],
)
def test_samples_far_from_the_centres_are_refused(scene, sampling, told):
    """No pixel could be decided: the fault is the judge's, not the scene's."""
    picture = Picture(render(scene).color, Source("draft", "5.2.3"), sampling=Sampling(**sampling))
    with pytest.raises(SceneError, match=f"Blender's draft picture cannot be compared.*{told}"):
        result_of(trace_and_compare(case_of(scene, picture)))
    with pytest.raises(SceneError, match=told):
        compared(scene, picture)


def test_tracing_and_comparing_in_one(scene):
    shares = []
    picture = render(scene).color[::-1].copy()
    work = trace_and_compare(case_of(scene, picture))
    found = result_of(work, shares.append)
    assert (np.diff(shares) >= 0).all() and 0 <= shares[0] < 0.5 < shares[-1] <= 1
    apart = compared(scene, picture)
    assert np.array_equal(found.frame.color, apart.frame.color)
    assert np.array_equal(found.causes.cause, apart.causes.cause)


def test_whether_to_diagnose_is_decided_by_the_driver(scene):
    """What is kept has the diagnosis the second time; who stops before it has the comparison.

    The share of the work that is done never runs backwards.
    """

    def diagnosed(color, **wanted):
        def kept(found):
            seen.append("diagnosis" if found.diagnosis else "comparison")
            yield 0.5

        seen = []
        case = case_of(scene, Picture(color), curves=(), self_check=True)
        shares = []
        work = driver(case, told=lambda found: seen.append("told"), kept=kept, **wanted)
        found = result_of(work, shares.append)
        assert np.diff(shares).min() > -1e-12 and 0 <= shares[0] and shares[-1] <= 1  # by rounding
        assert (found.diagnosis is not None) == ("told" in seen)
        return seen

    same = render(scene).color
    assert diagnosed(same, diagnose=True) == diagnosed(same[::-1].copy()) == ["comparison"]
    wrong = diagnosed(same[::-1].copy(), diagnose=True)
    assert wrong == ["comparison", "told", "diagnosis"]


@pytest.mark.parametrize("color", [Color.NORMAL, Color.DEPTH])
def test_a_comparison_is_about_the_objects_colours(scene, color):
    """Whatever a render shows: what is traced, and the self-check, too."""
    picture = render(scene).color
    case = case_of(scene, picture, settings=Settings(color=color), self_check=True)
    found = result_of(trace_and_compare(case))
    assert found.counts.differ == 0 and found.verdict == "agree"
    assert np.array_equal(found.frame.color, picture) and found.self_check

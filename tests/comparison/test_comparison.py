"""Counts, metrics and verdict of a comparison, and what of it JSON holds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.counts import Counts
from reference_tracer.causes.explain import (
    EDGE,
    UNEXPLAINED,
)
from reference_tracer.comparison.comparing import compare, trace_and_compare
from reference_tracer.comparison.comparing import compared as driver
from reference_tracer.comparison.verdict import Verdict
from reference_tracer.manifest import ObjectEntry, Unmodelled
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.pictures.source import Source
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.scene import SceneError
from reference_tracer.tracer.coloring import Color
from reference_tracer.tracer.frame import Frame
from reference_tracer.tracer.progress import Found, result_of
from reference_tracer.tracer.settings import Settings

from ..cases import MANIFEST, case_of

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
    assert any(
        line.startswith("100 % of this picture is not decidable") for line in describe(found)
    )


def test_cancelled(scene):
    frame = Frame.empty(scene)
    frame.cancelled = True
    found = compared(scene, render(scene).color, frame=frame)
    assert found.verdict == "cancelled" and found.verdict.exit_code != 0
    assert found.counts.not_traced == found.counts.total


def test_a_verdict_says_what_it_leaves_out(scene):
    cause = np.zeros((4, 5), np.uint8)
    assert Verdict.AGREE.in_words(Counts.of(cause)) == "Agree"
    cause[0, :3] = EDGE
    assert Verdict.AGREE.in_words(Counts.of(cause)) == "Agree, but for 3 px at edges"
    cause[1] = UNEXPLAINED  # which no agreement leaves out
    said = "Differences: 5 px unexplained, 3 px at edges"
    assert Verdict.DIFFERENCES.in_words(Counts.of(cause)) == said
    assert describe(mixed(scene))[-1].startswith("verdict: differences: ")


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


def test_whether_to_diagnose_is_decided_by_the_driver(scene):
    """Who stops while it looks for what is wrong has the comparison."""

    def is_diagnosed(color, **wanted):
        case = case_of(scene, Picture(color), curves=(), self_check=True)
        events = []
        found = result_of(driver(case, **wanted), events.append)
        before = [e.result.diagnosis for e in events if isinstance(e, Found)]
        assert before == [None] * (found.diagnosis is not None)
        return found.diagnosis is not None

    same = render(scene).color
    assert not is_diagnosed(same, diagnose=True) and not is_diagnosed(same[::-1].copy())
    assert is_diagnosed(same[::-1].copy(), diagnose=True)


@pytest.mark.parametrize("color", [Color.NORMAL, Color.DEPTH])
def test_a_comparison_is_about_the_objects_colours(scene, color):
    """Whatever a render shows: what is traced, and the self-check, too."""
    picture = render(scene).color
    case = case_of(scene, picture, settings=Settings(color=color), self_check=True)
    found = result_of(trace_and_compare(case))
    assert found.counts.differ == 0 and found.verdict == "agree"
    assert np.array_equal(found.frame.color, picture) and found.self_check

"""As it is: what Blender's own shading adds is named, and explains what it changes."""

from __future__ import annotations

import pytest
from reference_tracer.report.lines import describe

SMOOTH = "FXAA", "5", "8", "32"


@pytest.mark.parametrize("judge", ["WORKBENCH", "CYCLES"])
def test_light_and_anti_aliasing_are_named(build, compare, judge):
    scene = build.room(lens=40)
    scene.display.shading.light = "STUDIO"
    comparison = compare(as_is=True, judge=judge)
    named = {u.feature for u in comparison.manifest.unmodelled if u.effect.everywhere}
    expected = (
        {"studio light", "anti-aliasing"} if judge == "WORKBENCH" else {"materials and light"}
    )
    assert expected <= named
    assert comparison.counts.unexplained == 0
    assert comparison.counts.by_cause["color"] > 100  # the same objects in another light
    assert comparison.causes.transform == "light that the tracer does not have"
    assert comparison.verdict == "warnings"


@pytest.mark.parametrize("as_is", [False, True])
def test_what_a_render_shows_does_not_change_a_comparison(as_is, build, compare):
    """Blender draws the objects' colours: so does the tracer, and the self-check finds all."""
    scene = build.room(lens=40)
    scene.display.shading.light = "FLAT"
    before = compare(as_is=as_is)
    scene.reference_tracer.color = "normal"
    after = compare(as_is=as_is)
    assert (before.frame.color == after.frame.color).all()
    assert before.counts == after.counts and before.verdict == after.verdict


def test_examples_say_where(build, compare):
    scene = build.room(lens=40)
    scene.display.shading.light = "STUDIO"
    comparison = compare(as_is=True)
    places = comparison.counts.examples["color"]
    assert len(places) == 10
    for x, y in places:
        assert comparison.causes.cause[y, x] != 0
    assert f"({places[0][0]}, {places[0][1]})" in "\n".join(describe(comparison))


SMOOTHED = [(n, s) for n in ("exercise_triangle", "suzanne", "shifted_room") for s in SMOOTH]
EVERY_DAY = SMOOTHED[0], SMOOTHED[3], SMOOTHED[5], SMOOTHED[10]  # each filter, and each scene


@pytest.mark.parametrize(
    ("name", "smooth"),
    [pytest.param(*k, marks=() if k in EVERY_DAY else pytest.mark.torture) for k in SMOOTHED],
)
def test_anti_aliasing_alone_is_checked(name, smooth, opened, compare):
    """Every colour is a mix of what the tracer sees within the filter; nothing is excused."""
    scene = opened(name, 128)
    scene.display.shading.light, scene.display.render_aa = "FLAT", smooth
    found = compare(as_is=True)
    by_cause = found.counts.by_cause
    assert found.counts.unexplained == by_cause["not_modelled"] == by_cause["color"] == 0
    assert by_cause["anti_aliasing"] > 100
    assert found.counts.interior.agree > 0.8 * found.counts.interior.total
    assert found.verdict == "warnings"


def test_light_does_not_excuse_a_missing_object(build, compare, monkeypatch):
    """Blender draws one object less, in studio light: the other shades are no reason."""
    from reference_tracer.blender.drawing import drawings

    scene = build.room(lens=40)
    scene.display.shading.light = "STUDIO"
    real = drawings.stand_ins

    def lacking(tmp, *rest):
        tmp.collection.objects.unlink(tmp.objects["Green"])
        return real(tmp, *rest)

    monkeypatch.setattr(drawings, "stand_ins", lacking)
    found = compare(as_is=True)
    assert found.verdict == "differences"
    assert found.counts.unexplained_shows.other_object > 100

"""The share of a picture that may rest on rounding, and what helps where it is too much."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.checks.edges import EDGE
from reference_tracer.causes.excused import Excused, Unjudged
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.report.lines import describe
from reference_tracer.tracer.progress import result_of

from ..cases import WORKBENCH, case_of, owners_of


def compared(scene, shown):
    """Compare with what Blender, by rounding, makes of another scene."""
    return result_of(trace_and_compare(case_of(scene, render(shown).color)))


def farther(scene):
    """The scene of which the second wall is shown."""
    return replace(scene, instances=scene.instances[1:])


def advised(found, pattern):
    (advice,) = found.excused.advice
    assert any(advice in line for line in describe(found))
    assert advice in found.to_dict()["excused"]["advice"]
    return float(re.search(pattern, advice)[1])


def walls(make, camera, depth, gap, size=300):
    x = camera.origin[0]
    near, far = (make.quad(x - size, x + size, -size, size, -z) for z in (depth, depth + gap))
    return make.scene(camera, near, far)


def test_a_clip_start_that_helps(make):
    camera = make.camera(24, 18, clip_start=0.001, clip_end=1e4)
    scene = walls(make, camera, 900.0, 0.1, size=900)
    found = compared(scene, farther(scene))
    assert found.excused.share > 0.5
    assert found.verdict == "not comparable" and found.verdict.exit_code == 1
    start = advised(found, r"raise the clip start from 0.001 m to (\S+) m")
    there = replace(scene, camera=replace(camera, clip_start=start))
    assert compared(there, there).verdict == "agree"
    assert compared(there, farther(there)).verdict == "differences"


def test_a_clip_end_that_helps(make):
    """All that an orthographic camera's depth buffer depends on is its length."""
    camera = make.camera(24, 18, half=9, orthographic=True, clip_start=0.1, clip_end=1e7)
    scene = walls(make, camera, 20.0, 0.01)
    found = compared(scene, farther(scene))
    end = advised(found, r"lower the clip end from 1e\+07 m to (\S+) m")
    there = replace(scene, camera=replace(camera, clip_end=end))
    assert compared(there, there).verdict == "agree"
    assert compared(there, farther(there)).verdict == "differences"


def test_a_distance_that_helps(make):
    """So far from the origin float32 itself does not tell the walls apart, in any clip range."""
    camera = make.camera(24, 18, eye=(3e4, 0, 0), clip_start=1.0, clip_end=100.0)
    scene = walls(make, camera, 50.0, 0.001)
    found = compared(scene, farther(scene))
    gap = advised(found, r"at least (\S+) m apart")
    there = walls(make, camera, 50.0, gap)
    assert compared(there, there).verdict == "agree"
    assert compared(there, farther(there)).verdict == "differences"


def test_more_pixels_help(make):
    """An edge through the centres of one column of 24."""

    def seen(width, off):
        camera = make.camera(width, width * 3 // 4)
        pixel = 2 * camera.window.right / 24
        return make.scene(camera, make.quad(-9, pixel / 2 + off * pixel, -9, 9, -1))

    found = compared(seen(24, -0.001), seen(24, 0.001))
    assert found.verdict == "warnings" and found.counts.by_cause["edge"] == 18
    times = int(advised(found, r"draw the picture (\d+) times as wide"))
    again = compared(seen(24 * times, -0.001), seen(24 * times, 0.001))
    assert again.verdict == "agree" and again.excused.share <= found.excused.share / times


@pytest.mark.parametrize("gap", [0.0, 1e-9, 1e-4])
def test_surfaces_in_one_place_do_not_count_for_the_picture(make, gap):
    """No float32 depth at 5 m tells 1e-9 m apart: any picture may show either, so it is no fault.

    But nobody knows whether the nearer one is there.
    """
    camera = make.camera(24, 18, clip_start=0.001, clip_end=1e4)
    scene = walls(make, camera, 5.0, gap, size=1)
    found = compared(scene, farther(scene))
    ties = found.counts.by_cause["depth_tie"]
    assert ties > 0.02 * found.counts.total
    assert bool(found.excused.advice) == found.excused.too_much == (gap == 1e-4)
    assert found.verdict == "warnings"
    (one,) = found.excused.objects
    assert (one.object, one.pixels, one.total) == (scene.objects[0], ties, ties)
    assert f"'{one.object}' was not judged: {ties} of the {ties} px" in "\n".join(describe(found))
    last = f"verdict: warnings: {ties} px at depth ties ('{one.object}' rests on rounding alone)"
    assert describe(found)[-1] == last  # once, not of the picture, too
    by_cause = {**found.counts.by_cause, "not_decidable": 5}
    found = replace(
        found,
        counts=replace(found.counts, by_cause=by_cause),
        excused=replace(found.excused, objects=(one, one, one)),
    )
    assert describe(found)[-1].endswith(
        f"5 px not decidable ('{one.object}' and 2 other objects rest on rounding alone)"
    )
    helps = "raise the clip start" if gap == 1e-4 else "leave one of them out"
    assert any(helps in line for line in describe(found))


def shown_with_its_objects(scene, of):
    """Compare a scene with what Blender shows of another, whose objects are known, too."""
    theirs = render(of)
    picture = Picture(theirs.color, WORKBENCH, owners_of(scene.objects, theirs))
    return result_of(trace_and_compare(case_of(scene, picture)))


def test_an_object_that_is_shown_in_place_of_another_was_not_judged(make):
    """A poster in a wall's own plane, less than 2 % of the picture: it may be there, or not."""

    def seen(nearer, x=0.0):
        wall = make.quad(-300, 300, -300, 300, -5, name="Wall")
        paper = make.quad(x - 0.3, x + 0.3, -0.2, 0.2, -5 + nearer, name="Poster")
        return make.scene(make.camera(96, 72), wall, paper)

    found = shown_with_its_objects(seen(0.0), seen(1e-6))
    assert found.counts.unexplained == 0
    assert [one.object for one in found.excused.objects] == ["Poster"]
    assert found.verdict == "warnings"
    assert found.to_dict()["excused"]["objects"][0]["object"] == "Poster"
    assert shown_with_its_objects(seen(0.0), seen(1e-6, x=0.4)).verdict == "differences"


def test_a_small_object_is_not_excused_whole(make):
    """A wall 10 cm before another, a kilometre away: 1 % of the picture, all of it a tie."""
    camera = make.camera(96, 72, clip_start=0.001, clip_end=1e4)
    near = make.quad(-60, 60, -40, 40, -900, name="Near")
    scene = make.scene(camera, near, make.quad(-600, 600, -600, 600, -900.1, name="Far"))
    found = compared(scene, farther(scene))
    assert 0 < found.excused.share <= 0.02 and found.counts.unexplained == 0
    assert [one.object for one in found.excused.objects] == ["Near"]
    (advice,) = found.excused.objects[0].advice
    start = float(re.search(r"raise the clip start from 0.001 m to (\S+) m", advice)[1])
    there = replace(scene, camera=replace(camera, clip_start=start))
    assert compared(there, there).verdict == "agree"
    assert compared(there, farther(there)).verdict == "differences"


def test_an_object_whose_edge_rests_on_rounding_was_judged(make):
    """A column of 72 px of it is excused, all others agree."""

    def seen(off):
        camera = make.camera(96, 72)
        pixel = 2 * camera.window.right / 96
        return make.scene(camera, make.quad(-9, pixel / 2 + off * pixel, -9, 9, -1))

    found = compared(seen(-0.001), seen(0.001))
    assert found.counts.by_cause["edge"] == 72
    assert found.excused.objects == () and found.verdict == "agree"


def test_a_few_pixels_are_no_warning(make):
    camera = make.camera(48, 36, clip_start=0.001, clip_end=1e4)
    scene = walls(make, camera, 900.0, 0.1, size=45)
    found = compared(scene, farther(scene))
    assert 0 < found.excused.share <= 0.02
    assert found.verdict == "agree" and not found.excused.advice
    assert not np.isnan(found.excused.share)


def test_an_advice_that_helps_several_is_said_once():
    both, own = "move the scene to the origin", "raise the clip start"
    objects = tuple(
        Unjudged(name, 60, 100, {EDGE: 60}, advice)
        for name, advice in (("A", (both,)), ("B", (both, own)), ("C", (own,)))
    )
    lines = list(Excused(180, 200, {EDGE: 180}, (both,), objects).lines())
    assert [sum(advice in line for line in lines) for advice in (both, own)] == [1, 1]
    assert len(lines) == 6 and own in lines[4]  # below the first that it helps

"""When the diagnosis ends, and what it says then."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.comparison.comparing import diagnosed, trace_and_compare
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.diagnosis.faults.fault import Guess, Numbers
from reference_tracer.diagnosis.guessing import Guessing, accounting
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import render
from reference_tracer.tracer.progress import result_of

from ..cases import case_of
from .diagnosing import BY_NAME, diagnosis_of, names, pictured, within


def test_nothing_is_done_where_nothing_is_unexplained(solids):
    def never():
        raise AssertionError("no variant is asked for")

    case = case_of(solids, Picture(render(solids).color), variants=never)
    found = result_of(trace_and_compare(case))
    assert result_of(diagnosed(found)) is found and found.diagnosis is None
    assert found.to_dict()["diagnosis"] is None


def _known_by(found):
    """Return a diagnosis as JSON has it, but for the seconds, which are a measurement."""
    out = found.diagnosis.to_dict()
    assert out.pop("seconds") >= 0
    return out


@pytest.mark.slow
def test_the_clock_changes_nothing_but_the_seconds(pair, monkeypatch):
    """It ends by steps of work: a machine a thousand times as slow gives the same answer."""
    before = result_of(trace_and_compare(case_of(pair, Picture(_salted(pair)), curves=())))
    calm = within(before, 200)
    clock = time.monotonic
    monkeypatch.setattr(time, "monotonic", lambda: 1000 * clock())
    hurried = within(before, 200)
    assert calm.diagnosis.untried and _known_by(calm) == _known_by(hurried)
    whole = result_of(diagnosed(before))
    assert whole.diagnosis.steps > 200 and not whole.diagnosis.untried
    assert not whole.to_dict()["diagnosis"]["ended"]


def _salted(scene):
    color = render(scene).color.copy()
    color[::3, ::5, :3] = (0.3, 0.9, 0.2)
    return color


@pytest.mark.parametrize("steps", [1, 20, 150])
def test_it_ends_inside_a_guess_and_says_what_was_not_looked_for(pair, steps):
    moved = pictured(pair, "pixel_offset", Numbers((2.4, 1.2)))
    before = result_of(trace_and_compare(case_of(pair, Picture(moved), curves=())))
    found = within(before, steps).diagnosis
    assert found.steps == steps and "pixel_offset" in found.untried
    said = [line for line in found.lines() if "a limit of work ended" in line]
    assert len(said) == 1 and " more)" in said[0]
    assert found.to_dict()["ended"] and found.to_dict()["untried"] == list(found.untried)


def test_in_each_round_a_fault_has_its_own_part_of_the_work(pair):
    """What was looked for in one round is looked for in the next, too."""

    def find(evidence):
        for _ in range(900):
            yield None
        return []

    found = result_of(trace_and_compare(case_of(pair, Picture(_salted(pair)), curves=())))
    evidence = Evidence(found.case, found.frame, found.causes)
    guessing = Guessing((replace(BY_NAME["mirrored_x"], find=find),), 3000)
    for number in (1, 2):
        assert result_of(accounting(guessing, evidence)) == []
        assert guessing.steps >= 900 * number and not guessing.untried


@pytest.mark.slow
def test_a_picture_without_the_scene_is_told_in_few_lines(pair):
    """What makes it so follows in one line: nothing tells one from the other."""
    color = np.broadcast_to(pair.background, (27, 48, 4)).copy()
    found = diagnosis_of(pair, color)
    first, *others = found.diagnosis.told
    assert first.fault.name == "nothing_shown" and not others
    assert len(first.also) >= 2
    lines = found.diagnosis.lines()
    assert lines[0] == "diagnosis: nothing of the scene is in the picture"
    assert len(lines) == 4
    one = replace(pair, instances=pair.instances[:1])
    assert "nothing_shown" not in names(diagnosis_of(pair, render(one).color))


@pytest.mark.torture
def test_each_fault_that_is_told_makes_more_pixels_agree(solids):
    """Two faults that only do together: of the first one, few pixels are lost."""
    frame = render(solids)
    first = BY_NAME["object_missing"].assume(case_of(solids, frame.color), Guess(object="Ball"))
    both = BY_NAME["pixel_offset"].assume(first, Numbers((0.5, 0.5)))
    found = diagnosis_of(solids, render(both.scene).color).diagnosis
    assert found.told
    for told in found.told:
        assert told.settled > told.broken and told.broken <= 0.1 * told.settled


@pytest.mark.torture
def test_a_saturation_is_no_resampling_and_no_fault_of_an_object(solids):
    """Each object has another colour, and all are off by a little: the picture was processed."""
    color = render(solids).color.copy()
    gray = color[..., :3].mean(axis=-1, keepdims=True)
    color[..., :3] = np.clip(gray + 1.25 * (color[..., :3] - gray), 0, 1)
    assert names(diagnosis_of(solids, color)) == ["processed"]

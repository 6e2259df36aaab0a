"""Nobody is blamed for rounding, however hard the scene; and the bounds excuse no fault."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.judged_scene import prepare
from reference_tracer_grading.picture import EXCUSED, Mark, look

from ..scenarios import quick
from .conftest import SIGNED_VOLUMES, plain

SOUND = Method.TEXTBOOK, Method.MOLLER_TRUMBORE, Method.WATERTIGHT


def signed_volumes(*rays):
    space = {}
    exec(SIGNED_VOLUMES, space)
    with np.errstate(all="ignore"):
        return space["intersect"](*rays)


def hard(scenarios):
    """Every scale of some scenarios, in a small picture."""
    return [
        (s.name, scale, result_of(prepare(s.name, s.build(scale, 12, 9), pixels=None)))
        for s in scenarios
        for scale in s.scales
    ]


def blamed(scenes):
    """Every picture of a sound method in which a pixel counts as wrong."""
    return [
        (name, scenario, scale, {k: n for k, n in found.counts.items() if n})
        for scenario, scale, judged in scenes
        for name, ask in {m: plain(m) for m in SOUND}.items() | {("volumes", signed_volumes)}
        for found in [result_of(look(judged, ask))]
        if not set(np.unique(found.mark)) <= {Mark.RIGHT, *EXCUSED}
    ]


@pytest.fixture(scope="module")
def scenes():
    return hard(quick())


def test_sound_methods_are_never_blamed(scenes):
    assert len(scenes) > 60
    assert blamed(scenes) == []
    ask = plain(Method.TEXTBOOK)  # and they do lose rays
    assert any(result_of(look(judged, ask)).lost for _, _, judged in scenes)


def test_the_literal_textbook_is_blamed(scenes):
    """The bounds leave enough of every harmless scene to tell."""
    literal = plain(Method.TEXTBOOK_LITERAL)
    harmless = {s.name: s.scales[0] for s in SCENARIOS}
    first = [(name, judged) for name, scale, judged in scenes if scale == harmless[name]]
    met = {"corners_and_edges", "far_corners", "closed_fan", "integer_cube", "integer_cube_ortho"}
    met |= {"needles"}
    for name, judged in first:
        if name in met:  # made of rays that meet edges and corners
            continue
        assert judged.boundary.mean() < 0.2, name
        tally = result_of(look(judged, literal)).tally
        assert tally.right["surface"] < 0.95 * tally.total, name
    assert len(first) > 15


@pytest.mark.torture
def test_sound_methods_are_never_blamed_at_all_scales():
    assert blamed(hard(SCENARIOS)) == []

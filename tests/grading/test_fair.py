"""Nobody is blamed for rounding, however hard the scene; and the bounds excuse no fault."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.methods import Method
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.tracer.progress import result_of
from reference_tracer_grading.extremes import extreme_scenes, plain
from reference_tracer_grading.picture import EXCUSED, Mark, look

from ..scenarios import quick
from .conftest import SIGNED_VOLUMES

SOUND = Method.TEXTBOOK, Method.MOLLER_TRUMBORE, Method.WATERTIGHT


def signed_volumes(*rays):
    space = {}
    exec(SIGNED_VOLUMES, space)
    with np.errstate(all="ignore"):
        return space["intersect"](*rays)


def blamed(scenes):
    """Every picture of a sound method in which a pixel counts as wrong."""
    return [
        (name, e.scenario.name, e.scale, {k: n for k, n in found.counts.items() if n})
        for e in scenes
        for name, ask in {m: plain(m) for m in SOUND}.items() | {("volumes", signed_volumes)}
        for found in [result_of(look(e.judged, ask))]
        if not set(np.unique(found.mark)) <= {Mark.RIGHT, *EXCUSED}
    ]


@pytest.fixture(scope="module")
def scenes():
    return result_of(extreme_scenes(quick()))


def test_sound_methods_are_never_blamed(scenes):
    assert len(scenes) > 60
    assert blamed(scenes) == []
    assert any(e.yardsticks["textbook"] for e in scenes)  # and they do lose rays


def test_the_literal_textbook_is_blamed(scenes):
    """The bounds leave enough of every harmless scene to tell."""
    literal = plain(Method.TEXTBOOK_LITERAL)
    harmless = {s.name: s.scales[0] for s in SCENARIOS}
    first = [e for e in scenes if e.scale == harmless.get(e.scenario.name)]
    met = {"corners_and_edges", "far_corners", "closed_fan", "integer_cube", "integer_cube_ortho"}
    met |= {"needles"}
    for e in first:
        if e.scenario.name in met:  # made of rays that meet edges and corners
            continue
        assert e.judged.boundary.mean() < 0.2, e.scenario.name
        tally = result_of(look(e.judged, literal)).tally
        assert tally.right["surface"] < 0.95 * tally.total, e.scenario.name
    assert len(first) > 15


@pytest.mark.torture
def test_sound_methods_are_never_blamed_at_all_scales():
    assert blamed(result_of(extreme_scenes(SCENARIOS))) == []

"""Textbook beside certified: what is listed, and what it is held against."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.certainty import Certainty
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.comparison.extras import extras
from reference_tracer.comparison.methods import list_methods
from reference_tracer.rendering import render
from reference_tracer.scene import Plane
from reference_tracer.tracer.progress import result_of
from reference_tracer.tracer.settings import Settings

from ..cases import case_of, rising


@pytest.fixture
def scene(make):
    solid = trimesh.creation.icosphere(2)
    matrix = trimesh.transformations.translation_matrix((0.1, 0.05, -3))
    return make.scene(make.camera(64, 48), make.mesh(solid, matrix), make.quad(-9, 9, -9, 9, -5))


def listed(scene, *settings):
    settings = Settings(*settings)
    frame = render(scene, settings)
    _, (rows, _) = rising(list_methods(scene, settings, frame))
    return {(r.method, r.precision): r for r in rows}, frame


BOTH = [("certified", "float64"), ("textbook", "float64")]


@pytest.mark.parametrize(
    "settings, names",
    [
        (("auto",), BOTH),
        (("certified",), BOTH),
        (("textbook",), BOTH),
        (("textbook", "float32"), [*BOTH, ("textbook", "float32")]),
        (("textbook_literal", "float64", 2), [*BOTH, ("textbook_literal", "float64")]),
    ],
)
def test_certified_and_the_textbook_are_always_there(scene, settings, names):
    rows, frame = listed(scene, *settings)
    assert list(rows) == names
    truth = render(scene, Settings("certified"))
    ambiguous = int((truth.certainty == Certainty.AMBIGUOUS).sum())
    for (method, precision), row in rows.items():
        again = render(scene, Settings(method, precision))
        assert row.wrong_pixels == int(again.wrong_against(truth).sum())
        assert row.ambiguous == ambiguous and row.seconds > 0
    assert rows[BOTH[0]].wrong_pixels == 0 and rows[BOTH[0]].required
    own = rows[frame.statistics.method, settings[1] if len(settings) > 1 else "float64"]
    assert own.seconds == frame.statistics.seconds
    assert own.samples == (settings[2] if len(settings) > 2 else 1)
    json.dumps([r.to_dict() for r in rows.values()], allow_nan=False)


@pytest.mark.parametrize("background", [(0, 0, 0, 0), (1, 1, 1, 1)])
def test_the_literal_picture_is_the_same_as_traced_alone(make, rng, background):
    """It takes the pairs of the textbook's trace, and lies on the picture's own background."""
    room = make.room()
    ball, *others = room.meshes
    ball = replace(ball, corner_colors=rng.random((len(ball.triangles), 3, 4)))
    plane = Plane(0, np.array([0.0, 0, -2]), np.array([0.0, 0.3, 1]), np.array([0, 0, 1, 1.0]))
    scene = replace(room, meshes=(ball, *others), planes=(plane,))
    shown = render(replace(scene, background=np.float32(background))).color
    case = case_of(scene, shown.astype(np.float32), curves=())
    found = result_of(trace_and_compare(case, literally=True))
    assert (found.background is None) == (background == (0, 0, 0, 0))
    alone = render(found.scene, Settings("textbook_literal")).color
    assert np.array_equal(result_of(extras(found)).literal, alone)
    assert (alone != shown).any() and (shown[..., 3] == background[3]).any()
    assert result_of(trace_and_compare(case)).literal is None

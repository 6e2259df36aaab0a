"""Instances that are left out, and what looks as if they were."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.diagnosis.faults.pose import Posed
from reference_tracer.rendering import render
from reference_tracer.scene import Instance

from .diagnosing import pictured, told

pytestmark = pytest.mark.slow
LOOKED_FOR = "instances_missing", "object_missing", "object_moved", "depth_order"


@pytest.fixture
def scattered(few):
    """Return solids of which the ball is there four times."""
    scene = few()
    ball = next(i for i in scene.instances if scene.objects[i.object] == "Ball")
    more = []
    for place in ((-2.0, 1.5, 0.0), (-0.5, -2.4, -0.3), (2.6, -0.4, 0.0)):
        matrix = ball.world_from_object.copy()
        matrix[:3, 3] = place
        more.append(Instance(ball.mesh, ball.object, matrix, ball.colors))
    return replace(scene, instances=(*scene.instances, *more))


def without(scene, some):
    left = (i for n, i in enumerate(scene.instances) if n not in some)
    return render(replace(scene, instances=tuple(left))).color


def test_instances_of_one_object_that_stays_are_missing(scattered):
    found = told(scattered, without(scattered, (5, 6, 7)), *LOOKED_FOR)
    assert set(found) == {"instances_missing"}
    assert "'Ball' (3)" in found["instances_missing"].sentence


def test_several_objects_are_missing_at_once(scattered):
    found = told(scattered, without(scattered, (1, 4)), *LOOKED_FOR)
    assert set(found) == {"instances_missing"}
    assert all(f"'{name}'" in found["instances_missing"].sentence for name in ("Box", "Drum"))


def test_one_object_is_no_several(scattered):
    assert set(told(scattered, without(scattered, (1,)), *LOOKED_FOR)) == {"object_missing"}


def test_what_is_shown_elsewhere_is_not_missing(scattered):
    """The boxes' and the drum's own pixels show what is behind them in both pictures."""
    color = pictured(scattered, "object_moved", Posed((1.5, 0.3, 0.4), object="Box"))
    gone = without(scattered, (4,))
    there = render(scattered).color
    color = np.where((gone != there).any(axis=-1, keepdims=True), gone, color)
    assert "instances_missing" not in told(scattered, color, "instances_missing")


def test_what_fills_the_background_is_not_missing(few):
    """A box a hundred times as large: its colour is no other background, once it is left out."""
    scene = few()
    box = scene.instances[1]
    larger = replace(box, world_from_object=box.world_from_object @ np.diag((1.6, 1.6, 1.6, 1.0)))
    scene = replace(scene, instances=(scene.instances[0], larger, *scene.instances[2:]))
    color, nothing = without(scene, (1,)), render(scene).object_index < 0
    color[nothing] = box.colors[0]
    assert "object_missing" not in told(scene, color, "object_missing")

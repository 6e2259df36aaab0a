"""Every scenario is a scene that can be traced, and is what it says."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from reference_tracer.scene import Scene
from reference_tracer.study.scenarios import scenes
from reference_tracer.study.scenarios.sweeps import SCENARIOS
from reference_tracer.study.truth import pixel_rays
from reference_tracer.tracer.settings import Precision


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda s: s.name)
def test_every_scale_is_a_scene(scenario):
    """Without a warning: what overflows on purpose does so in the tracer."""
    assert len(scenario.scales) == len(set(scenario.scales)) >= 4
    for scale in scenario.scales:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            scene = scenario.build(scale, scenario.width, scenario.height)
        assert isinstance(scene, Scene)
        assert (scene.camera.width, scene.camera.height) == (scenario.width, scenario.height)
        assert 6 <= scene.triangle_count < 2000
        rays = pixel_rays(scene.camera, Precision.FLOAT64)
        assert np.isfinite(rays.origins).all() and np.isfinite(rays.directions).all()


@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda s: s.name)
@pytest.mark.parametrize("size", [(1, 1), (7, 5)])
def test_other_sizes_of_the_picture(scenario, size):
    assert scenario.build(scenario.scales[1], *size).camera.height == size[1]


def test_words():
    names = [s.name for s in SCENARIOS]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[a-z0-9]+(_[a-z0-9]+)*", name) for name in names)
    for thing in SCENARIOS:
        assert thing.title and thing.explanation.endswith(".") and "\n" not in thing.explanation
        assert len(thing.explanation) < 120


def test_the_same_each_time():
    for scenario in SCENARIOS:
        one, two = (scenario.build(scenario.scales[1], 8, 6) for _ in range(2))
        for a, b in zip(one.meshes, two.meshes, strict=True):
            assert np.array_equal(a.vertices, b.vertices)
            assert np.array_equal(a.triangles, b.triangles)


def test_the_second_plane_is_nearer():
    scene = scenes.close_planes(2.0**30, 8, 6)
    far, near = (mesh.vertices @ scene.camera.forward for mesh in scene.meshes)
    assert np.allclose(far - near, 5 * 2.0**-22, rtol=1e-6)

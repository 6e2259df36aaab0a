"""What an engine draws no triangle of, as it reaches too far, proves nothing; all else does."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.causes.embree import not_decidable
from reference_tracer.comparison.comparing import trace_and_compare
from reference_tracer.pictures.picture import Picture
from reference_tracer.pictures.sampling import Sampling
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh
from reference_tracer.tracer.progress import result_of

from ..cases import case_of

LIMIT = 1e6


def scene_of(make, far, matrix=None):
    """Return a square before a wall of two triangles, whose right one reaches that far."""
    front = make.scene(make.camera(48, 32), make.quad(-1.5, -0.2, -1, 0.8, -3))
    corners = [(-9, -9, -6), (9, -9, -6), (-9, 9, -6), (far, 9, -6)]
    wall = Mesh(np.array(corners, np.float64), np.array([(0, 1, 2), (1, 3, 2)]))
    color = np.array([(0.9, 0.4, 0.1, 1)], np.float32)
    matrix = np.eye(4) if matrix is None else matrix
    behind = Instance(len(front.meshes), len(front.objects), matrix, color)
    return replace(
        front,
        meshes=(*front.meshes, wall),
        instances=(*front.instances, behind),
        objects=(*front.objects, "Wall"),
    )


def compared(scene, color, farthest):
    picture = Picture(color, sampling=Sampling(farthest=farthest))
    return result_of(trace_and_compare(case_of(scene, picture)))


def without_the_right_triangle(scene):
    wall = replace(scene.meshes[-1], triangles=scene.meshes[-1].triangles[:1], slots=None)
    return replace(scene, meshes=(*scene.meshes[:-1], wall))


def test_a_triangle_beyond_is_not_decidable(make):
    scene = scene_of(make, 2 * LIMIT)
    frame = render(scene)
    right = (frame.instance_index == 1) & (frame.triangle_index == 1)
    assert 0 < right.sum() < right.size
    np.testing.assert_array_equal(not_decidable(scene, frame, LIMIT), right)
    shown = render(without_the_right_triangle(scene)).color
    found = compared(scene, shown, LIMIT)
    assert found.counts.unexplained == 0
    assert found.counts.not_decidable == right.sum()
    assert found.verdict == "warnings"


@pytest.mark.parametrize("far", [0.5 * LIMIT, 9.0])
def test_a_triangle_within_is_missed(make, far):
    """The same picture, of a triangle that an engine does draw."""
    scene = scene_of(make, far)
    shown = render(without_the_right_triangle(scene)).color
    found = compared(scene, shown, LIMIT)
    assert found.counts.not_decidable == 0
    assert found.counts.unexplained > 20


def test_what_is_wrong_beside_it_is_found(make):
    scene = scene_of(make, 2 * LIMIT)
    front = replace(scene, instances=scene.instances[1:])
    found = compared(scene, render(front).color, LIMIT)
    undrawn = not_decidable(scene, render(scene), LIMIT)
    assert found.counts.unexplained > 20
    assert not (found.causes.cause[undrawn] == 5).any()


def test_an_engine_may_keep_triangles_in_either_space(make):
    """A scale takes the corner back into the world's range, or out of it."""
    down = np.diag([1e-3, 1, 1, 1])
    for scene in (
        scene_of(make, 2 * LIMIT, down),
        scene_of(make, LIMIT / 500, np.diag([1e3, 1, 1, 1])),
    ):
        frame = render(scene)
        right = (frame.instance_index == 1) & (frame.triangle_index == 1)
        np.testing.assert_array_equal(not_decidable(scene, frame, LIMIT), right)

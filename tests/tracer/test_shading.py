"""Constant shading, and what else is said of a hit."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.rendering import render
from reference_tracer.scene import Instance, Mesh, Plane, Scene
from reference_tracer.tracer import shading
from reference_tracer.tracer.hits import NOTHING, Hits

RED, GREEN, BLUE = ([1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1])
NEAR = {"rtol": 0, "atol": 1e-6}


def hits(instance, triangle, t=1.0, s=(1, 0, 0)):
    count = len(instance)
    return Hits.of(
        np.where(np.array(instance) == NOTHING, np.inf, t),
        np.array(instance, np.int32),
        np.array(triangle, np.int32),
        np.tile(np.array(s, float)[:, None], count),
    )


@pytest.fixture
def scene(make):
    """Return three triangles with slots 0, 1, 5; a copy of them with one colour; a plane."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    mesh = Mesh(points, [[0, 1, 2], [0, 2, 3], [0, 3, 1]], [0, 1, 5])
    return Scene(
        make.camera(),
        (mesh,),
        (Instance(0, 2, np.eye(4), [RED, GREEN, BLUE]), Instance(0, 0, np.eye(4), [GREEN])),
        (Plane(1, (0, 0, 0), (0, 3, 4), [0.25, 0.5, 0.75, 1]),),
        np.array([0.1, 0.2, 0.3, 0.4]),
        ("a", "b", "c"),
    )


def test_colour_is_that_of_the_slot(scene):
    """A slot past the end shows the last one."""
    seen = shading.colors(
        scene, hits([0, 0, 0, 1, 1, 2, NOTHING], [0, 1, 2, 0, 2, NOTHING, NOTHING])
    )
    expected = [RED, GREEN, BLUE, GREEN, GREEN, [0.25, 0.5, 0.75, 1], [0.1, 0.2, 0.3, 0.4]]
    assert seen.dtype == np.float32
    assert np.allclose(seen, expected, **NEAR)


def test_surfaces_are_opaque(scene):
    clear = replace(scene, instances=[replace(scene.instances[0], colors=[[1, 0.5, 0.25, 0.1]])])
    assert np.allclose(shading.colors(clear, hits([0], [0])), [[1, 0.5, 0.25, 1]], **NEAR)


def test_corner_colours_are_interpolated_in_the_order_of_the_corners(scene):
    colors = np.array([[RED, GREEN, BLUE]] * 3, np.float32)
    mesh = replace(scene.meshes[0], corner_colors=colors)
    seen = shading.colors(replace(scene, meshes=(mesh,)), hits([0], [1], s=(0.5, 0.3, 0.2)))
    assert np.allclose(seen, [[0.5, 0.3, 0.2, 1]], **NEAR)


@pytest.mark.parametrize("method", ["textbook", "moller_trumbore"])
def test_a_triangle_with_three_colours(make, method):
    """Each corner of the picture shows its own corner's colour."""
    mesh = Mesh(
        [(-1, -1, -1), (1, -1, -1), (-1, 1, -1)], [[0, 1, 2]], corner_colors=[[RED, GREEN, BLUE]]
    )
    frame = render(make.scene(make.camera(40, 40, half=1), mesh))
    for (y, x), channel in {(0, 0): 0, (0, 38): 1, (38, 0): 2}.items():
        assert frame.color[y, x, channel] > 0.9
        assert frame.color[y, x, :3].sum() == pytest.approx(1, abs=1e-6)
    hit = frame.object_index == 0
    assert np.allclose(frame.color[hit][:, :3], frame.barycentrics[hit], **NEAR)


@pytest.mark.parametrize("scale", [1e-30, 1e-6, 1, 1e6, 1e30])
def test_normals_stand_on_their_triangles(scene, scale, rng):
    matrix = np.eye(4)
    matrix[:3] = np.column_stack((scale * rng.normal(size=(3, 3)), scale * rng.normal(size=3)))
    turned = replace(scene, instances=[replace(scene.instances[0], world_from_object=matrix)])
    seen = shading.normals(turned, hits([0, 0, 0], [0, 1, 2]))
    mesh = scene.meshes[0]
    corners = mesh.vertices[mesh.triangles] @ (matrix[:3, :3].T / scale)
    assert np.allclose(np.linalg.norm(seen, axis=1), 1, rtol=0, atol=1e-12)
    for k in (1, 2):
        along = ((corners[:, k] - corners[:, 0]) * seen).sum(axis=1)
        assert np.allclose(along, 0, rtol=0, atol=1e-12)


def test_a_scene_without_anything_has_no_objects(make):
    empty = make.scene(make.camera())
    assert empty.instance_objects[hits([NOTHING], [NOTHING]).instance].tolist() == [NOTHING]
    assert shading.colors(empty, hits([NOTHING], [NOTHING])).tolist() == [[0, 0, 0, 0]]

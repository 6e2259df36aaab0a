"""Single rays see through trees of boxes what they see of a whole picture."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from reference_tracer.causes.checks.probe import SOUND
from reference_tracer.diagnosis.evidence import shows_colors
from reference_tracer.diagnosis.seen import Trees
from reference_tracer.pictures.picture import Picture
from reference_tracer.rendering import trace
from reference_tracer.scene import Instance, Mesh, Plane
from reference_tracer.tracer.camera import camera_rays, film_positions
from reference_tracer.tracer.progress import result_of

SEED = 4


@pytest.fixture
def crowd(make):
    """Return many small instances, a large mesh, one that is flat, one without a triangle."""
    rng = np.random.default_rng(SEED)
    camera = make.camera(64, 36, half=0.4, eye=(5, -6, 4), target=(0, 0, 0))
    ball, cube = trimesh.creation.icosphere(4), trimesh.creation.box((0.3, 0.2, 0.4))
    meshes = [Mesh(s.vertices, s.faces) for s in (ball, cube)]
    meshes.append(Mesh(np.zeros((0, 3)), np.zeros((0, 3), int)))
    instances = [Instance(0, 0, np.eye(4), [(0.5, 0.5, 0.5, 1)])]
    instances.append(Instance(0, 0, np.diag((2.5, 0.0, 1.5, 1.0)), [(0.5, 0.5, 0.5, 1)]))
    instances.append(Instance(2, 0, np.eye(4), [(0.5, 0.5, 0.5, 1)]))
    overflows = 1.7e308 * np.array(((1, 1, 0, 0), (0, 1, 1, 0), (1, 0, 1, 0), (0, 0, 0, 0)))
    overflows[3, 3] = 1  # its box is infinite, and it is nowhere to be seen
    instances.append(Instance(0, 0, overflows, [(0.5, 0.5, 0.5, 1)]))
    for _ in range(200):
        matrix = trimesh.transformations.random_rotation_matrix(rng.random(3))
        matrix[:3, 3] = rng.uniform(-2, 2, 3)
        instances.append(Instance(1, 0, matrix, [(0.5, 0.5, 0.5, 1)]))
    scene = make.scene(camera, *meshes)
    return replace(scene, instances=tuple(instances), objects=("All",))


@pytest.mark.parametrize("kind", ["many", "plane", "nothing"])
def test_the_same_is_seen_as_in_a_whole_picture(crowd, kind):
    scene, trees = crowd, Trees()
    if kind == "plane":
        plane = Plane(0, np.array((0, 0, -1.0)), np.array((0, 0, 1.0)))
        scene = replace(scene, planes=(plane,))
    if kind == "nothing":
        scene = replace(scene, instances=())
    moved = replace(scene, instances=scene.instances[::-1])
    for one in (scene, moved, scene):  # the trees are those of the last scene
        rays = camera_rays(one.camera, *film_positions(one.camera.region))
        own, all_ = result_of(trees.trace(one, rays)), trace(one, SOUND)
        np.testing.assert_array_equal(own.instance, all_.instance)
        np.testing.assert_array_equal(own.triangle, all_.triangle)
        np.testing.assert_array_equal(own.t, all_.t)
    assert kind == "nothing" or (own.instance >= 0).mean() > 0.1


def test_a_color_that_thousands_of_instances_have_is_looked_for_once():
    rng = np.random.default_rng(SEED)
    picture = Picture(np.round(rng.random((90, 160, 4)), 1).astype(np.float32))
    colors = picture.color[:3, 0]
    began = time.process_time()
    many = shows_colors(picture, np.tile(colors, (9000, 1)))
    assert time.process_time() - began < 3  # seconds; one by one, they take ten times as long
    assert 0 < many.sum() < many.size
    np.testing.assert_array_equal(many, shows_colors(picture, colors))

"""Many cameras are judged together: what all have is said once, and another world is named."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.scene import Camera, ViewWindow
from reference_tracer_cameras.trajectory import Similarity, trajectory_difference

from .test_difference import (
    half_pixel,
    inverse_of_opencv,
    longer,
    opencv_for_opengl,
    place_for_t,
    transposed_in_opencv,
)

COUNT = 12
NAMES = [f"{n:04d}.png" for n in range(COUNT)]


def rotation(angle, axis):
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


@pytest.fixture
def path():
    """A camera that goes round, and looks about."""
    rng = np.random.default_rng(4)
    window = ViewWindow(-0.4, 0.4, -0.225, 0.225)
    cameras = []
    for _ in range(COUNT):
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(rng.uniform(0, 3), rng.normal(size=3))
        matrix[:3, 3] = rng.normal(size=3) * 4
        cameras.append(Camera(matrix, window, 640, 360, clip_start=0.5, clip_end=40))
    return cameras


def turntable(count=8):
    """Cameras around the origin: the first looks along an axis."""
    cameras = []
    for k in range(count):
        angle = 2 * np.pi * k / count
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(angle, (0, 0, 1)) @ [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
        matrix[:3, 3] = matrix[:3, 2] * 5
        window = ViewWindow(-0.4, 0.4, -0.225, 0.225)
        cameras.append(Camera(matrix, window, 640, 360, clip_start=0.5, clip_end=40))
    return cameras


@pytest.mark.parametrize(
    ("mistake", "name"),
    [
        (half_pixel, "pixel_offset"),
        (place_for_t, "place_for_translation"),
    ],
)
def test_a_turntable_hides_no_mistake(mistake, name):
    own = turntable()
    found = trajectory_difference(NAMES[: len(own)], own, [mistake(camera) for camera in own])
    assert [step.fault.name for step in found.steps] == [name]
    assert not any(line.endswith("world is ") for line in found.lines())


def in_world(camera, turn, scale, move):
    matrix = camera.world_from_camera.copy()
    matrix[:3, :3] = turn @ matrix[:3, :3]
    matrix[:3, 3] = scale * turn @ matrix[:3, 3] + move
    return replace(camera, world_from_camera=matrix)


def judged(path, others):
    return trajectory_difference(NAMES, path, others)


def test_the_same_cameras_agree(path):
    found = judged(path, path)
    assert found.agrees and found.lines() == ["12 cameras agree: points lie at most 0 px apart"]


@pytest.mark.parametrize("mistake", [inverse_of_opencv, transposed_in_opencv, longer])
def test_what_all_have_is_said_once(mistake, path):
    found = judged(path, [mistake(camera) for camera in path])
    names = {inverse_of_opencv: "matrix_inverted", longer: "focal_length"}
    assert [s.fault.name for s in found.steps] == [names.get(mistake, "matrix_transposed")]
    assert found.world is None and len(found.lines()) == 4
    assert found.lines()[0].startswith("12 of 12 cameras differ, ")


@pytest.mark.parametrize(
    ("before", "name"),
    [(lambda c: c, []), (longer, ["focal_length"]), (opencv_for_opengl, ["forward"])],
)
def test_another_world_has_its_numbers(before, name, path):
    turn = rotation(0.7, (1, 2, -1))
    others = [in_world(before(camera), turn, 0.25, (1.0, -2.0, 0.5)) for camera in path]
    found = judged(path, others)
    assert [step.fault.name for step in found.steps] == name
    world = found.world
    assert np.allclose(world.rotation, turn) and world.scale == pytest.approx(0.25)
    assert np.allclose(world.move, (1, -2, 0.5))
    (line,) = [line for line in found.lines() if line.startswith("the cameras' world is")]
    assert "turned by 40.11 degrees about (0.4082, 0.8165, -0.4082)" in line
    assert line.endswith("scaled by 0.25, moved by (1, -2, 0.5)")
    assert len(found.lines()) <= 6


def test_a_camera_that_is_elsewhere_alone_is_no_other_world(path):
    """Also where all others are of one: the world is said of all, or of none."""
    moved = in_world(path[5], np.eye(3), 1.0, (0.1, 0, 0))
    found = judged(path, [*path[:5], moved, *path[6:]])
    assert found.world is None and found.lines()[0].startswith("1 of 12 cameras differ, 0005.png")
    assert [step.fault.name for step in found.steps] == ["camera_moved"]
    turn = rotation(0.7, (1, 2, -1))
    others = [in_world(camera, turn, 0.25, (1, 2, 3)) for camera in path]
    others[5] = in_world(others[5], np.eye(3), 1.0, (0.1, 0, 0))
    assert judged(path, others).world is None


def test_cameras_that_differ_each_in_their_own_way_have_nothing_in_common(path):
    rng = np.random.default_rng(1)
    others = [in_world(c, rotation(0.01, rng.normal(size=3)), 1, (0, 0, 0)) for c in path]
    found = judged(path, others)
    assert not found.steps and found.world is None
    assert any(line.startswith("no fault is common to all; of ") for line in found.lines())


def test_places_that_are_one_say_no_scale(path):
    there = [in_world(c, np.eye(3), 0.0, np.ones(3)) for c in path]
    assert Similarity.between(there, there).scale == 1

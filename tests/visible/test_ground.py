"""Planes, and what stands on them or sticks out: as much is seen of it as the oracle has."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.scene import (
    Plane,
    Region,
    ViewWindow,
)
from reference_tracer_visible import HIDDEN, SEEN, UNDECIDED

from .scenes import GREY, ORTHOGRAPHIC, PERSPECTIVE, camera, judged, scene_of, triangles


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_border_shift_and_planes(projection):
    """What is beside the region counts no more than what a plane hides."""
    random = np.random.default_rng(5)
    points = random.integers(-8, 9, (24, 3, 3)) / 4
    points[..., 2] = np.minimum(points[..., 2], 2)
    plane = Plane(0, np.array([0.0, 0.0, -0.25]), np.array([0.0, 0.25, 1.0]), GREY[0])
    half = 0.5 if projection is PERSPECTIVE else 2.0
    window = ViewWindow(-half, half, -half, half).moved(0.25, -0.125)
    own = camera(projection, window=window, region=Region(3, 5, 9, 14))
    found = judged(scene_of(triangles(points), camera=own, planes=(plane,)))
    assert (found.seen == SEEN).any() and (found.seen == HIDDEN).any()


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("seed", [31, 83, 111])
def test_what_two_planes_leave_at_the_edge_of_a_long_face(projection, seed):
    """A tip as thin as the rounding of where the first plane cuts the face's edge."""
    random = np.random.default_rng(seed)
    angle = random.uniform(0, 2 * np.pi)
    along = np.array([np.cos(angle), np.sin(angle), 0])
    across = np.array([-np.sin(angle), np.cos(angle), 0])
    up = np.array([0, 0, 1])
    first = Plane(0, np.zeros(3), up + along, GREY[0])
    second = Plane(0, across * random.uniform(0, 1e-10), up - across, GREY[0])
    face = triangles([along * -6e5, along * 6e5, across * 0.2])
    judged(scene_of(face, camera=camera(projection), planes=(first, second)))


def test_a_plane_whose_normal_is_very_long_or_short():
    """What over- or underflows says nothing of what is behind the plane."""
    far = 2.0**25
    face = [(far, 0.001, 1 - far), (far, 0.002, 1 - far), (-far, 0.001, 1 + far)]
    plane = Plane(0, np.zeros(3), np.array([1, 0, 1]) * 2.0**1000, GREY[0])
    judged(scene_of(triangles(face), camera=camera(ORTHOGRAPHIC), planes=(plane,)))
    random = np.random.default_rng(1286)
    normal = np.array((*random.normal(0, 0.3, 2), 1)) * 2.0**-525
    plane = Plane(0, np.zeros(3), normal * 2.0**-525, GREY[0])
    x, y = random.normal(0, 0.3, (3, 2)).T * [[1], [0.01]]
    slope = plane.normal * 2.0**600 * 2.0**450
    above = -(x * slope[0] + y * slope[1]) / slope[2] + 2.0**-26 * random.random()
    face = np.stack((x, y, above), axis=1)
    judged(scene_of(triangles(face), camera=camera(ORTHOGRAPHIC), planes=(plane,)))


@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("flat", ["plane", "face"])
def test_what_sticks_out_of_the_ground_by_a_rounding_is_hardly_seen(projection, flat):
    """A strip that few rays meet has a witness; a tip that none meets may show next to nothing."""
    turns = np.linspace(0, 2 * np.pi, 9)[:-1]
    ring = np.stack((np.cos(turns), np.sin(turns), np.full(8, 2.0**-53)), axis=1)
    points = np.concatenate((ring, ring * (0.5, 0.5, 0) - (0, 0, 0.5)))
    bands = [t for k in range(8) for n in [(k + 1) % 8] for t in ((k, n, k + 8), (n, n + 8, k + 8))]
    plane = Plane(0, np.zeros(3), np.array([0.0, 0.0, 1.0]), GREY[0])
    tilt = np.array([[1, 0, 0], [0, 0.28, -0.96], [0, 0.96, 0.28]])
    own = camera(projection, at=4 * tilt[:, 2], axes=tilt)
    found = judged(scene_of((points, bands), camera=own, planes=(plane,)))
    assert (found.area < 1e-6).all()
    assert (found.seen[::2] == SEEN).sum() > 5 and (found.seen[1::2] == UNDECIDED).any()


@pytest.mark.parametrize("height", [1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("projection", [PERSPECTIVE, ORTHOGRAPHIC])
def test_an_edge_just_above_the_ground_is_seen(projection, height):
    """Most of the face is below, so that rays through its middle see the ground."""
    tilt = np.array([[1, 0, 0], [0, 0.28, -0.96], [0, 0.96, 0.28]])
    face = [(0, 0, -1), (0.25, -0.5, height), (-0.25, 0.5, height)]
    ground = [(-5, -5, 0), (15, -5, 0), (-5, 15, 0)]
    own = camera(projection, at=4 * tilt[:, 2], axes=tilt)
    found = judged(scene_of(triangles([face, ground]), camera=own))
    assert found.seen.tolist() == [SEEN, SEEN]

"""Which points lie in closed meshes, as fractions say; what is not closed is refused by name."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer import SceneError, inside
from reference_tracer.scene import Instance, Mesh, Plane, Scene

from .oracle import place
from .test_every import SCALES, box, hostile, scene_of, unit_cube


@pytest.mark.parametrize("scale", SCALES, ids=str)
def test_as_fractions_say(scale, make):
    """Of a lattice's points, on its corners, edges and faces too, and between them."""
    seen = set()
    for seed in range(2):
        rng = np.random.default_rng(seed)
        vertices, faces = hostile(rng)
        vertices = vertices * scale
        points = np.concatenate((rng.integers(-3, 4, (12, 3)), rng.integers(-5, 6, (12, 3)) / 2))
        points = np.concatenate((points * scale, vertices[:3]))
        found = inside(scene_of(make, vertices, faces), points)
        for k, point in enumerate(points):
            where, winding = place(point, vertices[faces])
            assert found.place[k] == where, (seed, point)
            assert where == 2 or found.winding[k] == winding
            seen.add((where, winding))
    assert {(2, 0), (0, 0), (1, 1)} <= seen


def test_meshes_that_overlap_or_are_turned(make):
    """Points in the first alone, in both, in the second alone, in none, on the second's face."""
    moved = np.eye(4)
    moved[0, 3] = 0.5
    points = [(-0.25, 0, 0), (0.25, 0.1, 0.1), (0.75, 0, 0), (2, 0, 0), (1, 0.1, 0.2)]
    found = inside(unit_cube(make, np.eye(4), moved), points)
    assert found.place.tolist() == [1, 1, 1, 0, 2]
    assert found.winding[:4].tolist() == [1, 2, 1, 0]
    vertices, faces = box()
    assert inside(scene_of(make, vertices, faces[:, ::-1]), (0, 0, 0)).winding.tolist() == [-1]
    both = np.concatenate((vertices, vertices + moved[:3, 3]))
    joined = scene_of(make, both, np.concatenate((faces, faces + 8)))
    found = inside(joined, points)  # one mesh that overlaps itself: parity says outside
    assert found.place.tolist() == [1, 0, 1, 0, 2] and found.winding[1] == 2
    mirror = np.diag([-1.0, 1, 1, 1])
    assert inside(unit_cube(make, mirror), (0, 0, 0)).winding.tolist() == [1]


def test_wherever_the_surface_is_met(make):
    """At the corners of a ball that is not on a lattice, and just beside."""
    ball = trimesh.creation.icosphere(2)
    scene = scene_of(make, ball.vertices, ball.faces)
    for by, where in ((1 - 2.0**-50, 1), (1.0, 2), (1 + 2.0**-50, 0)):
        assert (inside(scene, ball.vertices * by).place == where).all()
    assert len(inside(scene, np.zeros((0, 3))).place) == 0


def test_what_has_no_inside_is_refused_by_name(make):
    vertices, faces = box(2.0)
    doubled = np.diag([2.0, 2.0, 2.0, 1.0])
    with pytest.raises(SceneError, match=r"'Shape' has a boundary of 13\.6569 m and 3 more$"):
        inside(scene_of(make, vertices, faces[1:], *[doubled] * 12), (0, 0, 0))
    with pytest.raises(SceneError, match=r"'Shape' has a boundary"):  # a face twice is one too many
        inside(scene_of(make, vertices, np.concatenate((faces, faces[:1]))), (0, 0, 0))
    cube = scene_of(make, vertices, faces)
    planes = (Plane(0, (0, 0, 0), (0, 0, 1)),)
    with pytest.raises(SceneError, match="'Shape' is an infinite plane"):
        inside(
            Scene(cube.camera, cube.meshes, cube.instances, planes, objects=("Shape",)), (0, 0, 0)
        )
    far = Instance(0, 0, np.diag([1e300, 1, 1, 1]))
    with pytest.raises(SceneError, match="corners that are not finite"):
        inside(
            Scene(cube.camera, (Mesh(vertices * 1e10, faces),), (far,), objects=("Shape",)),
            (0, 0, 0),
        )
    for points in ((0, 0), [(0, 0, np.nan)], "here"):
        with pytest.raises((SceneError, ValueError)):
            inside(cube, points)


def test_corners_in_one_place_are_one(make):
    """Also if each face has its own, and they come together in the world alone."""
    vertices, faces = box()
    apart = vertices[faces].reshape(-1, 3) + 0.5
    apart += np.where(apart == 0, 1e-30 * np.arange(36)[:, None], 0)
    moved = np.eye(4)
    moved[:3, 3] = 1
    scene = scene_of(make, apart, np.arange(36).reshape(-1, 3), moved)
    assert inside(scene, [(1.5, 1.5, 1.5), (2.5, 1.5, 1.5)]).place.tolist() == [1, 0]


def test_faces_turned_against_one_another_have_parity_alone(make):
    vertices, faces = box()
    faces[3] = faces[3, ::-1]
    found = inside(scene_of(make, vertices, faces), [(0, 0, 0), (1, 0, 0)])
    assert found.place.tolist() == [1, 0] and found.winding is None

"""The shapes of a ray: where the numbers say."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.derivation.derivation import derive
from reference_tracer.derivation.figure import shapes


@pytest.mark.parametrize("pixel", [(12, 9), (3, 2), (0, 17), (16, 13)])
def test_shapes_are_meshes(ball_scene, pixel):
    for shape in shapes(derive(ball_scene, *pixel)):
        assert np.isfinite(shape.vertices).all() and (shape.edges or shape.faces)
        used = {k for part in (*shape.edges, *shape.faces) for k in part}
        assert used <= set(range(len(shape.vertices)))
        assert all(len(set(face)) == len(face) >= 3 for face in shape.faces)


def area(points):
    a, b, c = points
    return np.linalg.norm(np.cross(b - a, c - a))


def test_the_weights_are_the_shares_of_the_area(ball_scene):
    found = derive(ball_scene, 12, 9)
    weights = [s for s in shapes(found) if s.name.startswith("s")]
    areas = np.array([area(s.vertices) for s in weights])
    np.testing.assert_allclose(areas / areas.sum(), found.certified.s, rtol=1e-4, atol=1e-6)
    x = found.pixel.origin + found.certified.t * found.pixel.direction
    hit = next(s for s in shapes(found) if s.name == "Hit")
    np.testing.assert_allclose(hit.vertices.mean(axis=0), x, rtol=1e-9)


def test_pieces_lie_in_their_planes_and_hold_x(ball_scene):
    found = derive(ball_scene, 12, 9)
    pieces = {s.name.split()[0]: s for s in shapes(found) if " plane of " in s.name}
    assert len(pieces) >= len(found.tests) - 1  # one that the ray meets far away may be left out
    o, d = found.pixel.origin, found.pixel.direction
    for number, piece in pieces.items():
        test = found.tests[int(number.removeprefix("2.")) - 1]
        points = test.candidate.points
        n = np.cross(points[2] - points[0], points[1] - points[0])
        n = points[1] if test.candidate.is_plane else n
        n = n / np.linalg.norm(n)
        distances = (piece.vertices - points[0]) @ n
        assert np.abs(distances).max() < 1e-2  # the one that is seen lies a little before it
        t = -((o - points[0]) @ n) / (d @ n)
        inside = piece.vertices.min(axis=0) - 1e-2, piece.vertices.max(axis=0) + 1e-2
        assert (inside[0] <= o + t * d).all() and (o + t * d <= inside[1]).all()


@pytest.mark.parametrize("orthographic", [False, True])
def test_the_ray_passes_the_film_in_the_pixels_middle(make, orthographic):
    camera = make.camera(6, 4, orthographic=orthographic, eye=(1, 2, 3), target=(0, 0, 0))
    found = derive(make.scene(camera, make.quad(-1, 1, -1, 1, 0)), 4, 1)
    drawn = {s.name: s.vertices for s in shapes(found)}
    on_film = found.pixel.origin + (0 if orthographic else 1) * found.pixel.direction
    np.testing.assert_allclose(drawn["Pixel"].mean(axis=0), on_film, atol=1e-12)
    axes = np.stack((camera.right, camera.up), axis=1)
    film, pixel = drawn["Film"] @ axes, drawn["Pixel"] @ axes
    np.testing.assert_allclose((pixel[0] - film[0]) / (film[2] - film[0]), (4 / 6, 1 / 4))


def test_nothing_met_is_a_ray_alone(one_triangle):
    scene = one_triangle([(0, 0, -4), (1, 0, -4), (-1, 0, -4)])  # degenerate
    names = [s.name for s in shapes(derive(scene, 1, 1))]
    assert names == ["Ray", "Film", "Pixel", "2.1 Thing 0"]
    ray, *film = shapes(derive(one_triangle(), 1, 1))
    assert [s.name for s in film] == ["Film", "Pixel"]
    assert ray.vertices[-1] == pytest.approx((0, 0, -20))

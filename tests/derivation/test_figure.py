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

"""Pixels to explain: ordinary ones, and each of the ways in which a ray misses."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from reference_tracer.report import pixel
from reference_tracer.scene import Camera, Instance, Mesh, Plane, Scene, ViewWindow


def ball(make, orthographic=False, far=0.0):
    """A ball of 320 triangles before a square and an infinite plane."""
    ball = make.mesh(trimesh.creation.icosphere(2, radius=1.0), name="Ball")
    ball = Mesh(ball.vertices + np.array((far, 0, -5)), ball.triangles, name="Ball")
    square = make.quad(far - 3, far + 3, -2, 2, -8.0, name="Square")
    camera = make.camera(
        24, 18, half=2.0 if orthographic else 0.5, eye=(far, 0.1, 0.3), orthographic=orthographic
    )
    return make.scene(camera, ball, square, planes=[((0, -2.1, 0), (0.1, 1, 0.05))])


@pytest.fixture(params=["perspective", "orthographic", "far"])
def ball_scene(make, request):
    """The ball, near and a thousand kilometres away."""
    return ball(make, request.param == "orthographic", 1e6 if request.param == "far" else 0.0)


@pytest.fixture
def one_triangle():
    """A function: a triangle (3, 3) and more as a scene whose pixel (1, 1) looks along −Z."""

    def build(*triangles, planes=(), **options):
        half = 1.5  # 3 x 3 pixels of size 1: the middle one's ray is (0, 0, −1)
        camera = Camera(
            np.eye(4),
            ViewWindow(-half, half, -half, half),
            3,
            3,
            clip_start=0.5,
            clip_end=100.0,
            **options,
        )
        meshes = [
            Mesh(np.array(t, float), [[0, 1, 2]], name=f"Mesh {k}") for k, t in enumerate(triangles)
        ]
        return Scene(
            camera,
            meshes,
            [
                Instance(k, k, np.eye(4), [[0.1 * (k + 1), 0.5, 0.25, 1]])
                for k in range(len(meshes))
            ],
            [Plane(len(meshes) + k, *p, color=(0.5, 0.5, 0, 0.3)) for k, p in enumerate(planes)],
            objects=[f"Thing {k}" for k in range(len(meshes) + len(planes))],
            background=np.array([0.2, 0.3, 0.4, 0.5]),
        )

    return build


@pytest.fixture
def page_of(open_page):
    """A function: a derivation's page, opened."""
    return lambda found, **options: open_page(pixel.html(found), ready=".lecture", **options)

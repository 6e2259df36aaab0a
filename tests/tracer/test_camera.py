"""Camera rays against what a camera is, for both kinds and for frames that are not orthonormal."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.projections import ORTHOGRAPHIC
from reference_tracer.scene import ViewWindow
from reference_tracer.tracer.camera import (
    camera_rays,
    film_of,
    pixel_size,
    project,
)

TURN = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
FRAMES = {
    "straight": np.eye(3),
    "rotated": TURN * np.linalg.det(TURN),
    "mirrored": -TURN * np.linalg.det(TURN),
    "sheared": TURN @ np.array([[1, 0.4, 0], [0, 1, -0.3], [0.2, 0, 1]]),
}
EYE = (3.25, -40.5, 7.125)
SHIFTED = ViewWindow(-0.2, 1.1, -0.9, 0.3)
EPS = np.finfo(float).eps


@pytest.fixture(
    params=[(kind, frame) for kind in (False, True) for frame in FRAMES],
    ids=lambda p: f"{'orthographic' if p[0] else 'perspective'} {p[1]}",
)
def camera(request, make):
    orthographic, frame = request.param
    return make.camera(
        20, 14, eye=EYE, axes=FRAMES[frame], window=SHIFTED, orthographic=orthographic
    )


def one(camera, px, py):
    rays = camera_rays(camera, np.array([px]), np.array([py]))
    return rays.origins[:, 0], rays.directions[:, 0]


def test_film_of_inverts_camera_rays(camera, rng):
    px, py, t = rng.uniform(-5, 25, 300), rng.uniform(-5, 19, 300), rng.uniform(0.1, 100, 300)
    x, y, _ = film_of(camera, camera_rays(camera, px, py).at(t))
    assert np.allclose(x, px, rtol=0, atol=1e-9) and np.allclose(y, py, rtol=0, atol=1e-9)


def test_project_bounds_its_error(camera, rng):
    """Against integers: what `magnitude` allows is not exceeded, and is not idle talk."""
    points = rng.normal(size=(3, 200)) * 10.0 ** rng.uniform(-3, 6, 200)
    xyz, magnitude = project(camera, points)
    axes = np.stack((camera.right, camera.up, camera.forward), axis=1).astype(np.longdouble)
    dual = np.stack([np.cross(axes[:, (k + 1) % 3], axes[:, (k + 2) % 3]) for k in range(3)])
    dual /= (axes[:, 0] * dual[0]).sum()
    q = points.astype(np.longdouble) - camera.origin[:, None]
    exact = np.stack([(d[:, None] * q).sum(axis=0) for d in dual])
    error = np.abs(xyz - exact).astype(float) / (EPS * magnitude)
    assert error.max() < 16
    assert (magnitude >= np.abs(xyz)).all()


def test_nothing_appears_behind_a_perspective_camera(make):
    camera = make.camera(20, 14)
    points = np.array([[0, 0, 1.0], [1, 2, 0], [0, 0, -1]]).T
    x, y, depth = film_of(camera, points)
    assert np.isnan([x[:2], y[:2]]).all() and np.isfinite([x[2], y[2]]).all()
    assert depth.tolist() == [-1, 0, 1]
    assert np.isfinite(film_of(replace(camera, projection=ORTHOGRAPHIC), points)).all()


@pytest.mark.parametrize("degrees", [0.5, 40, 170])
def test_the_textbooks_camera(degrees, make):
    """Pixel length tan(half the angle) / (half the resolution), samples at x - (width - 1) / 2."""
    width, height = 9, 6
    camera = make.camera(width, height, half=np.tan(np.radians(degrees / 2)))
    length = np.tan(np.radians(degrees / 2)) / (height / 2)
    for x, y in ((0, 0), (8, 5), (4, 2)):
        _, direction = one(camera, x + 0.5, y + 0.5)
        expected = (length * (x - (width - 1) / 2), length * (y - (height - 1) / 2), -1)
        assert np.allclose(direction, expected, rtol=0, atol=16 * EPS * width * length)
    assert pixel_size(camera) == pytest.approx((length, length))

"""What may cover a pixel, and what surely does, if its sample may lie off."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.causes.checks.coverage import coverage, nearest_to_origin
from reference_tracer.causes.checks.probe import SOUND, Probe
from reference_tracer.scene import Mesh
from reference_tracer.tracer.nearest import plan
from reference_tracer.tracer.progress import result_of

BAND = 0.004  # pixels


def test_a_corner_behind_the_eye_is_unknown():
    point, rim = nearest_to_origin(np.array([[[0.0], [0]], [[1], [0]], [[np.nan], [1]]]))
    assert np.isnan(point).all() and np.isnan(rim).all()


def test_nearest_points_are_those_of_dense_samples_of_the_edges(rng):
    corners = rng.normal(size=(3, 2, 400)) + rng.normal(size=(1, 2, 400))
    corners[2, :, :20] = corners[1, :, :20]  # segments
    corners[:, :, 20:25] = corners[:1, :, 20:25]  # points
    point, rim = nearest_to_origin(corners)
    along = np.linspace(0, 1, 2001)[:, None, None]
    edges = [corners[i] + along * (corners[i - 1] - corners[i]) for i in range(3)]
    edge = np.min([np.linalg.norm(e, axis=1).min(axis=0) for e in edges], axis=0)
    assert np.allclose(np.abs(rim), edge, rtol=0, atol=0.01)
    x, y = corners[:, 0], corners[:, 1]
    cross = [x[i - 1] * y[i] - y[i - 1] * x[i] for i in range(3)]
    inside = (np.min(cross, axis=0) > 0) | (np.max(cross, axis=0) < 0)
    assert 20 < inside.sum() < 380 and ((rim > 0) == inside).all()
    assert not point[:, inside].any()
    assert np.allclose(np.linalg.norm(point, axis=0)[~inside], -rim[~inside])


def asked(scene, band=BAND):
    """Return the coverage of all pixels of a picture."""
    region = scene.camera.region
    made = result_of(plan(scene, SOUND, reach=band))
    count = region.width * region.height
    probe = result_of(Probe.of(made, region, np.ones(count, bool)))
    return result_of(coverage(probe, np.full(count, band)))


@pytest.fixture
def pixels(make):
    """Return an orthographic camera of 8 x 6 pixels, one a metre, (0, 0) at the lower left."""
    camera = make.camera(8, 6, half=3, orthographic=True, eye=(4, 3, 0))
    return camera


def sliver(x, y0=-9, y1=99, width=1e-4, z=-2.0):
    """Return a triangle that is `width` wide where x is 4.5 + `x` and y from 0 to 6."""
    x = 4.5 + x
    return Mesh([(x, y0, z), (x, y1, z), (x + width, (y0 + y1) / 2, z)], [[0, 1, 2]], name="Sliver")


@pytest.mark.parametrize(
    "offset, found", [(0.002, True), (-0.0032, True), (0.0045, False), (0.3, False)]
)
def test_a_sliver_between_all_samples_is_found(make, pixels, offset, found):
    may = asked(make.scene(pixels, sliver(offset)))
    assert sorted(may.pixel.tolist()) == ([4 + 8 * y for y in range(6)] if found else [])
    assert np.allclose(may.distance, abs(offset), rtol=0, atol=1e-4 + 99 * 2.0**-20)
    assert (may.hits.t == pytest.approx(2)) and (may.hits.instance == 0).all()
    assert np.isinf(may.sure.t).all()


@pytest.mark.parametrize("length", [1e2, 1e4, 1e6])
def test_no_distance_is_beyond_the_band(make, pixels, length):
    """However long the triangle: what is aimed at inside of it stays near."""
    may = asked(make.scene(pixels, sliver(0.0037, -length, 2 * length)))
    assert len(may.pixel)
    assert (may.distance <= BAND).all()


def test_what_is_surely_covered(make, pixels):
    """The nearest surface with the centre farther inside than the band."""
    near, far = make.quad(2.498, 9, -9, 20, -1), make.quad(-20, 40, -30, 40, -3)
    sure = asked(make.scene(pixels, near, far)).sure.t.reshape(6, 8)
    assert np.allclose(sure[:, :2], 3) and np.allclose(sure[:, 3:], 1)
    assert np.allclose(sure[:, 2], 3)  # its edge runs 0.002 pixels beside the centre


def test_planes_are_sure(make, pixels):
    assert np.allclose(asked(make.scene(pixels, planes=[((0, 0, -2), (0, 0, 1))])).sure.t, 2)


def test_nothing_there(make, pixels):
    may = asked(make.scene(pixels))
    assert len(may.pixel) == len(may.distance) == len(may.hits.t) == 0
    assert np.isinf(may.sure.t).all() and len(may.sure.t) == 48

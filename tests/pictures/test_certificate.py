"""The camera certificate: passed by the camera itself in float32, failed by every other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from reference_tracer.pictures.certificate import POINTS, CameraMismatchError, certify, known_points
from reference_tracer.scene import SceneError, ViewWindow
from reference_tracer.tracer.camera import film_of


@pytest.fixture(params=[False, True], ids=["perspective", "orthographic"])
def camera(request, make):
    return make.camera(
        160, 90, eye=(3, -4, 2), target=(0, 1, 0), orthographic=request.param, half=0.7
    )


def certificate(camera, other):
    """Return that of a camera before what another one has."""
    points = known_points(camera)
    x, y, _ = film_of(other, points)
    return certify(camera, points, np.stack((x, y)))


def test_the_same_camera_in_float32_passes(camera):
    matrix = camera.world_from_camera.astype(np.float32).astype(np.float64)
    same = certificate(camera, camera)
    assert same.passed and same.largest == 0
    rounded = certificate(camera, replace(camera, world_from_camera=matrix))
    assert 0 < rounded.largest <= rounded.allowed < 0.2  # a kilometre away, orthographic
    assert rounded.passed and f"{rounded.largest:.2g} px" in rounded.line()
    assert rounded.to_dict()["passed"] and rounded.to_dict()["points"] == 8 + POINTS


@pytest.mark.parametrize("fault", ["mirrored", "fit", "turned", "scaled"])
def test_other_cameras_fail(camera, fault):
    w, matrix = camera.window, camera.world_from_camera.copy()
    if fault == "mirrored":
        matrix[:3, 0] *= -1
    elif fault == "turned":
        matrix[:3, :3] = matrix[:3, :3].T
    elif fault == "scaled":
        matrix[:3, 1] *= 1.1
    else:
        w = ViewWindow(*(v * 16 / 9 for v in (w.left, w.right, w.bottom, w.top)))
    found = certificate(camera, replace(camera, window=w, world_from_camera=matrix))
    assert not found.passed and found.largest > 1
    with pytest.raises(CameraMismatchError, match=r"not Blender's.*pixels apart"):
        found.check()
    assert issubclass(CameraMismatchError, SceneError)

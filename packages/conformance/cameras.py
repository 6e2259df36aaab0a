"""Writes a camera as JSON in OpenCV's convention: K, R and t."""

from __future__ import annotations

from typing import Any

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.scene import Camera

# (x, y, z) with Z up is (x, z, -y) with Y up.
Y_UP_FROM_Z_UP = np.array([(1.0, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)])
_CV_FROM_CAMERA = np.diag((1.0, -1.0, -1.0))  # y down and z forward, from y up and z backward


def opencv(camera: Camera, y_up: bool = False) -> dict[str, Any]:
    """Return a camera for JSON: a point X in world space is seen at pixel (u, v).

    With x = R X + t, which is right, down and forward, in metres:

        perspective:   u = (K x)[0] / x[2],  v = (K x)[1] / x[2]
        orthographic:  u, v = K (x[0], x[1], 1)

    Pixel centres are at +0.5, and row 0 is at the top.

    Parameters
    ----------
    camera : Camera
        Its axes have the length 1 and are at right angles.
    y_up : bool
        Whether world space is glTF's, with Y up; else Z is up.

    References
    ----------
    .. [1] OpenCV, "Camera Calibration and 3D Reconstruction", the pinhole camera model.
    """
    matrix = Y_UP_FROM_Z_UP @ camera.world_from_camera if y_up else camera.world_from_camera
    rotation: Floats = _CV_FROM_CAMERA @ matrix[:3, :3].T
    window, (width, height) = camera.window, camera.window.size
    fx, fy = camera.width / width, camera.height / height
    return {
        "projection": camera.projection.name,
        "width": camera.width,
        "height": camera.height,
        "K": [[fx, 0.0, -window.left * fx], [0.0, fy, window.top * fy], [0.0, 0.0, 1.0]],
        "R": rotation.tolist(),
        "t": (-rotation @ matrix[:3, 3]).tolist(),
        "up": "y" if y_up else "z",
    }

"""Where each convention's own published formula has a point, written out without the add-on's code.

Each function takes what was written, by the names of its files, and world points (3, n) in metres
(Blender's axes); it returns (u, v), pixels from the upper left corner of the picture, rows
downwards, so that the first pixel's centre is (0.5, 0.5).
"""

from __future__ import annotations

import json

import numpy as np

Files = dict[str, str]


def homogeneous(points: np.ndarray) -> np.ndarray:
    return np.vstack((points, np.ones(points.shape[1])))


def opencv(files: Files, points: np.ndarray) -> np.ndarray:
    """OpenCV, calib3d: s [u v 1] = K [R | t] [X Y Z 1]."""
    file = json.loads(files[""])
    r, t, k = (np.array(file[name]) for name in ("R", "t", "K"))
    assert np.allclose(r @ r.T, np.eye(3), atol=1e-5) and np.linalg.det(r) > 0
    x, y, z = k @ (r @ points + t[:, None])
    first = {"half": 0.5, "integer": 0.0}[file["pixel_centers"]]
    return np.stack((x / z, y / z)) + 0.5 - first


def opengl(files: Files, points: np.ndarray) -> np.ndarray:
    """OpenGL 4.6, 13.8: the perspective division, then the viewport's transformation."""
    file = json.loads(files[""])
    clip = np.array(file["projection"]) @ np.array(file["view"]) @ homogeneous(points)
    x, y, _ = clip[:3] / clip[3]
    return np.stack(((x + 1) * file["width"] / 2, (1 - y) * file["height"] / 2))


def nerf(files: Files, points: np.ndarray) -> np.ndarray:
    """instant-ngp and nerfstudio: a ray is c2w [(u - cx) / fl_x, -(v - cy) / fl_y, -1]."""
    file = json.loads(files[""])
    (frame,) = file["frames"]
    c2w = np.array(frame["transform_matrix"])
    x, y, z, _ = np.linalg.solve(c2w, homogeneous(points))
    width = 2 * file["fl_x"] * np.tan(file["camera_angle_x"] / 2)
    assert np.isclose(width, file["w"], rtol=1e-14)
    return np.stack((file["fl_x"] * x / -z + file["cx"], -file["fl_y"] * y / -z + file["cy"]))


def colmap(files: Files, points: np.ndarray) -> np.ndarray:
    """COLMAP, "Output Format" and PINHOLE; the rotation is that of `qvec2rotmat`."""
    lines = [line for line in files["cameras.txt"].splitlines() if not line.startswith("#")]
    number, model, width, height, *params = lines[0].split()
    assert (number, model) == ("1", "PINHOLE") and int(width) and int(height)
    fx, fy, cx, cy = map(float, params)
    lines = [line for line in files["images.txt"].splitlines() if not line.startswith("#")]
    w, x, y, z, *t = map(float, lines[0].split()[1:8])
    assert lines[1] == "" and lines[0].split()[8] == "1"
    assert np.isclose(w * w + x * x + y * y + z * z, 1, rtol=1e-14)
    r = np.array(
        [
            [1 - 2 * y**2 - 2 * z**2, 2 * x * y - 2 * w * z, 2 * z * x + 2 * w * y],
            [2 * x * y + 2 * w * z, 1 - 2 * x**2 - 2 * z**2, 2 * y * z - 2 * w * x],
            [2 * z * x - 2 * w * y, 2 * y * z + 2 * w * x, 1 - 2 * x**2 - 2 * y**2],
        ]
    )
    a, b, depth = r @ points + np.array(t)[:, None]
    return np.stack((fx * a / depth + cx, fy * b / depth + cy))


FORMULAS = {"opencv": opencv, "opengl": opengl, "nerf": nerf, "colmap": colmap}

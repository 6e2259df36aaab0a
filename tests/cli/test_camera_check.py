"""`reftrace camera --check`: a camera as other programs were reported to write it gets its name."""

from __future__ import annotations

import json

import numpy as np
import pytest

W, H, F = 480, 270, 620.0
CX, CY = W / 2 - 0.06 * W, H / 2 - 0.04 * W
FLIP = np.diag([1.0, -1, -1])


def pose(eye, roll=0.05):
    """R and t of OpenCV: x right, y down, z forward."""
    forward = np.subtract((0.2, 0, 0.4), eye)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0, 0, 1))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    right, up = right * np.cos(roll) + up * np.sin(roll), up * np.cos(roll) - right * np.sin(roll)
    r = np.array([right, -up, forward])
    return r, -r @ eye


R, T = pose(np.array((4.0, -5, 3)))
K = np.array([[F, 0, CX], [0, F, CY], [0, 0, 1]])


def opencv(k, r, t):
    size = {"width": W, "height": H, "pixel_centers": "half"}
    return size | {"K": np.array(k).tolist(), "R": np.array(r).tolist(), "t": np.array(t).tolist()}


def pytorch3d(r, t):
    left_up = np.diag([-1.0, -1, 1])
    arguments = {
        "R": [(left_up @ r).tolist()],  # not transposed: PyTorch3D multiplies rows by R
        "T": [(left_up @ t).tolist()],
        "focal_length": [[F, F]],
        "principal_point": [[CX, CY]],
        "image_size": [[H, W]],
        "in_ndc": False,
    }
    return {"class": "PerspectiveCameras", "names": ["0001.png"], "arguments": arguments}


def in_degrees():
    frames = [{"file_path": "./0001.png", "transform_matrix": np.eye(4).tolist()}]
    angle = np.degrees(2 * np.arctan(W / 2 / F))
    return {"w": W, "h": H, "cx": CX, "cy": CY, "camera_angle_x": angle, "frames": frames}


# What is written, the exit code, and what is said.
FILES = {
    "kubric": (opencv(K @ FLIP, FLIP @ R, FLIP @ T), 0, "agree"),
    "scaled": (opencv(-2 * np.array(K), R, T), 0, "agree"),
    "inverse": (opencv(K, R.T, (4, -5, 3)), 2, "camera-to-world in place of world-to-camera"),
    "not_transposed": (pytorch3d(R, T), 2, "rotation is transposed"),
    "shift": (opencv([K[0], [0, F, H / 2], K[2]], R, T), 2, "the camera's shift up is left out"),
    "aspect": (
        opencv([K[0], [0, F, H / 2 + (CY - H / 2) * W / H], K[2]], R, T),
        2,
        "the camera's shift is in another unit",
    ),
    "degrees": (
        in_degrees(),
        4,
        "is 42.3225: it must be in radians, not in degrees",
    ),
}


@pytest.fixture
def scene(tmp_path):
    """A mesh, and its right camera."""
    (tmp_path / "s.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
    write(tmp_path / "base.json", opencv(K, R, T))
    return tmp_path


def write(path, content):
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def checked(scene, path):
    return ["camera", str(scene / "s.obj"), "--camera", str(scene / "base.json"), "--check", path]


@pytest.mark.parametrize("name", FILES)
def test_its_mistake_is_named(name, scene, exit_code, capsys):
    content, code, said = FILES[name]
    path = write(scene / f"{name}.json", content)
    assert exit_code(checked(scene, str(path))) == code
    out = "".join(capsys.readouterr())
    assert said in out and "half a pixel" not in out and "i + 1/2" not in out


def test_many_cameras_are_judged_together(scene, exit_code, capsys):
    """All of a file of frames have the same mistake: it is said once, in some few lines."""
    frames = [opencv(K, R.T, (4, -5, 3)) | {"name": f"{n:04d}.png"} for n in range(1, 101)]
    path = write(scene / "many.json", {"frames": frames})
    assert exit_code(checked(scene, str(path))) == 2
    out = capsys.readouterr().out.splitlines()
    assert len(out) == 4 and out[0].startswith("many.json: 100 of 100 cameras differ, 0001.png")
    assert "camera-to-world in place of world-to-camera" in out[2]

"""Where each convention's own published formula has a point, written out without the add-on's code.

Each function takes what was written, by the names of its files, and world points (3, n) in metres
(Blender's axes); it returns (u, v), pixels from the upper left corner of the picture, rows
downwards, so that the first pixel's centre is (0.5, 0.5).
"""

from __future__ import annotations

import json
from xml.etree import ElementTree

import numpy as np

Files = dict[str, str]


def homogeneous(points: np.ndarray) -> np.ndarray:
    return np.vstack((points, np.ones(points.shape[1])))


def pinhole(k: np.ndarray, pose: np.ndarray, points: np.ndarray) -> np.ndarray:
    """What all of OpenCV's axes have in common: s [u v 1] = K [R | t] [X Y Z 1]."""
    x, y, z = k @ (pose @ homogeneous(points))[:3]
    return np.stack((x / z, y / z))


def opencv(files: Files, points: np.ndarray) -> np.ndarray:
    """OpenCV, calib3d."""
    file = json.loads(files[""])
    r, t, k = (np.array(file[name]) for name in ("R", "t", "K"))
    assert np.allclose(r @ r.T, np.eye(3), atol=1e-5) and np.linalg.det(r) > 0
    first = {"half": 0.5, "integer": 0.0}[file["pixel_centers"]]
    return pinhole(k, np.column_stack((r, t)), points) + 0.5 - first


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


def gltf(files: Files, points: np.ndarray) -> np.ndarray:
    """glTF 2.0, 3.10.3: its projection matrices; in a world with Y up. The size is the extras'."""
    file = json.loads(files[""])
    (node,), (camera,) = file["nodes"], file["cameras"]
    world = np.array(node["matrix"]).reshape(4, 4).T
    x, y, z = points
    clip = np.linalg.solve(world, homogeneous(np.stack((x, z, -y))))
    own = camera[camera["type"]]
    projection = np.zeros((4, 4))
    if camera["type"] == "perspective":
        projection[0, 0] = 1 / (own["aspectRatio"] * np.tan(0.5 * own["yfov"]))
        projection[1, 1] = 1 / np.tan(0.5 * own["yfov"])
        projection[3, 2] = -1
    else:
        projection[0, 0], projection[1, 1], projection[3, 3] = 1 / own["xmag"], 1 / own["ymag"], 1
    x, y, _, w = projection @ clip
    width, height = camera["extras"]["width"], camera["extras"]["height"]
    return np.stack(((x / w + 1) / 2 * width, (1 - y / w) / 2 * height))


def mitsuba(files: Files, points: np.ndarray) -> np.ndarray:
    """Mitsuba 3, `perspective_projection` and `sample_ray` of `src/sensors/perspective.cpp`."""
    (sensor,) = ElementTree.fromstring(files[""])
    values = {
        child.get("name"): child.get("value") for child in sensor.iter() if child.get("value")
    }
    width, height = int(values["width"]), int(values["height"])
    world = np.array(sensor.find("transform/matrix").get("value").split(), float).reshape(4, 4)
    x, y, z, _ = np.linalg.solve(world, homogeneous(points))
    if sensor.get("type") == "orthographic":
        return np.stack((width * (0.5 - 0.5 * x), height * (0.5 - 0.5 * width / height * y)))
    assert values["fov_axis"] == "x" and np.allclose(np.linalg.norm(world[:3], axis=0)[:3], 1)
    tangent = np.tan(np.radians(float(values["fov"])) / 2)
    sample_x = 0.5 - 0.5 * x / z / tangent - float(values["principal_point_offset_x"])
    sample_y = (
        0.5 - 0.5 * width / height * y / z / tangent - float(values["principal_point_offset_y"])
    )
    return np.stack((width * sample_x, height * sample_y))


def pytorch3d(files: Files, points: np.ndarray) -> np.ndarray:
    """PyTorch3D, `transform_points_screen`: to NDC, in which +x is left, then to the screen."""
    file = json.loads(files[""])
    own = {key: np.array(value) for key, value in file["arguments"].items()}
    x, y, z = (points.T @ own["R"][0] + own["T"][0]).T
    if file["class"] == "OrthographicCameras":
        z = np.ones_like(z)
    (height, width), half = own["image_size"][0], own["image_size"][0].min() / 2
    (fx, fy), (px, py) = own["focal_length"][0], own["principal_point"][0]
    ndc_x = fx / half * x / z - (px - width / 2) / half
    ndc_y = fy / half * y / z - (py - height / 2) / half
    assert not own["in_ndc"]
    return np.stack((width / 2 - half * ndc_x, height / 2 - half * ndc_y))


def open3d(files: Files, points: np.ndarray) -> np.ndarray:
    """Open3D, `create_rays_pinhole`: pixel (x, y) is seen along inv(K) (x + 0.5, y + 0.5, 1)."""
    file = json.loads(files[""])
    assert file["class_name"] == "PinholeCameraParameters" and file["pixel_centers"] == "half"
    k = np.array(file["intrinsic"]["intrinsic_matrix"]).reshape(3, 3, order="F")
    t = np.array(file["extrinsic"]).reshape(4, 4, order="F")
    return pinhole(k, t, points)


def bop(files: Files, points: np.ndarray) -> np.ndarray:
    """bop_toolkit, `misc.project_pts`: K [R | t], in millimetres."""
    (camera,) = json.loads(files["scene_camera.json"]).values()
    k, r = (np.reshape(camera[name], (3, 3)) for name in ("cam_K", "cam_R_w2c"))
    dataset = json.loads(files["camera.json"])
    assert [dataset[n] for n in ("fx", "fy", "cx", "cy")] == [k[0, 0], k[1, 1], k[0, 2], k[1, 2]]
    return pinhole(k, np.column_stack((r, camera["cam_t_w2c"])), 1000 * points)


def splatting(files: Files, points: np.ndarray) -> np.ndarray:
    """3D Gaussian splatting: `position` and `rotation` are world from OpenCV's camera space."""
    (camera,) = json.loads(files[""])
    x, y, z = np.linalg.solve(camera["rotation"], points - np.array(camera["position"])[:, None])
    middle = camera["width"] / 2, camera["height"] / 2
    return np.stack((camera["fx"] * x / z + middle[0], camera["fy"] * y / z + middle[1]))


def mvsnet(files: Files, points: np.ndarray) -> np.ndarray:
    """MVSNet: K [R | t], row by row."""
    ((name, text),) = files.items()
    head, rows = text.removeprefix("extrinsic").split("intrinsic")
    t, k = np.array(head.split(), float), np.array(rows.split()[:9], float)
    assert name.endswith("_cam.txt") and text.startswith("extrinsic")
    return pinhole(k.reshape(3, 3), t.reshape(4, 4), points)


FORMULAS = {
    "opencv": opencv,
    "opengl": opengl,
    "nerf": nerf,
    "colmap": colmap,
    "gltf": gltf,
    "mitsuba": mitsuba,
    "pytorch3d": pytorch3d,
    "open3d": open3d,
    "bop": bop,
    "splatting": splatting,
    "mvsnet": mvsnet,
}

"""Has other programs' own code read camera files, and measures where it has known points.

Run by `cameras.py` in an environment of these programs, which knows nothing of the add-on.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np


def colmap(folder: Path, points: np.ndarray, film: np.ndarray) -> tuple[str, float]:
    """COLMAP reads the folder, and projects."""
    import pycolmap

    model = pycolmap.Reconstruction(str(folder))
    (image,) = model.images.values()
    camera = model.cameras[image.camera_id]
    found = camera.img_from_cam(image.cam_from_world() * points.T)
    return f"COLMAP {pycolmap.__version__}", float(np.abs(found.T - film).max())


def opencv(folder: Path, points: np.ndarray, film: np.ndarray) -> tuple[str, float]:
    """OpenCV's `projectPoints` takes R as a rotation vector."""
    import cv2

    file = json.loads((folder / "camera.xml").read_text(encoding="utf-8"))
    r, t, k = (np.array(file[name]) for name in ("R", "t", "K"))
    turn, _ = cv2.Rodrigues(r)
    found, _ = cv2.projectPoints(points.T.copy(), turn, t, k, None)
    return f"OpenCV {cv2.__version__}", float(np.abs(found[:, 0].T - film).max())


def mitsuba(folder: Path, points: np.ndarray, film: np.ndarray) -> tuple[str, float]:
    """Mitsuba loads the sensor, and samples its rays."""
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    sensor = mi.load_file(str(folder / "camera.xml")).sensors()[0]
    size = np.array(sensor.film().size())

    def ray(u: float, v: float) -> tuple[np.ndarray, np.ndarray]:
        at = mi.Point2f(*(np.array((u, v)) / size))
        found, _ = sensor.sample_ray(0, 0.5, at, mi.Point2f(0.5, 0.5))
        return tuple(np.array(a, np.float64).ravel() for a in (found.o, found.d))

    worst = 0.0
    for point, (u, v) in zip(points.T, film.T, strict=True):
        # Where rays through (u, v), and a pixel beside it, pass the plane of the point.
        at = [ray(u, v), ray(u + 1, v), ray(u, v + 1)]
        normal = sensor.world_transform() @ mi.Vector3f(0, 0, 1)
        normal = np.array(normal, np.float64).ravel()
        here, right, down = (o + d * ((point - o) @ normal) / (d @ normal) for o, d in at)
        sides = np.stack((right - here, down - here, normal), axis=1)
        worst = max(worst, float(np.abs(np.linalg.solve(sides, point - here)[:2]).max()))
    return f"Mitsuba {mi.__version__}", worst


def pyrender(folder: Path, points: np.ndarray, film: np.ndarray) -> tuple[str, float]:
    """pyrender's projection matrix of the focal lengths, and the pose as OpenGL has it."""
    os.environ.setdefault("PYOPENGL_PLATFORM", "egl")
    import pyrender

    file = json.loads((folder / "camera.xml").read_text(encoding="utf-8"))
    lens = pyrender.IntrinsicsCamera(*(file[name] for name in ("fl_x", "fl_y", "cx", "cy")))
    projection = lens.get_projection_matrix(file["w"], file["h"])
    pose = np.array(file["frames"][0]["transform_matrix"])
    seen = np.linalg.solve(pose, np.vstack((points, np.ones(points.shape[1]))))
    x, y, _, w = projection @ seen
    found = np.stack(((1 + x / w) / 2 * file["w"], (1 - y / w) / 2 * file["h"]))
    return f"pyrender {pyrender.__version__}", float(np.abs(found - film).max())


def open3d(folder: Path, points: np.ndarray, film: np.ndarray) -> tuple[str, float]:
    """Open3D reads the parameters, and makes the rays of all pixels."""
    import open3d as o3d

    own = o3d.io.read_pinhole_camera_parameters(str(folder / "camera.json"))
    width, height = own.intrinsic.width, own.intrinsic.height
    tensors = (o3d.core.Tensor(m) for m in (own.intrinsic.intrinsic_matrix, own.extrinsic))
    rays = o3d.t.geometry.RaycastingScene.create_rays_pinhole(*tensors, width, height)
    rays = rays.numpy().astype(np.float64)
    # Directions are linear in the pixel: the first one's, and a step across and down.
    first = rays[0, 0, 3:]
    across = (rays[0, -1, 3:] - first) / (width - 1)
    down = (rays[-1, 0, 3:] - first) / (height - 1)
    x, y, depth = np.linalg.solve(
        np.stack((across, down, first), axis=1), points - rays[0, 0, :3, None]
    )
    found = np.stack((x, y)) / depth + 0.5
    return f"Open3D {o3d.__version__}", float(np.abs(found - film).max())


PROGRAMS: dict[str, Callable[..., Any]] = {
    "colmap": colmap,
    "opencv": opencv,
    "mitsuba": mitsuba,
    "nerf": pyrender,
    "open3d": open3d,
}


def main() -> None:
    found: dict[str, dict[str, float]] = {}
    for case in json.loads(Path(sys.argv[1]).read_text(encoding="utf-8")):
        folder, points, film = (
            Path(case["folder"]),
            np.array(case["points"]),
            np.array(case["film"]),
        )
        if case["convention"] == "open3d":
            (folder / "camera.xml").rename(folder / "camera.json")
        name, pixels = PROGRAMS[case["convention"]](folder, points, film)
        found.setdefault(name, {})[case["setting"]] = pixels
    print(json.dumps(found))


if __name__ == "__main__":
    main()

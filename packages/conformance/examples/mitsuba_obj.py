"""Renders a scene of the kit with Mitsuba 3: python mitsuba_obj.py scene.obj camera.json out.png.

The rays are those of Mitsuba's own sensors, through the pixels' centres; its own reader has the
mesh, whose triangles are the fans of the file's faces, in their order.
"""

import json
import re
import sys
from pathlib import Path
from typing import Any

import mitsuba as mi
import numpy as np
from PIL import Image

mi.set_variant("scalar_rgb")


def colors_of(obj: Path) -> list[list[float]]:
    """Return linear RGB of each triangle."""
    materials = obj.with_suffix(".mtl").read_text(encoding="utf-8")
    of_name = r"newmtl (\S+)\nKd (\S+) (\S+) (\S+)"
    colors = {name: [*map(float, rgb)] for name, *rgb in re.findall(of_name, materials)}
    shown = []
    for line in obj.read_text(encoding="utf-8").splitlines():
        key, *rest = line.split()
        if key == "usemtl":
            used = colors[rest[0]]
        elif key == "f":
            shown += [used] * (len(rest) - 2)
    return shown


def sensor(camera: dict[str, Any]) -> dict[str, Any]:
    """Return Mitsuba's sensor: +Z forward, +Y up, +X to the left; pixels are square."""
    width, height = camera["width"], camera["height"]
    K, R, t = (np.array(camera[key]) for key in "KRt")
    if abs(K[0, 0] / K[1, 1] - 1) > 1e-9:
        sys.exit("Mitsuba's sensors have no pixel aspect")
    x, y = K[0, 2] / width - 0.5, K[1, 2] / height - 0.5
    eye = -R.T @ t
    film = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}}
    out: dict[str, Any] = {"near_clip": 0.05, "far_clip": 1e5, "film": film}
    half = width / 2 / K[0, 0]
    scale = np.eye(3)
    if camera["projection"] == "orthographic":
        out["type"] = "orthographic"  # without a shift: the camera is moved to the side
        eye = eye - (x * R[0] * width / K[0, 0] + y * R[1] * height / K[1, 1])
        scale[:2] *= half
    else:
        out |= {"type": "perspective", "fov_axis": "x", "fov": np.degrees(2 * np.arctan(half))}
        out |= {"principal_point_offset_x": -x, "principal_point_offset_y": -y}
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack((-R[0], -R[1], R[2]), axis=1) @ scale
    matrix[:3, 3] = eye
    return out | {"to_world": mi.ScalarTransform4f(matrix.tolist())}


def main() -> None:
    """Render."""
    obj, camera_file, out = map(Path, sys.argv[1:])
    camera = json.loads(camera_file.read_text(encoding="utf-8"))
    width, height = camera["width"], camera["height"]
    colors = colors_of(obj)
    mesh = {"type": "obj", "filename": str(obj)}
    scene = mi.load_dict({"type": "scene", "sensor": sensor(camera), "mesh": mesh})
    linear = np.zeros((height, width, 3))
    seen = np.zeros((height, width, 1))
    for y in range(height):
        for x in range(width):
            at = mi.ScalarPoint2f((x + 0.5) / width, (y + 0.5) / height)
            ray, _ = scene.sensors()[0].sample_ray(0.0, 0.5, at, mi.ScalarPoint2f(0.5, 0.5))
            hit = scene.ray_intersect(ray)
            if hit.is_valid():
                linear[y, x], seen[y, x] = colors[hit.prim_index], 1
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    rgba = np.concatenate((srgb, seen), axis=2)
    Image.fromarray(np.rint(255 * rgba).astype(np.uint8)).save(out)


if __name__ == "__main__":
    main()

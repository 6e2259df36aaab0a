"""Renders a scene of the kit with Embree: python embreex_obj.py scene.obj camera.json out.png."""

import json
import re
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from PIL import Image


def read_obj(path: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return vertices (v, 3), triangles (n, 3), and linear RGB of each triangle (n, 3)."""
    materials = path.with_suffix(".mtl").read_text(encoding="utf-8")
    of_name = r"newmtl (\S+)\nKd (\S+) (\S+) (\S+)"
    colors = {name: [*map(float, rgb)] for name, *rgb in re.findall(of_name, materials)}
    vertices, triangles, shown = [], [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        key, *rest = line.split()
        if key == "v":
            vertices.append([float(v) for v in rest])
        elif key == "usemtl":
            used = rest[0]
        elif key == "f":
            a, *others = (int(v) - 1 for v in rest)
            for pair in pairwise(others):
                triangles.append((a, *pair))
                shown.append(colors[used])
    return np.array(vertices), np.array(triangles), np.array(shown)


def rays(camera: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Return origins and directions (n, 3) through the pixels' centres, row by row from the top."""
    width, height = camera["width"], camera["height"]
    K, R, t = (np.array(camera[key]) for key in "KRt")
    u, v = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    x, y = (u.ravel() - K[0, 2]) / K[0, 0], (v.ravel() - K[1, 2]) / K[1, 1]
    eye = np.broadcast_to(-R.T @ t, (len(x), 3))
    across = np.stack((x, y), axis=1) @ R[:2]
    if camera["projection"] == "orthographic":
        return eye + across, np.broadcast_to(R[2], eye.shape)
    return eye, across + R[2]


def main() -> None:
    """Render."""
    obj, camera_file, out = map(Path, sys.argv[1:])
    camera = json.loads(camera_file.read_text(encoding="utf-8"))
    vertices, triangles, colors = read_obj(obj)
    scene = EmbreeScene()
    TriangleMesh(scene, vertices.astype(np.float32), triangles.astype(np.int32))
    origins, directions = rays(camera)
    seen = scene.run(origins.astype(np.float32), directions.astype(np.float32))
    linear = np.concatenate((colors, [(0.0, 0.0, 0.0)]))[seen]  # -1, for nothing, is the last
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    rgba = np.column_stack((srgb, seen >= 0)).reshape(camera["height"], camera["width"], 4)
    Image.fromarray(np.rint(255 * rgba).astype(np.uint8)).save(out)


if __name__ == "__main__":
    main()

"""Renders a scene of the kit with Open3D.

    python open3d_glb.py scene.glb camera.json colors.json out.png

trimesh reads the file; the rays are those of Open3D's `RaycastingScene.create_rays_pinhole`, which
are a perspective camera's alone.
"""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import open3d as o3d
import trimesh
from PIL import Image


def rays(camera: dict[str, Any]) -> o3d.core.Tensor:
    """Return Open3D's own rays, (height, width, 6) float32, row by row from the top."""
    size = camera["width"], camera["height"]
    if camera["projection"] != "perspective":
        sys.exit("create_rays_pinhole makes no orthographic rays")
    extrinsic = np.eye(4)
    extrinsic[:3, :3] = camera["R"]
    extrinsic[:3, 3] = camera["t"]
    k = o3d.core.Tensor(np.array(camera["K"]))
    return o3d.t.geometry.RaycastingScene.create_rays_pinhole(k, o3d.core.Tensor(extrinsic), *size)


def main() -> None:
    """Render."""
    glb, camera_file, colors_file, out = map(Path, sys.argv[1:])
    camera = json.loads(camera_file.read_text(encoding="utf-8"))
    objects = json.loads(colors_file.read_text(encoding="utf-8"))["objects"]
    known = np.array([slot["linear"] for each in objects for slot in each["slots"]])
    scene, shown = o3d.t.geometry.RaycastingScene(), []
    read = trimesh.load_scene(glb, process=False)
    for node in read.graph.nodes_geometry:
        world, name = read.graph[node]
        mesh = read.geometry[name]
        points = trimesh.transform_points(mesh.vertices, world).astype(np.float32)
        scene.add_triangles(o3d.core.Tensor(points), o3d.core.Tensor(mesh.faces.astype(np.uint32)))
        # trimesh has the material's linear colour in 8 bits: the nearest of the scene's is meant.
        own = mesh.visual.material.baseColorFactor[:3] / 255
        shown.append(known[np.abs(known - own).sum(axis=1).argmin()])
    seen = scene.cast_rays(rays(camera))["geometry_ids"].numpy()
    is_hit = seen != scene.INVALID_ID
    linear = np.where(is_hit[..., None], np.array(shown)[np.where(is_hit, seen, 0)], 0)
    srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    rgba = np.concatenate((srgb, is_hit[..., None]), axis=2)
    Image.fromarray(np.rint(255 * rgba).astype(np.uint8)).save(out)


if __name__ == "__main__":
    main()

"""Writes certificates: a certified picture with its scene, for a checker that knows no tracer.

docs/certificate.md has the format, and packages/verify the checker.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..arrays import Array
from ..scene import Scene
from ..tracer.frame import Frame
from .npz import save

SCHEMA = "reference_tracer.certificate/2"


def save_certificate(path: str | Path, frame: Frame) -> None:
    """Write what every pixel of a frame sees, with its scene, to a compressed .npz.

    Whoever checks it believes nothing: a frame that is not certified makes a certificate that is
    refused.
    """
    ties = frame.ties
    rows = [(ray, *name) for ray in ties for name in sorted(ties[ray])]
    answers = {
        "certificate": np.array(SCHEMA),
        "seen": np.stack((frame.instance_index, frame.triangle_index), axis=-1).astype(np.int64),
        "t": frame.t,
        "ties": np.array(rows, np.int64).reshape(-1, 3),
    }
    save(path, _camera(frame.scene) | _surfaces(frame.scene) | answers)


def _camera(scene: Scene) -> dict[str, Array]:
    camera = scene.camera
    window, region = camera.window, camera.region
    return {
        "camera": np.array(camera.projection.name),
        "world_from_camera": camera.world_from_camera,
        "window": np.array([(window.left, window.right), (window.bottom, window.top)], float),
        "pixels": np.array(
            [(region.x0, region.x1, camera.width), (region.y0, region.y1, camera.height)], np.int64
        ),
        "clip": np.nan_to_num([camera.clip_start, camera.clip_end]),  # an endless one is finite
    }


def _surfaces(scene: Scene) -> dict[str, Array]:
    """Return the vertices and triangles of all meshes, and each instance's range of triangles."""
    vertices = np.cumsum([0, *(len(mesh.vertices) for mesh in scene.meshes)])
    triangles = np.cumsum([0, *(len(mesh.triangles) for mesh in scene.meshes)])
    used = [instance.mesh for instance in scene.instances]
    return {
        "vertices": np.concatenate([np.empty((0, 3)), *(mesh.vertices for mesh in scene.meshes)]),
        "triangles": np.concatenate(
            [
                np.empty((0, 3), np.int64),
                *(mesh.triangles + at for mesh, at in zip(scene.meshes, vertices, strict=False)),
            ]
        ),
        "instances": np.stack((triangles[:-1], triangles[1:]), axis=1)[used],
        "world_from_object": np.moveaxis(scene.instance_matrices, 2, 0),
        "planes": np.array([(p.point, p.normal) for p in scene.planes], float).reshape(-1, 2, 3),
    }

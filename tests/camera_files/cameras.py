"""Cameras of every kind, for what writes and reads them."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.files import WRITTEN, texts
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import Camera, ViewWindow


def rotation(rng: np.random.Generator) -> Floats:
    """A random rotation, (3, 3)."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * (1, 1, np.sign(np.linalg.det(q)))


def camera(
    rng: np.random.Generator,
    shift: tuple[float, float] = (0, 0),
    tall: float = 1.0,
    parallel: bool = False,
    mirrored: bool = False,
    sheared: bool = False,
    far: float = 1.0,
    size: tuple[int, int] = (640, 360),
) -> Camera:
    """A camera at a random place, in a random direction.

    `shift` is in widths and heights of the picture, `tall` the height of a pixel in widths.
    """
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(rng)
    matrix[:3, 3] = far * rng.normal(size=3)
    if sheared:
        matrix[:3, 0] += 0.3 * matrix[:3, 1] + 0.2 * matrix[:3, 2]
        matrix[:3, 0] /= np.linalg.norm(matrix[:3, 0])
    if mirrored:
        matrix[:3, 0] *= -1
    width = rng.uniform(0.5, 2)
    height = width * size[1] / size[0] * tall
    window = ViewWindow(-width / 2, width / 2, -height / 2, height / 2)
    return Camera(
        matrix,
        window.moved(shift[0] * width, shift[1] * height),
        *size,
        projection=ORTHOGRAPHIC if parallel else PERSPECTIVE,
        clip_start=0.1,
        clip_end=50.0,
        name="Cam",
    )


# What a camera may have, by the words with which a convention refuses it.
KINDS = {
    "plain": {},
    "a lens shift": {"shift": (0.3, -0.2)},
    "a pixel aspect": {"tall": 1.5},
    "an orthographic projection": {"parallel": True},
    "mirrored axes": {"mirrored": True},
    "axes that are not at right angles": {"sheared": True},
}


def written(name: str, views: Sequence[View]) -> dict[str, str]:
    """Files of a convention, also of one that is only read."""
    return texts(views, WRITTEN[name]) if name in WRITTEN else {"": kubric(views, 1, 1)}


def kubric(views: Sequence[View], across: float, up: float) -> str:
    """Kubric's file of views that share a lens; K is in so many units across the picture."""
    camera = views[0].camera
    width, height = camera.window.size
    x, y = camera.window.left / width, camera.window.top / height
    k = [(across / width, 0, across * x), (0, -up / height, -up * y), (0, 0, -1)]
    own = {
        "K": k,
        "positions": [view.camera.world_from_camera[:3, 3].tolist() for view in views],
        "quaternions": [_quaternion(view.camera.world_from_camera[:3, :3]) for view in views],
    }
    size = camera.width, camera.height
    return json.dumps({"camera": own, "metadata": {"resolution": size, "num_frames": len(views)}})


def _quaternion(r: Floats) -> list[float]:
    """w, x, y, z of a rotation by less than half a turn, from its skew part."""
    w = np.sqrt(1 + np.trace(r)) / 2
    return [w, *((r - r.T)[(2, 0, 1), (1, 2, 0)] / (4 * w))]

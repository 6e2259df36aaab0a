"""PyTorch3D: the arguments of `PerspectiveCameras` or `OrthographicCameras`, of all views together.

Source: PyTorch3D, "Cameras" (docs/notes/cameras.md) and `pytorch3d/renderer/cameras.py`: points are
rows, X_view = X R + T; camera space has +X to the left, +Y up and +Z forward; with `in_ndc=False`
the screen has (0, 0) at the upper left corner of the upper left pixel, and
(u, v) = (px - fx x/z, py - fy y/z); orthographic, without z. In NDC, with s the shorter side in
pixels, u = width / 2 - s / 2 (fx x/z + px), and so on. `image_size` is (height, width).

Its documents agree with its code since version 0.7; before, screens went from the first pixel's
centre to the last one's. PyTorch3D has no file: this JSON is ours. `cls(**arguments)` makes the
cameras once the lists are tensors.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from reference_tracer.camera_files import frame
from reference_tracer.camera_files.convention import Convention, Files, Source, View
from reference_tracer.camera_files.features import ASPECT, PARALLEL, SHIFT
from reference_tracer.camera_files.json_files import dumped
from reference_tracer.files.checked_json import Content, numbers, part
from reference_tracer.projections import ORTHOGRAPHIC, PERSPECTIVE
from reference_tracer.scene import SceneError

_CLASSES = {"PerspectiveCameras": PERSPECTIVE, "OrthographicCameras": ORTHOGRAPHIC}


def _write(views: Sequence[View], centers: str) -> Files:
    kinds = {view.camera.projection for view in views}
    if len(kinds) > 1:
        raise SceneError("PyTorch3D has one class for all cameras of a batch: write some at a time")
    (kind,) = (name for name, own in _CLASSES.items() if own in kinds)
    poses = [frame.camera_from_world(view.camera, frame.LEFT_UP) for view in views]
    lenses = [frame.intrinsics(view.camera) for view in views]
    arguments = {
        "R": [pose[:3, :3].T.tolist() for pose in poses],
        "T": [pose[:3, 3].tolist() for pose in poses],
        "focal_length": [lens[:2] for lens in lenses],
        "principal_point": [lens[2:] for lens in lenses],
        "image_size": [(view.camera.height, view.camera.width) for view in views],
        "in_ndc": False,
    }
    names = [view.name for view in views]
    return {"": dumped({"class": kind, "names": names, "arguments": arguments})}


def _read(source: Source) -> list[View]:
    content = source.object
    own: Content = part(content, "arguments", "", dict)
    if own.get("K") is not None:
        raise SceneError("arguments.K is not read: write focal_length and principal_point")
    count = len(part(own, "R", "arguments.", list))
    r = numbers(own, "R", "arguments.", (count, 3, 3))
    t = numbers(own, "T", "arguments.", (count, 3))
    focal, middle, size = (
        numbers(own, key, "arguments.", (count, 2))
        for key in ("focal_length", "principal_point", "image_size")
    )
    names = content.get("names")
    if not (isinstance(names, list) and len(names) == count):
        names = [""] * count
    if not ((size >= 1) & (size == np.floor(size))).all():
        raise SceneError("arguments.image_size must be integers of at least 1, height first")
    if own.get("in_ndc", True):
        half = size.min(axis=1, keepdims=True) / 2
        focal, middle = half * focal, size[:, ::-1] / 2 - half * middle
    projection = _CLASSES[content["class"]]
    found = []
    for k, name in enumerate(map(str, names)):
        height, width = map(int, size[k])
        found.append(
            frame.pinhole(
                frame.matrix_of(*focal[k], *middle[k]),
                frame.pose(r[k].T, t[k]),
                (width, height),
                name,
                frame.LEFT_UP,
                projection,
            )
        )
    return found


PYTORCH3D = Convention(
    "pytorch3d",
    "PyTorch3D",
    "cameras.json",
    (SHIFT, ASPECT, PARALLEL),
    False,
    _write,
    lambda source: source.object.get("class") in tuple(_CLASSES),
    _read,
)

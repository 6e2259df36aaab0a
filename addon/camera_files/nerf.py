"""NeRF: `transforms.json`, as instant-ngp and nerfstudio read it.

Source: nerfstudio, "Data conventions"; instant-ngp, `nerf_loader.cpp` (`read_focal_length`) and
`docs/nerf_dataset_tips.md`. `transform_matrix` is world from camera, with OpenGL's camera space:
+Y up, -Z forward; the world has Z up. (u, v) = (fl_x x / -z + cx, -fl_y y / -z + cy).

The files do not say where a pixel's centre is. instant-ngp and nerfstudio trace pixel (i, j) at
(i + 0.5, j + 0.5), so this is read and written; the code of the first NeRF traced it at (i, j),
half a pixel beside what its own pictures show.

`x_fov` (degrees) comes before `fl_x` (pixels), and that before `camera_angle_x` (radians), as in
instant-ngp; what says neither cx nor cy has them in the picture's middle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..files.checked_json import Content, number, numbers, objects
from ..projections import PERSPECTIVE, PROJECTIONS
from ..scene import SceneError
from . import frame
from .convention import HALF, Convention, Files, Size, Source, View
from .features import ASPECT, SHIFT
from .json_files import (
    CENTERS_KEY,
    dumped,
    first_center,
    has,
    offset_of,
    radians_of,
    refuse_lens,
)

# Of another projection if they are there at all, also as 0 or false.
_OTHER_PROJECTIONS = {"ftheta_p0", "latlong"} | PROJECTIONS.keys() - {PERSPECTIVE.name}
_MODELS = "OPENCV", "PINHOLE", "SIMPLE_PINHOLE"


def _write(views: Sequence[View], centers: str) -> Files:
    lenses = [_lens(view, offset_of(centers)) for view in views]
    shared = all(lens == lenses[0] for lens in lenses)
    head: Content = {"camera_model": "PINHOLE"}
    if centers != HALF:
        head[CENTERS_KEY] = centers
    frames = [_pose(view) for view in views]
    if shared:
        head |= lenses[0]
    else:
        frames = [lens | pose for lens, pose in zip(lenses, frames, strict=True)]
    return {"": dumped(head | {"frames": frames})}


def _pose(view: View) -> Content:
    matrix = view.camera.world_from_camera
    return {"file_path": f"images/{view.name}", "transform_matrix": matrix.tolist()}


def _lens(view: View, offset: float) -> Content:
    camera = view.camera
    fx, fy, cx, cy = frame.intrinsics(camera)
    return {
        "w": camera.width,
        "h": camera.height,
        "fl_x": fx,
        "fl_y": fy,
        "cx": cx + offset,
        "cy": cy + offset,
        "camera_angle_x": 2 * np.arctan(camera.width / 2 / fx),
        "camera_angle_y": 2 * np.arctan(camera.height / 2 / fy),
    }


def _read(source: Source) -> list[View]:
    content = source.object
    notes = [
        f"{key} is not undone: the world is the file's own"
        for key in ("applied_transform", "applied_scale")
        if key in content
    ]
    if content.get("rolling_shutter"):
        notes.append("rolling_shutter is not applied: a camera does not move within a picture")
    return [
        _view(content | body, where, source, tuple(notes))
        for body, where in objects(content, "frames")
    ]


def _view(body: Content, where: str, source: Source, notes: tuple[str, ...]) -> View:
    size = source.whole_size(body, where, ("w", "h"))
    others = [key for key in sorted(_OTHER_PROJECTIONS) if key in body]
    if body.get("camera_model", _MODELS[0]) not in _MODELS:
        others.append("camera_model")
    refuse_lens(body, where, others)
    center = first_center(body)
    fx, fy = _focal_lengths(body, where, size)
    middle = [
        number(body, key, where) + 0.5 - center if key in body else n / 2
        for key, n in zip(("cx", "cy"), size, strict=True)
    ]
    world = np.eye(4)
    rows = numbers(body, "transform_matrix", where, None)
    if rows.shape not in ((3, 4), (4, 4)):
        raise SceneError(f"{where}transform_matrix must be 4 x 4 or 3 x 4 finite numbers")
    world[: len(rows)] = rows
    name = str(body.get("file_path", "")).replace("\\", "/").rpartition("/")[2]
    k = frame.matrix_of(fx, fy, *middle)
    matrix = frame.inverse(world)
    return replace(frame.pinhole(k, matrix, size, name, np.eye(4)), notes=notes)


def _focal_lengths(body: Content, where: str, size: Size) -> tuple[float, float]:
    """Return both focal lengths in pixels; a missing one is equal to the other."""
    found = []
    for axis, n in zip("xy", size, strict=True):
        if f"{axis}_fov" in body:
            angle = np.radians(number(body, f"{axis}_fov", where))
        elif f"fl_{axis}" in body:
            found.append(number(body, f"fl_{axis}", where))
            continue
        elif f"camera_angle_{axis}" in body:
            angle = radians_of(body, f"camera_angle_{axis}", where)
        else:
            found.append(0.0)
            continue
        found.append(n / 2 / np.tan(angle / 2))
    x, y = found
    if not (x or y):
        raise SceneError(f"{where}fl_x and camera_angle_x are missing: it says no focal length")
    return x or y, y or x


NERF = Convention(
    "nerf",
    "NeRF (instant-ngp, nerfstudio)",
    "transforms.json",
    (SHIFT, ASPECT),
    True,
    _write,
    lambda source: has(source, "transform_matrix"),
    _read,
)

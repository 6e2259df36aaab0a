"""OpenCV: x = K (R X + t), the default of `reftrace camera`.

Source: OpenCV, calib3d, "Detailed Description", the pinhole camera model: camera space has +X to
the right, +Y down and +Z forward, and (u, v) = (fx x/z + cx, fy y/z + cy). Its documents do not say
where a pixel's centre is; its functions put the first one's at (0, 0) (`initUndistortRectifyMap`
takes the integers u, v for pixels). COLMAP, NeRF and renderers put it at (0.5, 0.5), which is the
default here. The file says which.

OpenCV has no file of its own for K, R and t together: this JSON is ours.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..files.checked_json import Content, numbers
from ..projections import ORTHOGRAPHIC, PERSPECTIVE, PROJECTIONS
from ..scene import Camera
from . import frame
from .convention import Convention, Files, Source, View
from .features import ASPECT, MIRRORED, SHIFT
from .json_files import (
    CENTERS_KEY,
    bodies,
    clip_end,
    clip_of,
    first_center,
    flat,
    has,
    of_frame,
    offset_of,
    one_of,
    refuse_lens,
    written,
)

_FORMULA = (
    "x = K (R X + t); (x0 / x2, x1 / x2) is in pixels from the picture's upper left, rows downwards"
)


def _write(views: Sequence[View], centers: str) -> Files:
    head = {"convention": "opencv", "formula": _FORMULA, CENTERS_KEY: centers}
    return written(head, views, lambda view: body_of(view.camera, offset_of(centers)))


def body_of(camera: Camera, offset: float = 0.0) -> Content:
    """Return K, R, t and the clip range.

    Of an orthographic camera K is of pixels a metre, and x = K (X0, X1, 1) of R X + t: OpenCV has
    no such camera, and the conformance kit's files say `projection`.

    Parameters
    ----------
    camera : Camera
    offset : float
        What is added to the principal point, pixels.
    """
    matrix = frame.camera_from_world(camera)
    k = frame.k_of(camera, offset)
    if np.linalg.det(matrix[:3, :3]) < 0:  # mirrored: R stays a rotation, and u counts backwards
        k[0, 0] *= -1
        matrix[0] *= -1
    return {
        "K": k.tolist(),
        "R": matrix[:3, :3].tolist(),
        "t": matrix[:3, 3].tolist(),
        "clip_start": camera.clip_start,
        "clip_end": clip_end(camera),
    }


def _read(source: Source) -> list[View]:
    content = source.object
    center = first_center(content)
    return [_view(content | body, where, center, source) for body, where in bodies(content)]


def _view(body: Content, where: str, center: float, source: Source) -> View:
    refuse_lens(body, where)
    k = numbers(body, "K", where, (3, 3))
    matrix = frame.pose(numbers(body, "R", where, (3, 3)), flat(body, "t", where, 3))
    if one_of(body, "up", where, ("z", "y")) == "y":
        matrix = matrix @ frame.Y_UP_FROM_Z_UP
    kind = one_of(body, "projection", where, (PERSPECTIVE.name, ORTHOGRAPHIC.name))
    view = frame.pinhole(
        k,
        matrix,
        source.whole_size(body, where),
        str(body.get("name", "")),
        projection=PROJECTIONS[kind],
        center=center,
        clip=clip_of(body, where),
    )
    return of_frame(body, view)


OPENCV = Convention(
    "opencv",
    "OpenCV",
    "camera.json",
    (SHIFT, ASPECT, MIRRORED),
    True,
    _write,
    lambda source: has(source, "K", "R", "t"),
    _read,
)

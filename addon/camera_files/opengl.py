"""OpenGL: clip = projection · view · X, the matrices that a program loads.

Source: Khronos, OpenGL 4.6 Core Profile Specification, 13.8 and 13.8.1: (x, y, z) of the clip
coordinates divided by their w are from -1 to 1 in the picture, +y up, and the window's x is
(x + 1) width / 2 from its left edge, y from its lower edge. Camera space, which the specification
leaves to the program, is that of the compatibility profile's `glFrustum`: +Y up, -Z forward. There
are no files of matrices: this JSON is ours, row by row.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from ..files.checked_json import Content, numbers
from ..projections import ORTHOGRAPHIC, PERSPECTIVE
from ..scene import Camera, SceneError, ViewWindow
from . import frame
from .convention import Clip, Convention, Source, View
from .features import ASPECT, MIRRORED, PARALLEL, SHEARED, SHIFT
from .json_files import bodies, has, of_frame, refuse_lens, written

_FORMULA = (
    "clip = projection view (X, 1); (clip0 / clip3, clip1 / clip3) is from -1 to 1 in the picture, "
    "from the left and upwards"
)


def _body(view: View) -> Content:
    camera = view.camera
    return {
        "projection": projection(camera).tolist(),
        "view": frame.inverse(camera.world_from_camera).tolist(),
    }


def projection(camera: Camera) -> Floats:
    """Return the matrix from camera space to clip coordinates, (4, 4), as `glFrustum` has it.

    An infinite clip end is the limit of that.
    """
    near, far = camera.clip_start, camera.clip_end
    width, height = camera.window.size
    x, y = camera.window.centre
    out = np.zeros((4, 4))
    out[0, 0] = 2 / width
    out[1, 1] = 2 / height
    middle = 2 * x / width, 2 * y / height
    depth = far - near
    if camera.projection is ORTHOGRAPHIC:
        out[:2, 3] = -middle[0], -middle[1]
        out[2, 2:] = -2 / depth, -(near / depth + far / depth)
        out[3, 3] = 1
    else:
        out[:2, 2] = middle
        out[2, 2:] = -1.0, -2 * near
        if far != np.inf:
            out[2, 2:] = -(far + near) / depth, -2 * far / depth * near
        out[3, 2] = -1
    return out


def _view(body: Content, where: str, source: Source) -> View:
    body = source.object | body
    refuse_lens(body, where)
    p = numbers(body, "projection", where, (4, 4))
    world = frame.inverse(numbers(body, "view", where, (4, 4)))
    parallel = np.array_equal(p[3], (0, 0, 0, 1))
    other = 2 if parallel else 3  # the column that has to be 0
    if not parallel and not np.array_equal(p[3], (0, 0, -1, 0)):
        raise SceneError(f"{where}projection must end in the row 0 0 -1 0, or 0 0 0 1")
    if p[0, other] or p[1, other] or p[1, 0] or p[2, 0] or p[2, 1] or not p[0, 0] * p[1, 1]:
        raise SceneError(f"{where}projection is not of the form that glFrustum or glOrtho makes")
    # x on the window is X / -Z, or X: where the projection has -1 and 1 are its edges.
    ends = np.diag(p)[:2]
    a = np.abs(ends)
    middle = -p[:2, 3] if parallel else p[:2, 2]
    low, high = (middle - 1) / a, (middle + 1) / a
    plain = np.diag((*np.sign(ends), 1.0, 1.0))
    plain[0, 1] = p[0, 1] / a[0]
    view = frame.seen_from(
        world @ np.linalg.inv(plain),
        ViewWindow(low[0], high[0], low[1], high[1]),
        source.whole_size(body, where),
        str(body.get("name", "")),
        ORTHOGRAPHIC if parallel else PERSPECTIVE,
        _clip(p, parallel, where),
    )
    return of_frame(body, view)


def _clip(p: Floats, parallel: bool, where: str) -> Clip:
    """Return the depths that a projection has at -1 and 1."""
    c, d = p[2, 2:]
    near, far = ((d + 1) / c, (d - 1) / c) if parallel else (d / (c - 1), d / (c + 1))
    if c == -1 and not parallel:
        far = np.inf
    if not near < far:
        raise SceneError(
            f"{where}projection has its near plane at {near:g} and its far plane at {far:g}: "
            "depths from -1 to 1 are read, as OpenGL has them"
        )
    return near, far


OPENGL = Convention(
    "opengl",
    "OpenGL",
    "camera.json",
    (SHIFT, ASPECT, PARALLEL, MIRRORED, SHEARED),
    False,
    lambda views, _: written({"convention": "opengl", "formula": _FORMULA}, views, _body),
    lambda source: has(source, "projection", "view"),
    lambda source: [_view(body, where, source) for body, where in bodies(source.object)],
)

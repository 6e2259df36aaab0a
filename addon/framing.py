"""Cameras for scenes that have none: one that frames what is there, or one that is placed.

In come points in world space, or where the eye is and what it looks at; out goes a `scene.Camera`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .projections import ORTHOGRAPHIC, PERSPECTIVE
from .scene import Camera, SceneError, ViewWindow, check_size

ANGLE = 50.0  # vertical angle of view, degrees
FILLED = 0.9  # share of the picture's width or height that is filled by what is framed
# From what is framed towards the eye: the front, the right and above, as of a new Blender scene.
BACKWARD = 0.66, -0.62, 0.42
UP = 0.0, 0.0, 1.0
NEAREST = 0.01  # depth of the nearest point at least, in sizes of all that is framed


def framing(
    parts: Iterable[NDArray[np.floating]],
    backward: ArrayLike,
    up: ArrayLike,
    width: int,
    height: int,
    angle: float | None = ANGLE,
    tall: float = 1.0,
) -> Camera:
    """Return the camera that sees all points as large as nine tenths of the picture allow.

    Each side of the view volume bounds the eye linearly, so that the nearest eye is exact. What is
    framed spans that share of the picture's width or of its height, unless it would come nearer to
    the eye than a hundredth of its own size.

    Parameters
    ----------
    parts : iterable of (n, 3) float
        Points in world space, looked at one part after the other. Those that are not finite are
        left out.
    backward, up : (3,) float
        Towards the eye, and what is up in the picture, in world space; of any length.
    width, height : int
        Of the picture, in pixels.
    angle : float or None
        Vertical angle of view in degrees; None for an orthographic camera.
    tall : float
        Height of a pixel, in widths.

    Raises
    ------
    SceneError
        If there is no point, the direction is zero, or the picture has no pixel.
    """
    check_size(width, height)
    half = FILLED if angle is None else FILLED * np.tan(np.radians(angle) / 2)
    aspect = width / (tall * height)
    slope = np.array((half * aspect, half))  # of the sides that are to be touched
    axes = axes_of(backward, up)
    ends, center = np.full((5, 2), -np.inf), None
    for part in parts:
        points = np.asarray(part, np.float64)
        points = points[np.isfinite(points).all(axis=1)]
        if not len(points):
            continue
        if center is None:  # near all of them, as what is far from the origin loses digits
            center = points[0]
        at = (points - center) @ axes
        across, depth = at[:, :2], -at[:, 2:]
        bounds = across, -across, across - slope * depth, -across - slope * depth
        deep = np.array((depth.max(), -depth.min()))
        ends = np.maximum(ends, np.stack((*(b.max(axis=0) for b in bounds), deep)))
    if center is None:
        raise SceneError("There is nothing to frame: no triangle is shown.")
    high, low, right, left, (far, near) = ends
    low, near = -low, -near
    size = max(*(high - low), far - near, 1e6 * np.spacing(np.abs(center).max()), 1e-30)
    if angle is None:
        middle, eye = (high + low) / 2, near - size
        half = max(*((high - low) / 2 / slope), NEAREST * size)
    else:
        middle = (right - left) / 2
        eye = min(*(-(right + left) / (2 * slope)), near - NEAREST * size)
        half /= FILLED
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = axes, center + axes @ (*middle, -eye)
    window = ViewWindow(-half * aspect, half * aspect, -half, half)
    clip = (near - eye) / 2, (far - eye) * 2
    projection = ORTHOGRAPHIC if angle is None else PERSPECTIVE
    return Camera(matrix, window, width, height, projection, *clip, name="framing")


def placed(
    eye: Sequence[float],
    target: Sequence[float],
    width: int,
    height: int,
    angle: float = ANGLE,
    ortho_scale: float | None = None,
    tall: float = 1.0,
) -> Camera:
    """Return a camera at a point that looks at another; what is up is as in :func:`framing`.

    `ortho_scale` is the height of the picture in metres, and makes the camera orthographic.

    Raises
    ------
    SceneError
        If the two are one point, or the picture has no pixel.
    """
    check_size(width, height)
    half = np.tan(np.radians(angle) / 2) if ortho_scale is None else ortho_scale / 2
    backward = np.subtract(eye, target, dtype=np.float64)
    distance = float(np.linalg.norm(backward))
    if not distance:
        raise SceneError("--eye and --target are the same point: move one of them.")
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = axes_of(backward, UP), eye
    wide = half * width / (tall * height)
    window = ViewWindow(-wide, wide, -half, half)
    projection = PERSPECTIVE if ortho_scale is None else ORTHOGRAPHIC
    clip = distance * 1e-3, distance * 1e3
    return Camera(matrix, window, width, height, projection, *clip, name="--eye")


def axes_of(backward: ArrayLike, up: ArrayLike) -> NDArray[np.float64]:
    """Return right, up and backward of a camera as columns, (3, 3).

    Where `up` is along the view, it is the last of the axes that are most across it.

    Raises
    ------
    SceneError
        If the direction is zero or not finite.
    """
    backward, right = np.asarray(backward, np.float64), np.cross(up, backward)
    if not right.any():
        right = np.cross(np.eye(3)[2 - np.argmin(np.abs(backward[::-1]))], backward)
    axes = np.stack((right, np.cross(backward, right), backward), axis=1)
    lengths = np.linalg.norm(axes, axis=0)
    if not (lengths.all() and np.isfinite(lengths).all()):
        raise SceneError(f"{backward}, from what is looked at to the eye, is zero or not finite.")
    return axes / lengths

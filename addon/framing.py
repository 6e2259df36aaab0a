"""Cameras for scenes that have none: one that frames what is there, or one that is placed.

In come points in world space, or where the eye is and what it looks at; out goes a `scene.Camera`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .projections import ORTHOGRAPHIC, PERSPECTIVE
from .scene import Camera, Instance, Mesh, SceneError, ViewWindow, check_size
from .tracer.vector import transform_points

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
    angle: float = ANGLE,
    tall: float = 1.0,
) -> Camera:
    """Return the camera that sees all points as large as nine tenths of the picture allow.

    Each side of the view volume bounds the eye linearly, so that the nearest eye is exact. What is
    framed spans that share of the picture's width or of its height, unless it would come nearer to
    the eye than a hundredth of its own size.

    Parameters
    ----------
    parts : iterable of (n, 3) float
        Points in world space, finite, looked at one part after the other.
    backward, up : (3,) float
        Towards the eye, and what is up in the picture, in world space; of any length.
    width, height : int
        Of the picture, in pixels.
    angle : float
        Vertical angle of view in degrees.
    tall : float
        Height of a pixel, in widths.

    Raises
    ------
    SceneError
        If there is no point, the direction is zero, or the picture has no pixel.
    """
    check_size(width, height)
    half = np.tan(np.radians(angle) / 2)
    aspect = width / (tall * height)
    slope = FILLED * np.array((half * aspect, half))  # of the sides that are to be touched
    flat = np.concatenate((np.eye(2), -np.eye(2)))
    tilted = np.column_stack((flat, np.tile(slope, 2)))
    bounds = np.concatenate((np.pad(flat, ((0, 0), (0, 1))), tilted, [(0, 0, 1), (0, 0, -1)]))
    axes = axes_of(backward, up)
    ends, center = np.full(len(bounds), -np.inf), None
    for points in parts:
        if len(points):
            if center is None:  # near all of them, as what is far from the origin loses digits
                center = np.asarray(points[0], np.float64)
            ends = np.maximum(ends, ((points - center) @ (axes @ bounds.T)).max(axis=0))
    if center is None:
        raise SceneError("There is nothing to frame: no triangle is shown.")
    (high, low, right, left), (near, far) = ends[:8].reshape(4, 2), ends[8:] * (-1, 1)
    size = max(*(high + low), far - near, 1e6 * np.spacing(np.abs(center).max()), 1e-30)
    eye = min(*(-(right + left) / (2 * slope)), near - NEAREST * size)
    middle = (right - left) / 2
    at, clip = center + axes @ (*middle, -eye), ((near - eye) / 2, (far - eye) * 2)
    return _camera("framing", axes, at, width, height, half, aspect, PERSPECTIVE, clip)


def shown_points(
    meshes: Sequence[Mesh], instances: Iterable[Instance]
) -> Iterator[NDArray[np.float64]]:
    """Yield the corners of each instance's triangles in world space, (n, 3)."""
    used = []
    for mesh in meshes:
        is_used = np.zeros(len(mesh.vertices), bool)
        is_used[mesh.triangles] = True
        used.append(mesh.vertices[is_used].T.astype(np.float64))
    for instance in instances:
        yield transform_points(instance.world_from_object, used[instance.mesh]).T


@dataclass(frozen=True)
class Choice:
    """What of a file is looked at, through which camera; of a .blend, `blender.choice` makes it so.

    What is None is as the file was saved, or is found from its meshes.
    """

    scene_name: str | None = None  # this and the next three are of a .blend
    view_layer: str | None = None
    frame: int | None = None
    camera: str | None = None  # the name of one that is there
    frame_all: bool = False  # or one that frames all
    eye: Sequence[float] | None = None  # or one that is placed, up as in :func:`framing`
    target: Sequence[float] | None = None  # where it looks; None for the origin
    angle: float | None = None  # vertical, degrees
    ortho_scale: float | None = None  # height of the picture, metres
    width: int | None = None  # of the picture, pixels; of a .blend, the other follows from one
    height: int | None = None
    up: str | None = None  # which axis of a mesh's file is
    default_size: tuple[int, int] = (960, 540)  # of a mesh's picture
    opened: bool = False  # the file is open, in the Blender that runs this

    def placed(self, width: int, height: int, tall: float = 1.0) -> Camera:
        """Return the camera at `eye`, for a picture as of :func:`framing`.

        Raises
        ------
        SceneError
            If eye and target are one point, or the picture has no pixel.
        """
        check_size(width, height)
        projection = PERSPECTIVE if self.ortho_scale is None else ORTHOGRAPHIC
        if self.ortho_scale is None:
            half = np.tan(np.radians(self.angle or ANGLE) / 2)
        else:
            half = self.ortho_scale / 2
        target = (0, 0, 0) if self.target is None else self.target
        backward = np.subtract(self.eye, target, dtype=np.float64)
        distance = float(np.linalg.norm(backward))
        if not distance:
            raise SceneError("--eye and --target are the same point: move one of them.")
        aspect, clip = width / (tall * height), (distance * 1e-3, distance * 1e3)
        axes = axes_of(backward, UP)
        return _camera("--eye", axes, self.eye, width, height, half, aspect, projection, clip)


def _camera(name, axes, at, width, height, half, aspect, projection, clip) -> Camera:
    """Return a camera whose picture is 2 `half` high, at depth 1 or in metres."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = axes, at
    window = ViewWindow(-half * aspect, half * aspect, -half, half)
    return Camera(matrix, window, width, height, projection, *clip, name=name)


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

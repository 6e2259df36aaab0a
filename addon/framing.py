"""Makes cameras for scenes that have none: one that frames all objects, or one that is placed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from .arrays import Floats
from .camera_files.convention import View
from .camera_files.frame import pose
from .projections import ORTHOGRAPHIC, PERSPECTIVE, Projection
from .scene import Camera, Instance, Mesh, SceneError, ViewWindow, check_size
from .tracer.vector import transform_points

ANGLE = 50.0  # vertical angle of view, degrees
FRAMED = "framing"  # the name of a camera that is placed so that it sees all
SIZE = 960, 540  # of a mesh's picture, pixels
FILLED = 0.9  # share of the picture's width or height that is filled by what is framed
# From what is framed towards the eye: the front, the right and above, as of a new Blender scene.
BACKWARD = 0.66, -0.62, 0.42
NEAREST = 0.01  # depth of the nearest point at least, in sizes of all that is framed


def framing(
    parts: Iterable[Floats],
    axes: Floats,
    width: int,
    height: int,
    angle: float = ANGLE,
    tall: float = 1.0,
) -> Camera:
    """Return the camera that sees all points as large as nine tenths of the picture allow.

    Each side of the view volume bounds the eye's position linearly, so the nearest eye is exact.
    What is framed spans nine tenths of the picture's width or of its height, unless it would come
    nearer to the eye than a hundredth of its own size.

    Parameters
    ----------
    parts : iterable of (n, 3) float
        Points in world space, finite, read one part after the other.
    axes : (3, 3) float64
        The camera's right, up and backward as columns, in world space: see :func:`axes_of`.
    width, height : int
        Of the picture, in pixels.
    angle : float
        Vertical angle of view in degrees.
    tall : float
        Height of a pixel, in widths.

    Raises
    ------
    SceneError
        If there is no point, or the picture has no pixel.
    """
    window = _window(_half(angle), width, height, tall)
    slope = FILLED * np.array((window.right, window.top))  # of the sides that are to be touched
    center, ends = _extents(parts, axes, slope)
    high, low, right, left = ends[:8].reshape(4, 2)
    near, far = ends[8:] * (-1, 1)
    size = max(*(high + low), far - near, 1e6 * np.spacing(np.abs(center).max()), 1e-30)
    eye = min(*(-(right + left) / (2 * slope)), near - NEAREST * size)
    at = center + axes @ (*((right - left) / 2), -eye)
    return Camera(
        pose(axes, at),
        window,
        width,
        height,
        PERSPECTIVE,
        clip_start=(near - eye) / 2,
        clip_end=(far - eye) * 2,
        name=FRAMED,
    )


def _extents(parts: Iterable[Floats], axes: Floats, slope: Floats) -> tuple[Floats, Floats]:
    """Return a point, and how far all points reach from it in ten directions of the camera.

    Along x, y, -x and -y; along the same, tilted by the slopes; and along z and -z.
    """
    flat = np.concatenate((np.eye(2), -np.eye(2)))
    tilted = np.column_stack((flat, np.tile(slope, 2)))
    bounds = np.concatenate((np.pad(flat, ((0, 0), (0, 1))), tilted, [(0, 0, 1), (0, 0, -1)]))
    ends = np.full(len(bounds), -np.inf)
    center = None
    for points in parts:
        if len(points):
            if center is None:  # near all of them, as what is far from the origin loses digits
                center = np.asarray(points[0], np.float64)
            ends = np.maximum(ends, ((points - center) @ (axes @ bounds.T)).max(axis=0))
    if center is None:
        raise SceneError("There is nothing to frame: no triangle is shown.")
    return center, ends


def shown_points(meshes: Sequence[Mesh], instances: Iterable[Instance]) -> Iterator[Floats]:
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
    """The choice of what to look at in a file, and of the camera; None for the file's own.

    Of a .blend, `blender.choice` sets it in the open file.
    """

    # Of a .blend alone.
    scene_name: str | None = None
    view_layer: str | None = None
    frame: int | None = None
    camera: str | None = None  # the name of one that is there
    # A file's camera, or one for each frame.
    seen_by: View | None = None
    views: Sequence[View] = field(default=(), repr=False)
    # A new camera: one that frames all, or one that is placed.
    frame_all: bool = False
    eye: Sequence[float] | None = None  # metres; up is as in :func:`framing`
    target: Sequence[float] | None = None  # where it looks; None for the origin
    angle: float | None = None  # vertical, degrees
    ortho_scale: float | None = None  # height of the picture, metres
    # The picture, pixels: if one is given, the other follows.
    width: int | None = None
    height: int | None = None
    up: str | None = None  # which axis of a mesh's file is up
    opened: bool = False  # the file is open, in the Blender that runs this

    def size(self, own: tuple[int, int]) -> tuple[int, int]:
        """Return the width and height that are chosen of a picture that has its own, pixels."""
        across, up = own
        if self.width is None and self.height is not None:
            return max(1, round(self.height * across / up)), self.height
        width = across if self.width is None else self.width
        return width, max(1, round(width * up / across)) if self.height is None else self.height

    def placed(self, width: int, height: int, tall: float = 1.0) -> Camera:
        """Return the camera at `eye`, for a picture as of :func:`framing`.

        Raises
        ------
        SceneError
            If eye and target are one point, or the picture has no pixel.
        """
        projection: Projection = PERSPECTIVE
        half = _half(self.angle or ANGLE)
        if self.ortho_scale is not None:
            projection = ORTHOGRAPHIC
            half = self.ortho_scale / 2
        eye = np.asarray(self.eye, np.float64)
        target = (0, 0, 0) if self.target is None else self.target
        backward = eye - np.asarray(target, np.float64)
        distance = float(np.linalg.norm(backward))
        if not distance:
            raise SceneError("eye and target are the same point: move one of them.")
        return Camera(
            pose(axes_of(backward), eye),
            _window(half, width, height, tall),
            width,
            height,
            projection,
            clip_start=distance * 1e-3,
            clip_end=distance * 1e3,
            name="eye",
        )


def _half(angle: float) -> float:
    """Return half the height of what an angle in degrees sees at depth 1."""
    return float(np.tan(np.radians(angle) / 2))


def _window(half: float, width: int, height: int, tall: float) -> ViewWindow:
    """Return the window of a picture that is 2 `half` high, at depth 1 or in metres.

    Raises
    ------
    SceneError
        If the picture has no pixel.
    """
    check_size(width, height)
    right = half * (width / (tall * height))
    return ViewWindow(-right, right, -half, half)


def axes_of(backward: ArrayLike) -> Floats:
    """Return right, up and backward of a camera as columns, (3, 3), with Z up in the picture.

    `backward` is towards the eye in world space, (3,) float, of any length. If it is along Z, then
    Y is up.

    Raises
    ------
    SceneError
        If `backward` is zero or not finite.
    """
    back = np.asarray(backward, np.float64)
    right = np.cross((0.0, 0.0, 1.0), back)
    if not right.any():
        right = np.cross((0.0, 1.0, 0.0), back)
    axes = np.stack((right, np.cross(back, right), back), axis=1)
    lengths = np.linalg.norm(axes, axis=0)
    if not (lengths.all() and np.isfinite(lengths).all()):
        raise SceneError(f"{back}, from the target to the eye, is zero or not finite.")
    return axes / lengths

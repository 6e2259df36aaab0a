"""Between a camera's view window and axes, and the numbers of other conventions.

Film positions (u, v) are pixels from the upper left corner of the picture, v downwards, so that the
first pixel's centre is (0.5, 0.5). With (x, y) on the view window (see `scene.ViewWindow`)

    u = fx x + cx     v = -fy y + cy
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..arrays import Floats
from ..projections import ORTHOGRAPHIC, PERSPECTIVE, Projection
from ..scene import Camera, Region, SceneError, ViewWindow
from ..tracer.camera import pixel_size
from .convention import Clip, Size, View

# Blender's and OpenGL's camera space has +Y up and -Z forward; OpenCV's has +Y down, +Z forward.
# This takes one to the other, and back.
OPENCV = np.diag((1.0, -1.0, -1.0, 1.0))
# PyTorch3D's and Mitsuba's has +X left, +Y up, +Z forward.
LEFT_UP = np.diag((-1.0, 1.0, -1.0, 1.0))
# Takes Blender's world, with Z up, to one with Y up: (x, y, z) is (x, z, -y) there.
Y_UP_FROM_Z_UP = np.array(((1.0, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
# Where a file says no clip range: nothing but what is in the eye itself is left out.
FARTHEST = 1e12
_UNCLIPPED = 1e-6, FARTHEST
# How far rounding may leave the last row of a matrix from 0 0 0 1, in its own numbers.
_AFFINE = 1e-6
# The cosine of half an angle that is half a turn but for its rounding.
_HALF_TURN = 5e-5


def intrinsics(camera: Camera) -> tuple[float, float, float, float]:
    """Return fx, fy, cx, cy: pixels; of an orthographic camera fx, fy are pixels a metre."""
    width, height = pixel_size(camera)
    return 1 / width, 1 / height, -camera.window.left / width, camera.window.top / height


def matrix_of(fx: float, fy: float, cx: float, cy: float) -> Floats:
    """Return K, (3, 3)."""
    return np.array([(fx, 0.0, cx), (0.0, fy, cy), (0.0, 0.0, 1.0)])


def k_of(camera: Camera, offset: float = 0.0) -> Floats:
    """Return a camera's K, (3, 3); `offset` is added to its principal point, pixels."""
    fx, fy, cx, cy = intrinsics(camera)
    return matrix_of(fx, fy, cx + offset, cy + offset)


def pose(rotation: Floats, translation: Floats) -> Floats:
    """Return the matrix (4, 4) that rotates, (3, 3), and then moves, (3,)."""
    out = np.eye(4)
    out[:3, :3] = rotation
    out[:3, 3] = translation
    return out


def of_quaternion(w: float, x: float, y: float, z: float) -> Floats:
    """Return the rotation (3, 3) of a unit quaternion."""
    return np.array(
        (
            (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
        )
    )


def quaternion(r: Floats) -> Floats:
    """Return the unit quaternion (w, x, y, z) of a rotation (3, 3), w at least 0.

    It is the eigenvector of the largest eigenvalue of Bar-Itzhack's matrix (AIAA Journal of
    Guidance 23, 2000), which is well conditioned for every angle.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = r
    k = np.array(
        (
            (xx + yy + zz, 0.0, 0.0, 0.0),
            (zy - yz, xx - yy - zz, 0.0, 0.0),
            (xz - zx, yx + xy, yy - xx - zz, 0.0),
            (yx - xy, zx + xz, zy + yz, zz - xx - yy),
        )
    )
    _, vectors = np.linalg.eigh(k)  # of the lower triangle
    q: Floats = vectors[:, -1]
    return -q if q[0] < 0 else q


def rotation_vector(r: Floats) -> Floats:
    """Return the axis of a rotation (3, 3), as long as its angle in radians, (3,).

    Half a turn is the same about both ends of its axis: its largest component is positive.
    """
    w, x, y, z = quaternion(r)
    along = np.array((x, y, z))
    size = np.linalg.norm(along)
    if w < _HALF_TURN and along[np.argmax(np.abs(along))] < 0:
        along = -along
    return along * (2 * np.arctan2(size, w) / size if size else 2.0)


def camera_from_world(camera: Camera, axes: Floats = OPENCV) -> Floats:
    """Return the matrix that takes world space to a camera space, (4, 4)."""
    return axes @ inverse(camera.world_from_camera)


def inverse(matrix: Floats) -> Floats:
    """Return the inverse of a transform, (4, 4).

    Raises
    ------
    SceneError
        If it has none.
    """
    try:
        return np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        raise SceneError("its matrix has no inverse: the axes lie in a plane") from None


def pinhole(
    k: Floats,
    camera_from_world: Floats,
    size: Size,
    name: str,
    axes: Floats = OPENCV,
    projection: Projection = PERSPECTIVE,
    center: float = 0.5,
    clip: Clip | None = None,
) -> View:
    """Return the view of K (3, 3) and a matrix (4, 4) into a camera space.

    K has the centre of the first pixel at (center, center), and any scale: it is of homogeneous
    coordinates. Where its last number is negative, depths before the camera are (as in Kubric). A
    negative focal length or a skew is applied: the camera's axes are mirrored or sheared by it.

    Raises
    ------
    SceneError
        If K is none, or the matrix has no inverse.
    """
    if k[1, 0] or k[2, 0] or k[2, 1] or not (k[0, 0] and k[1, 1] and k[2, 2]):
        raise SceneError("its K is not of the form [[fx, skew, cx], [0, fy, cy], [0, 0, 1]]")
    if (np.diag(k) < 0).all():
        k = -k  # a negative scale
    depth = np.diag((1.0, 1.0, np.sign(k[2, 2]), 1.0))  # negative before a camera along -Z
    k = k / abs(k[2, 2]) @ depth[:3, :3]
    fx, fy, (cx, cy) = abs(k[0, 0]), abs(k[1, 1]), k[:2, 2] + (0.5 - center)
    plain = np.eye(4)
    plain[:2, :2] = k[:2, :2] / ((fx,), (fy,))
    width, height = size
    window = of_lens(fx, fy, cx, cy, width, height)
    # K is of OpenCV's camera space, and so is its skew.
    world = inverse(OPENCV @ plain @ depth @ OPENCV @ axes @ camera_from_world)
    return seen_from(world, window, size, name, projection, clip)


def of_lens(fx: float, fy: float, cx: float, cy: float, width: float, height: float) -> ViewWindow:
    """Return the view window of K's numbers in a picture of a size, all in pixels."""
    return ViewWindow(-cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy)


def seen_from(
    world_from_camera: Floats,
    window: ViewWindow,
    size: Size,
    name: str,
    projection: Projection,
    clip: Clip | None,
) -> View:
    """Return a view; a scale of its axes is taken into its window and clip range.

    A ray x right + y up + forward passes the same points if it is divided by forward's length.

    Raises
    ------
    SceneError
        If the matrix is none of a camera.
    """
    if not np.isfinite(world_from_camera).all():
        raise SceneError("its matrix is not of finite numbers")
    if not np.abs(world_from_camera[3] - (0, 0, 0, 1)).max() <= _AFFINE:
        raise SceneError("its matrix has another last row than 0 0 0 1")
    right, up, deep = np.linalg.norm(world_from_camera[:3, :3], axis=0)
    if not min(right, up, deep) > 0:
        raise SceneError("its matrix has an axis of length 0")
    matrix = np.array(world_from_camera, np.float64)
    matrix[:3, :3] /= (right, up, deep)
    unit = 1.0 if projection is ORTHOGRAPHIC else deep
    start, end = (deep * depth for depth in clip) if clip else _UNCLIPPED
    camera = Camera(
        matrix,
        window.scaled(right / unit, up / unit),
        *size,
        projection=projection,
        clip_start=start,
        clip_end=end,
        name=name or "Camera",
    )
    return View(camera, name, is_clipped=clip is not None)


def rotation_of(matrix: Floats) -> Floats:
    """Return the rotation that is nearest to a (3, 3) matrix."""
    u, _, v = np.linalg.svd(matrix)
    return u @ np.diag((1.0, 1.0, np.sign(np.linalg.det(u @ v)))) @ v


def part(camera: Camera) -> Camera:
    """Return the camera of the picture that holds only a camera's region."""
    region, (width, height) = camera.region, pixel_size(camera)
    left, bottom = camera.window.left, camera.window.bottom
    window = ViewWindow(
        left + region.x0 * width,
        left + region.x1 * width,
        bottom + region.y0 * height,
        bottom + region.y1 * height,
    )
    whole = Region(0, 0, region.width, region.height)
    return replace(camera, window=window, width=region.width, height=region.height, region=whole)


def centred(camera: Camera) -> Camera:
    """Return an orthographic camera with its shift in its place: it has the same rays."""
    x, y = camera.window.centre
    matrix = camera.world_from_camera.copy()
    matrix[:3, 3] += x * camera.right + y * camera.up
    return replace(camera, world_from_camera=matrix, window=camera.window.moved(-x, -y))

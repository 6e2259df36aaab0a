"""Faults of a camera's matrix: what a program makes of it that reads it in another convention.

A file has a camera's matrix in one of three camera spaces (`_SPACES`), as world from camera or as
camera from world, [R | t]. Each mistake is made in all of them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from ...arrays import Array
from ...camera_files.frame import LEFT_UP, OPENCV, Y_UP_FROM_Z_UP, pose
from ...scene import Camera
from .fault import Example, Fault, Option, Way, ways, with_option

Change = Callable[[Array], Array]  # of a matrix (4, 4)

_SPACES = np.eye(4), OPENCV, LEFT_UP  # Blender's and OpenGL's; OpenCV's; PyTorch3D's
_AXES = "X", "Y", "Z"


def _matrix(
    change: Change, space: Array = _SPACES[0], inverse: bool = False
) -> Callable[[Camera], Camera]:
    """Return a function that changes the matrix of a camera, as it is in a camera space.

    It is world from camera, or the `inverse`.
    """

    def changed(camera: Camera) -> Camera:
        world = camera.world_from_camera @ space
        world = _inverse(change(_inverse(world))) if inverse else change(world)
        return replace(camera, world_from_camera=world @ space)

    return changed


def _mirrored(*signs: float) -> Change:
    """Return a function that changes the signs of a camera's axes."""
    return lambda world: world * (*signs, 1)


def _read_wrongly(change: Change) -> Iterator[Way]:
    """Yield how a matrix is changed in a file, in any camera space, and in either direction."""
    for space in _SPACES:
        yield "", _matrix(change, space)
        yield "", _matrix(change, space, inverse=True)


def _between(first: Array, last: Array, world: Array) -> Array:
    """Change the world by `first`, and the camera's own axes by `last`."""
    return first @ world @ last


def _inverse(matrix: Array) -> Array:
    return np.asarray(np.linalg.inv(matrix))


def _transposed(matrix: Array) -> Array:
    """Transpose the rotation, and leave the place or t as it is."""
    return pose(matrix[:3, :3].T, matrix[:3, 3])


def _all_transposed(world: Array) -> Array:
    """Transpose the whole matrix; its last row is not read: the camera is at the origin."""
    return pose(world[:3, :3].T, np.zeros(3))


def _of_the_other(matrix: Array) -> Array:
    """Take the place for t, or t for the place: the last column is that of the inverse matrix."""
    return pose(matrix[:3, :3], _inverse(matrix)[:3, 3])


def _turned(rotation: Array) -> Iterator[Way]:
    """Yield a rotation of the world about its origin, and of the camera in its place."""
    yield "", _matrix(lambda world: rotation @ world)
    yield "", _matrix(lambda world: pose((rotation @ world)[:3, :3], world[:3, 3]))


def _quarters() -> Iterator[Way]:
    """Yield turns of the world about its axes, but by a quarter about X: that is Y up."""
    for k, axis in enumerate(_AXES):
        for quarters in (1, 2, 3) if k else (2,):
            turn = np.linalg.matrix_power(_quarter(k), quarters)
            by = {1: "a quarter", 2: "half a turn", 3: "three quarters"}[quarters]
            yield f"{by} about {axis}", _matrix(partial(np.matmul, turn))


def _quarter(axis: int) -> Array:
    """Return the rotation by a quarter about an axis, which takes the next axis to the last."""
    second, third = (axis + 1) % 3, (axis + 2) % 3
    out = np.eye(4)
    out[second, second] = out[third, third] = 0
    out[third, second], out[second, third] = 1, -1
    return out


def _left_handed() -> Iterator[Way]:
    """Yield the world with an axis mirrored, and a camera that is still a rotation."""
    for k, axis in enumerate(_AXES):
        for own in range(3):
            yield axis, _matrix(partial(_between, _mirror(k), _mirror(own)))


def _mirror(axis: int) -> Array:
    return np.diag(np.where(np.arange(4) == axis, -1.0, 1.0))


def flipped(camera: Camera, axis: int) -> Camera:
    """Mirror the view of a camera along axis 0 or 1 of the picture."""
    x, y = (-1, 1) if axis == 0 else (1, -1)
    turned = _matrix(_mirrored(x, y, 1))(camera)
    return replace(turned, window=camera.window.scaled(x, y))


_BACKWARDS = (
    ("", _matrix(_mirrored(1, 1, -1))),
    (
        " and +X to the left: PyTorch3D's and Mitsuba's axes in place of Blender's and OpenGL's, "
        "or the reverse",
        _matrix(_mirrored(-1, 1, -1)),
    ),
    (
        " and +Y down: OpenCV's axes in place of Blender's and OpenGL's, or the reverse",
        _matrix(_mirrored(1, -1, -1)),
    ),
)

MATRIX_FAULTS: tuple[Fault[Option], ...] = (
    Fault(
        "mirrored_x",
        "the picture is mirrored left to right",
        "Code that changes the sign of one axis alone mirrors the picture.",
        "check the sign of the camera's right axis, or of x on the film",
        *ways(("", _matrix(_mirrored(-1, 1, 1))), ("", lambda camera: flipped(camera, 0))),
        turns=True,
        examples=(Example("mirrored_x", "the camera mirrored left to right", with_option(0)),),
        witness="facebookresearch/pytorch3d#78",
    ),
    Fault(
        "mirrored_y",
        "the camera is mirrored upside down",
        "In OpenCV's cameras Y points down. Code that changes the sign of Y, and not "
        "that of Z with it, mirrors the camera.",
        "check the sign of the camera's up axis, or of y on the film",
        *ways(("", _matrix(_mirrored(1, -1, 1)))),
        examples=(Example("mirrored_y", "the camera mirrored upside down", with_option(0)),),
        witness="blitz-research/monkey2#358",
    ),
    Fault(
        "forward",
        "the camera looks along +Z in place of -Z{words}",
        "OpenCV's and COLMAP's cameras look along +Z, Blender's and OpenGL's along -Z.",
        "Blender's cameras look along their own -Z, with +Y up",
        *ways(*_BACKWARDS),
        words=", with another axis turned, too",
        witness="Siccity/GLTFUtility#92",
    ),
    Fault(
        "matrix_transposed",
        "the camera's rotation is transposed: R has its rows for its columns",
        "OpenGL and glTF store a matrix column by column, numpy and Blender's Python row"
        " by row; PyTorch3D multiplies rows by R.",
        "the axes right, up and backward are the columns of world_from_camera, and the rows of R "
        "in R X + t",
        *ways(*_read_wrongly(_transposed), ("", _matrix(_all_transposed))),
        examples=(Example("camera_transposed", "the camera's rotation inverted", with_option(0)),),
        witness="facebookresearch/pytorch3d#1183",
    ),
    Fault(
        "matrix_inverted",
        "the camera's matrix is inverted: camera-to-world in place of world-to-camera, or the "
        "reverse",
        "OpenCV and COLMAP store world-to-camera (the view matrix); Blender, and "
        "transforms.json of NeRF, camera-to-world.",
        "invert the view matrix once, not twice or never",
        *ways(*(("", _matrix(_inverse, space)) for space in _SPACES)),
        witness="isl-org/Open3D#1027",
    ),
    Fault(
        "place_for_translation",
        "the camera's place stands for t, which is -R times it, or the reverse",
        "In R X + t of OpenCV and COLMAP, t is the world's origin as the camera has it; in a "
        "camera-to-world matrix, the last column is the camera's place.",
        "t = -R C for a camera at C; C = -R^T t",
        *ways(*_read_wrongly(_of_the_other)),
        witness="facebookresearch/pytorch3d#1987",
    ),
    Fault(
        "y_up",
        "the camera is placed in a world with Y up, the meshes in one with Z up (or reversed)",
        "In glTF Y is up, and Blender writes OBJ files so by default; a camera that "
        "other code writes is not turned with the meshes.",
        "convert both, or none",
        *ways(*_turned(Y_UP_FROM_Z_UP), *_turned(Y_UP_FROM_Z_UP.T)),
        witness="KhronosGroup/glTF-Blender-IO#2048",
    ),
    Fault(
        "quarter_turn",
        "the camera's world is turned by {words}",
        "Programs differ in which axis of the world is forward: +X in ROS and Unreal, +Y or -Y in "
        "Blender.",
        "turn the camera back with its world, or the meshes with it",
        *ways(*_quarters()),
        words="a quarter, half a turn or three quarters about an axis",
        witness="o3de/o3de-extras#742",
    ),
    Fault(
        "handedness",
        "the camera's world has another handedness: its {words} axis is mirrored",
        "Unity, Unreal and DirectX have left-handed worlds: on the way there and back an"
        " axis is mirrored once too often, or never.",
        "mirror the world's axis for the camera and the meshes, or for neither",
        *ways(*_left_handed()),
        words="X, Y or Z",
        witness="ingowald/pbrt-parser#33",
    ),
)

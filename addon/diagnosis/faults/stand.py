"""Families of cameras elsewhere: moved along their own axes, or turned about them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...arrays import Floats
from ...camera_files.frame import of_quaternion
from ...projections import ORTHOGRAPHIC
from ...scene import Camera
from ...tracer.camera import pixel_size
from ..evidence import Evidence
from .fault import Values
from .film import STEP, radius
from .fitting import Family

NEGLIGIBLE = 1e-4  # of the largest number: smaller ones are reported as 0
# Of the unexplained pixels: three numbers settle a part of them by chance, and the right ones most.
WORTH = 0.4
_SIDES = ("to the right", "to the left"), ("upwards", "downwards"), ("anticlockwise", "clockwise")


def moved(camera: Camera, right: float, up: float, forward: float = 0.0) -> Camera:
    """Return the camera moved along its own axes, in metres."""
    matrix = camera.world_from_camera.copy()
    matrix[:3, 3] += right * camera.right + up * camera.up + forward * camera.forward
    return replace(camera, world_from_camera=matrix)


def rotation(about: Floats) -> Floats:
    """Return the rotation by a vector, (3,) radians about the axis along it, (3, 3)."""
    half = np.linalg.norm(about) / 2
    x, y, z = np.sinc(half / np.pi) / 2 * about
    return of_quaternion(float(np.cos(half)), x, y, z)


def turned(camera: Camera, right: float, up: float, roll: float) -> Camera:
    """Return the camera turned by degrees to the right, upwards, and anticlockwise.

    Together they are one rotation: it does not matter which comes first.
    """
    about = np.radians((up, -right, roll))  # of right, up and backward
    matrix = camera.world_from_camera.copy()
    matrix[:3, :3] = matrix[:3, :3] @ rotation(about)
    return replace(camera, world_from_camera=matrix)


def _depth(evidence: Evidence) -> float:
    """Return the median depth of the visible surfaces, in metres."""
    t = evidence.frame.t
    return float(np.median(t[np.isfinite(t)])) if np.isfinite(t).any() else 1.0


def _metres(evidence: Evidence) -> Floats:
    """Return the moves right, up, forward that shift the picture by a pixel, (3, 3) metres."""
    camera, depth = evidence.case.scene.camera, _depth(evidence)
    width, height = (v * camera.projection.scale(depth) for v in pixel_size(camera))
    return np.diag((width, height, depth / radius(evidence)))


def _seen(evidence: Evidence) -> Floats:
    """Return the moves that change the picture; forward changes no orthographic one."""
    parallel = evidence.case.scene.camera.projection is ORTHOGRAPHIC
    return _metres(evidence)[:, : 2 if parallel else 3]


def _unseen(evidence: Evidence) -> Floats:
    """Return the moves that do not."""
    return _metres(evidence)[:, _seen(evidence).shape[1] :]


def _degrees(evidence: Evidence) -> Floats:
    """Return the turns right, up, roll that shift the picture by a pixel, (3, 3) degrees."""
    return np.degrees(_metres(evidence) / _depth(evidence))


def _in_the_world(camera: Camera, *metres: float) -> str:
    by = moved(camera, *metres).origin - camera.origin
    x, y, z = (0.0 if abs(v) < NEGLIGIBLE * np.abs(by).max() else v for v in by)
    return f"({x:+.4g}, {y:+.4g}, {z:+.4g}) m"


def _in_degrees(camera: Camera, *degrees: float) -> str:
    """Say by how much the camera is turned, and to which side; angles of 0 are left out."""
    least = NEGLIGIBLE * max(map(abs, degrees))
    return ", ".join(
        f"{abs(v):.4g} degrees {ahead if v > 0 else back}"
        for v, (ahead, back) in zip(degrees, _SIDES, strict=True)
        if abs(v) > least
    )


def placed(camera: Camera, *numbers: float) -> Camera:
    """Return the camera moved along its own axes, in metres, and then turned by degrees."""
    return turned(moved(camera, *numbers[:3]), *numbers[3:])


def _six(evidence: Evidence) -> Floats:
    """Return the changes of six numbers that shift the picture by a pixel, as columns."""
    seen = _seen(evidence)
    out = np.zeros((6, seen.shape[1] + 3))
    out[:3, : seen.shape[1]] = seen
    out[3:, seen.shape[1] :] = _degrees(evidence)
    return out


def _placed_words(camera: Camera, *numbers: float) -> str:
    """Say by how much the camera is moved in the world, and turned."""
    metres, degrees = numbers[:3], numbers[3:]
    return (
        f"moved by {_in_the_world(camera, *metres)}, and turned by {_in_degrees(camera, *degrees)}"
    )


def _rolled(camera: Camera, degrees: float) -> Camera:
    """Return the camera rolled about its axis; the picture's content turns the other way."""
    return turned(camera, 0, 0, degrees)


def _rolls(evidence: Evidence) -> Iterator[Values]:
    for degrees in np.arange(-180, 180, np.degrees(STEP / radius(evidence))):
        yield (float(degrees),)


MOVED = Family(moved, _seen, _in_the_world, worth=WORTH, unseen=_unseen)
TURNED = Family(turned, _degrees, _in_degrees, worth=WORTH)
PLACED = Family(placed, _six, _placed_words, worth=WORTH)
ROLL = Family(_rolled, lambda evidence: np.degrees(np.eye(1) / radius(evidence)), starts=_rolls)

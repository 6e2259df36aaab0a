"""The faults with which one camera is another: those without numbers, and those that are read off.

The faults, and their sentences, are those of the diagnosis of pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from reference_tracer.camera_files.frame import rotation_vector
from reference_tracer.diagnosis.faults.camera import CAMERA_FAULTS
from reference_tracer.diagnosis.faults.fault import AnyFault, Numbers, Values, Ways
from reference_tracer.diagnosis.faults.film import FOCAL, FOCALS, OFFSET
from reference_tracer.diagnosis.faults.fitting import Family
from reference_tracer.diagnosis.faults.lens import LENS_FAULTS
from reference_tracer.diagnosis.faults.matrices import MATRIX_FAULTS
from reference_tracer.diagnosis.faults.stand import MOVED, ROLL, TURNED
from reference_tracer.scene import Camera, alike
from reference_tracer.tracer.camera import pixel_size, project

_DIGITS = 6  # of an offset in pixels, so that half a pixel is one
_PLACES = 12  # of a percentage, so that a rounding is none
_NEGLIGIBLE = 1e-9  # of a number of the last resort: metres, degrees, percent, pixels
_SAME_AXES = 1e-2  # of unit axes: more than what is within any `allowed` differs by
_MISTAKES: tuple[AnyFault, ...] = (*MATRIX_FAULTS, *LENS_FAULTS)


class Step(NamedTuple):
    """A fault, the camera that has it, and how another one gets it."""

    fault: AnyFault
    guess: Any
    camera: Camera
    change: Callable[[Camera], Camera | None]

    def lines(self) -> list[str]:
        """Return what is wrong, and what to do."""
        out = [self.fault.sentence_of(self.guess), f"  {self.fault.advice_of(self.guess)}"]
        if self.fault.name == "pixel_offset":
            dx, dy = self.guess.values
            out.append(f"  its principal point is off by ({-dx:+.3f}, {dy:+.3f}) px, rows down")
        return out


Steps = tuple[Step, ...]  # the second is of the camera with the first


def looks_as(camera: Camera, other: Camera) -> bool:
    """Return whether two cameras may look in the same direction, mirrored or not."""
    axes = np.abs(camera.world_from_camera[:3, :3]) - np.abs(other.world_from_camera[:3, :3])
    return bool(np.abs(axes).max() < _SAME_AXES)


def last_resort(own: Camera, other: Camera) -> Iterator[Steps]:
    """Yield the turn, the move, the focal lengths and the offset between two cameras, together."""
    out: list[Step] = []
    camera = own
    for name in _LAST_RESORT:
        step = _read_off(camera, other, name)
        if step is None:  # of a panorama, or of mirrored axes
            return
        if _is_some(step):
            out.append(step)
            camera = step.camera
    if out:
        yield tuple(out)


def focal_step(camera: Camera, other: Camera) -> Step | None:
    """Return the camera with the other one's focal lengths; None if it has them, or cannot."""
    step = _read_off(camera, other, "focal_lengths")
    return step if step and _is_some(step) else None


def _read_off(camera: Camera, other: Camera, name: str) -> Step | None:
    """Return the fault of a name; of two focal lengths that are equal, one says as much."""
    read = {step.fault.name: step for step in fitted(camera, other)}
    step = read.get(name)
    is_one = step and name == "focal_lengths" and np.ptp(step.guess.values) <= _NEGLIGIBLE
    return read["focal_length"] if is_one else step


def _is_some(step: Step) -> bool:
    return any(abs(v) > _NEGLIGIBLE for v in step.guess.values)


def mistakes(camera: Camera, faults: Sequence[AnyFault] = _MISTAKES) -> Iterator[Step]:
    """Yield the camera with each mistake that has no numbers, in the order of the faults."""
    for fault in faults:
        assert isinstance(fault.assume, Ways)
        for option, change in fault.assume.options():
            changed = change(camera)
            if changed and not alike(changed, camera):
                yield Step(fault, option, changed, change)


def second(first: Step, other: Camera) -> Iterator[Step]:
    """Yield the camera of a mistake with another one, as far as that can make the other camera.

    A lens has nothing to do with a matrix: so after one of a lens there are those of lenses alone,
    and after one of a matrix these only if the camera then stands and looks as the other does.
    """
    if first.fault in MATRIX_FAULTS:
        yield from mistakes(first.camera, MATRIX_FAULTS)
        if not looks_as(first.camera, other):
            return
    yield from mistakes(first.camera, LENS_FAULTS)


def half_pixels(camera: Camera) -> Iterator[Step]:
    """Yield the camera with its rays through the pixels' corners."""
    for dx, dy in product((0.5, -0.5), repeat=2):
        if step := _with(camera, "pixel_offset", OFFSET, (dx, dy)):
            yield step


def _with(camera: Camera, name: str, family: Family, values: Values) -> Step | None:
    """Return the camera with a fault that has numbers; None if it cannot have them.

    No turn makes mirrored axes of others, and what is read off for one need not be finite.
    """
    if not np.isfinite(values).all():
        return None

    def change(of: Camera) -> Camera | None:
        return family.camera(of, *values)

    changed = change(camera)
    if changed is None:
        return None
    words = family.words(camera, *values)
    return Step(_BY_NAME[name], Numbers(values=values, words=words), changed, change)


def fitted(camera: Camera, other: Camera) -> list[Step]:
    """Return the camera with each fault that has numbers, which are read off both cameras."""
    read = (_with(camera, name, own, read_off(camera, other)) for name, own, read_off in _FITTED)
    return [step for step in read if step]


def _focal_lengths(camera: Camera, other: Camera) -> Values:
    pairs = zip(camera.window.size, other.window.size, strict=True)
    return tuple(round(100 * float(own / its - 1), _PLACES) for own, its in pairs)


def _offset(camera: Camera, other: Camera) -> Values:
    moved = np.subtract(other.window.centre, camera.window.centre) / pixel_size(camera)
    return tuple(round(float(v), _DIGITS) for v in moved)


def _move(camera: Camera, other: Camera) -> Values:
    xyz, _ = project(camera, other.origin[:, None])
    return tuple(map(float, xyz[:, 0]))


def _turn(camera: Camera, other: Camera) -> Values:
    """Return the rotation from one camera's axes to the other's in the angles of `TURNED`."""
    own, its = (c.world_from_camera[:3, :3] for c in (camera, other))
    up, left, roll = np.degrees(rotation_vector(np.linalg.solve(own, its)))
    return float(-left), float(up), float(roll)


# Those with numbers: how the camera with them is made, and how they are read off two cameras.
_FITTED: tuple[tuple[str, Family, Callable[[Camera, Camera], Values]], ...] = (
    ("pixel_offset", OFFSET, _offset),
    ("focal_length", FOCAL, lambda camera, other: _focal_lengths(camera, other)[:1]),
    ("focal_lengths", FOCALS, _focal_lengths),
    ("camera_moved", MOVED, _move),
    ("roll", ROLL, lambda camera, other: _turn(camera, other)[2:]),
    ("camera_turned", TURNED, _turn),
)
# All that two cameras can differ in: each step leaves right what those before it have made so.
_LAST_RESORT = "camera_turned", "camera_moved", "focal_lengths", "pixel_offset"
_BY_NAME = {fault.name: fault for fault in CAMERA_FAULTS}

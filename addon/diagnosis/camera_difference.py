"""Says how far apart two cameras see the same points, and which faults make one of the other.

There is no picture to be searched: a fault of the camera is named if the scene's camera with it
sees every point where the other camera does, to within `CLOSE`. The faults, and their sentences,
are those of the diagnosis of pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Floats
from ..causes.case import Case
from ..manifest import Manifest
from ..pictures.certificate import certify, known_points
from ..pictures.picture import Picture
from ..scene import Camera, Scene
from ..tracer.camera import film_of, pixel_size, project
from ..tracer.progress import result_of
from ..tracer.settings import Settings
from .faults.camera import CAMERA_FAULTS
from .faults.fault import AnyFault, Numbers, Values
from .faults.film import FOCAL, FOCALS, OFFSET, ROLL
from .faults.fitting import Family
from .faults.lens import LENS_FAULTS
from .faults.stand import MOVED, TURNED

# Pixels: what float32 moves in a large picture, and a file's digits may; less is no difference.
CLOSE = 1e-3
_FEW = 40  # points: the view volume's corners, and some between, tell two cameras apart
_IN_LINE = 1e-6  # of the distance from the origin
_DIGITS = 6  # of an offset in pixels, so that half a pixel is one
_PLACES = 12  # of a percentage, so that a rounding is none
_NEGLIGIBLE = 1e-9  # of a number of the last resort: metres, degrees, percent, pixels
_NO_MANIFEST = Manifest("", "", "", 0, "FILE", "")
_NO_PICTURE: Any = None  # what has no numbers is guessed without one


Film = tuple[Floats, Floats, Floats]  # as `film_of` gives it


class Step(NamedTuple):
    """A fault, and the camera that has it."""

    fault: AnyFault
    guess: Any
    camera: Camera


@dataclass(frozen=True)
class CameraDifference:
    """Where two cameras differ most, and what makes one of the other."""

    largest: float  # pixels; infinite if a point is not before the other camera at all
    median: float
    at: tuple[float, float]  # the scene's film position of the point with the largest, pixels
    depth: float  # of that point, metres
    allowed: float  # pixels
    steps: tuple[Step, ...] = ()  # the faults, the second of the camera with the first
    unit: float | None = None  # the factor between both places, if they are in one line with 0

    @property
    def agrees(self) -> bool:
        """Whether rounding accounts for the distance."""
        return self.largest <= self.allowed

    def lines(self) -> list[str]:
        """Return it as sentences."""
        x, y = (max(int(np.floor(v)), 0) for v in self.at)  # the edge may be rounded to outside
        where = f"at pixel ({x}, {y}), {self.depth:.4g} m deep"
        if self.agrees:
            return [f"agree: points lie at most {self.largest:.2g} px apart"]
        far = f"up to {self.largest:.4g} px" if np.isfinite(self.largest) else "behind the camera"
        half = f"{self.median:.4g} px or more" if np.isfinite(self.median) else "there"
        out = [f"differ: points lie {far} ({where}), half of them {half}"]
        for fault, guess, _ in self.steps:
            out += [fault.sentence_of(guess), f"  {fault.advice_of(guess)}"]
            if fault.name == "pixel_offset":
                dx, dy = guess.values
                out.append(f"  its principal point is off by ({-dx:+.3f}, {dy:+.3f}) px, rows down")
        if self.unit is not None:
            out.append(f"  its place is the scene's times {self.unit:.6g}: another unit of length?")
        if not self.steps:
            out.append("no known fault, and no two of them, make the file's camera of the scene's")
        return out


@np.errstate(invalid="ignore", divide="ignore", over="ignore")  # of points behind a camera
def difference(own: Camera, other: Camera) -> CameraDifference:
    """Compare another camera with the scene's own; both pictures have one size.

    Parameters
    ----------
    own, other : Camera
        The scene's, whose view volume has the points; the other of any clip range.
    """
    points = known_points(own)
    x, y, depth = film_of(own, points)
    apart = _apart((x, y, depth), film_of(other, points))
    worst = int(np.argmax(apart))
    allowed = max(CLOSE, certify(own, points, np.stack((x, y))).allowed)
    found = CameraDifference(
        float(apart[worst]),
        float(np.median(apart)),
        (float(x[worst]), float(y[worst])),
        float(depth[worst]),
        allowed,
    )
    if found.agrees:
        return found
    steps = tuple(_explained(own, other, allowed))
    is_moved = any(step.fault.name == "camera_moved" for step in steps)
    return replace(found, steps=steps, unit=_unit(own, other) if is_moved else None)


def _unit(own: Camera, other: Camera) -> float | None:
    """Return the factor between the places of two cameras, if it is one, and not 1."""
    square = float(own.origin @ own.origin)
    factor = float(own.origin @ other.origin) / square if square else 1.0
    off = np.abs(other.origin - factor * own.origin).max()
    is_one = off <= _IN_LINE * np.abs(other.origin).max() and abs(factor - 1) > _IN_LINE
    return factor if is_one and factor > 0 else None


def _apart(first: Film, second: Film) -> Floats:
    """Return how far apart points are on two films, (n,) pixels."""
    with np.errstate(invalid="ignore", over="ignore"):
        apart = np.hypot(first[0] - second[0], first[1] - second[1])
    return np.where(np.isnan(apart), np.inf, apart)


def _explained(own: Camera, other: Camera, allowed: float) -> list[Step]:
    """Return the faults with which the scene's camera is the other one; one or two if these do.

    Every camera that is not mirrored is the scene's with other focal lengths, an offset, moved and
    turned: so these are told only where no known mistake, alone or with another, does as well.
    Cameras are the same if they see what is before the other one in the same places.
    """
    before = known_points(other)
    if own.clip_start > 0 or other.projection.sees_behind:
        before = known_points(replace(other, clip_start=own.clip_start, clip_end=own.clip_end))
    points = before[:, :_FEW]
    film = film_of(other, points)

    def is_other(camera: Camera) -> bool:
        return bool(np.all(_apart(film_of(camera, points), film) <= allowed))

    options = list(_options(own))
    for first in options:
        if is_other(first.camera):
            return [first]
        for step in _half_pixels(first.camera):
            if is_other(step.camera):
                return [first, step]
    for step in _fitted(own, other):
        if is_other(step.camera):
            return [step]
    for first in options:
        for step in (*_options(first.camera), *_fitted(first.camera, other)):
            if is_other(step.camera):
                return [first, step]
    chain: list[Step] = []
    camera = own
    for name in _LAST_RESORT:
        fitted = {step.fault.name: step for step in _fitted(camera, other)}
        if name not in fitted:  # of a panorama, or of mirrored axes
            return []
        step = fitted[name]
        if name == "focal_lengths" and np.ptp([*step.guess.values]) <= _NEGLIGIBLE:
            step = fitted["focal_length"]  # one says as much
        if any(abs(v) > _NEGLIGIBLE for v in step.guess.values):
            chain.append(step)
            camera = step.camera
    return chain if is_other(camera) else []


def _options(camera: Camera) -> Iterator[Step]:
    """Yield the camera with each mistake that has no numbers, in the order of the faults."""
    for fault in (*CAMERA_FAULTS, *LENS_FAULTS):
        if not fault.numbers:
            case = Case(
                Scene(camera), _NO_MANIFEST, Settings(), Picture(np.zeros((0, 4), np.float32))
            )
            for guess in result_of(fault.find(_NO_PICTURE)):
                if changed := fault.assume(case, guess):
                    yield Step(fault, guess, changed.scene.camera)


def _half_pixels(camera: Camera) -> Iterator[Step]:
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
    changed = family.camera(camera, *values)
    if changed is None:
        return None
    words = family.words(camera, *values)
    return Step(_BY_NAME[name], Numbers(values=values, words=words), changed)


def _fitted(camera: Camera, other: Camera) -> Iterator[Step]:
    """Yield the camera with each fault that has numbers, which are read off both cameras."""
    for name, family, read_off in _FITTED:
        if step := _with(camera, name, family, read_off(camera, other)):
            yield step


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
    """Return the rotation from one camera's axes to the other's in the angles of `TURNED`.

    Its axis is that of the skew part of the rotation's matrix; near half a turn, where that
    vanishes, it is the largest column of the symmetric part.
    """
    own, its = (c.world_from_camera[:3, :3] for c in (camera, other))
    r = np.linalg.solve(own, its)
    skew = np.array((r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1])) / 2
    sine, cosine = float(np.linalg.norm(skew)), float(np.trace(r) - 1) / 2
    if sine > 1e-4 or cosine > 0:
        about = skew / sine if sine else skew
    else:
        outer = (r + r.T) / 2 + np.eye(3)
        about = outer[:, int(np.argmax(np.diag(outer)))]
        about = about / np.linalg.norm(about)
    up, left, roll = np.degrees(np.arctan2(sine, cosine)) * about
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

"""Says how far apart two cameras see the same points, and which faults make one of the other.

There is no picture to be searched: a fault of the camera is named if the scene's camera with it
sees every point where the other camera does, to within `CLOSE`. The faults, and their sentences,
are those of the diagnosis of pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice, product
from typing import Any, NamedTuple

import numpy as np

from ..arrays import Floats
from ..pictures.certificate import certify, known_points
from ..scene import Camera
from ..tracer.camera import film_of, pixel_size, project
from .faults.camera import CAMERA_FAULTS
from .faults.fault import AnyFault, Numbers, Values, Ways
from .faults.film import FOCAL, FOCALS, OFFSET, ROLL
from .faults.fitting import Family
from .faults.lens import LENS_FAULTS
from .faults.matrices import MATRIX_FAULTS
from .faults.stand import MOVED, TURNED

# Pixels: what float32 moves in a large picture, and a file's digits may; less is no difference.
CLOSE = 1e-3
_FEW = 40  # points: the view volume's corners, and some between, tell two cameras apart
_IN_LINE = 1e-6  # of the distance from the origin
_DIGITS = 6  # of an offset in pixels, so that half a pixel is one
_PLACES = 12  # of a percentage, so that a rounding is none
_NEGLIGIBLE = 1e-9  # of a number of the last resort: metres, degrees, percent, pixels


_SAME_AXES = 1e-2  # of unit axes: more than what is within any `allowed` differs by
_MISTAKES: tuple[AnyFault, ...] = (*MATRIX_FAULTS, *LENS_FAULTS)

Film = tuple[Floats, Floats, Floats]  # as `film_of` gives it


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
SeesAs = Callable[[Camera], bool]


@dataclass(frozen=True)
class CameraDifference:
    """Where two cameras differ most, and what makes one of the other."""

    largest: float  # pixels; infinite if a point is not before the other camera at all
    median: float
    at: tuple[float, float]  # the scene's film position of the point with the largest, pixels
    depth: float  # of that point, metres
    allowed: float  # pixels
    # What makes the other camera, each by itself: faults, the second of the camera with the first.
    explanations: tuple[Steps, ...] = ()
    unit: float | None = None  # the factor between both places, if they are in one line with 0

    @property
    def steps(self) -> Steps:
        """The faults of the first explanation; none if nothing known explains the difference."""
        return self.explanations[0] if self.explanations else ()

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
        for number, steps in enumerate(self.explanations):
            out += ["or:"] if number else []
            out += (line for step in steps for line in step.lines())
        if self.unit is not None:
            out.append(f"  its place is the scene's times {self.unit:.6g}: another unit of length?")
        if not self.explanations:
            out.append("no known fault, and no two of them, make the file's camera of the scene's")
        return out


def difference(own: Camera, other: Camera) -> CameraDifference:
    """Compare another camera with the scene's own, and find out what makes one of the other."""
    return explained(measured(own, other), own, other)


@np.errstate(invalid="ignore", divide="ignore", over="ignore")  # of points behind a camera
def measured(own: Camera, other: Camera) -> CameraDifference:
    """Measure how far another camera is from the scene's own; both pictures have one size.

    Parameters
    ----------
    own, other : Camera
        The scene's, whose view volume has the points; the other of any clip range.
    """
    points = known_points(own)
    x, y, depth = film_of(own, points)
    far = apart((x, y, depth), film_of(other, points))
    worst = int(np.argmax(far))
    return CameraDifference(
        float(far[worst]),
        float(np.median(far)),
        (float(x[worst]), float(y[worst])),
        float(depth[worst]),
        max(CLOSE, certify(own, points, np.stack((x, y))).allowed),
    )


@np.errstate(invalid="ignore", divide="ignore", over="ignore")
def explained(found: CameraDifference, own: Camera, other: Camera) -> CameraDifference:
    """Return what was measured of two cameras with what explains it, if they differ."""
    if found.agrees:
        return found
    explanations = tuple(_explanations(own, other, found.allowed))
    steps = explanations[0] if explanations else ()
    is_moved = any(step.fault.name == "camera_moved" for step in steps)
    unit = _unit(own, other) if is_moved else None
    return replace(found, explanations=explanations, unit=unit)


def _unit(own: Camera, other: Camera) -> float | None:
    """Return the factor between the places of two cameras, if it is one, and not 1."""
    square = float(own.origin @ own.origin)
    factor = float(own.origin @ other.origin) / square if square else 1.0
    off = np.abs(other.origin - factor * own.origin).max()
    is_one = off <= _IN_LINE * np.abs(other.origin).max() and abs(factor - 1) > _IN_LINE
    return factor if is_one and factor > 0 else None


def apart(first: Film, second: Film) -> Floats:
    """Return how far apart points are on two films, (n,) pixels."""
    with np.errstate(invalid="ignore", over="ignore"):
        far = np.hypot(first[0] - second[0], first[1] - second[1])
    return np.where(np.isnan(far), np.inf, far)


def _explanations(own: Camera, other: Camera, allowed: float) -> list[Steps]:
    """Return what makes the scene's camera the other one, as simply as possible.

    Every camera that is not mirrored is the scene's with other focal lengths, an offset, moved and
    turned: so these are told only where no known mistake, alone or with another, does as well.
    """
    sees_as = _same_view(own, other, allowed)
    options = list(mistakes(own))
    if alone := _all(((step,) for step in options), sees_as):
        return alone
    beside = ((first, step) for first in options for step in _half_pixels(first.camera))
    fitted = ((step,) for step in _fitted(own, other))
    further = [(first, step) for first in options for step in _fitted(first.camera, other)]
    # A turn, a move or an offset can look like two mistakes: these come before.
    focal = (steps for steps in further if steps[1].fault.name.startswith("focal"))
    if found := _first(chain(beside, fitted, focal), sees_as):
        return found
    if pairs := _all(((a, b) for a in options for b in _second(a, other)), sees_as):
        return pairs
    if found := _first(further, sees_as):
        return found
    steps = _last_resort(own, other)
    return [steps] if steps and sees_as(steps[-1].camera) else []


def _all(every: Iterable[Steps], sees_as: SeesAs) -> list[Steps]:
    """Return the explanations that make the other camera; of those with the same names one."""
    found: dict[frozenset[str], Steps] = {}
    for steps in every:
        names = frozenset(step.fault.name for step in steps)
        if names not in found and sees_as(steps[-1].camera):
            found[names] = steps
    return [*found.values()]


def _first(every: Iterable[Steps], sees_as: SeesAs) -> list[Steps]:
    """Return the first of some explanations that makes the other camera; none if none does."""
    return [*islice((steps for steps in every if sees_as(steps[-1].camera)), 1)]


def points_before(camera: Camera, own: Camera) -> Floats:
    """Return some points that a camera sees, (3, n), between the scene's clip distances."""
    if own.clip_start > 0 or camera.projection.sees_behind:
        camera = replace(camera, clip_start=own.clip_start, clip_end=own.clip_end)
    return known_points(camera)[:, :_FEW]


def _same_view(own: Camera, other: Camera, allowed: float) -> Callable[[Camera], bool]:
    """Return a function that says whether a camera sees what is before `other` as that does."""
    points = points_before(other, own)
    film = film_of(other, points)

    def sees_as(camera: Camera) -> bool:
        if not _looks_as(camera, other):  # most do not, and this takes a tenth of the time
            return False
        return bool(np.all(apart(film_of(camera, points), film) <= allowed))

    return sees_as


def _looks_as(camera: Camera, other: Camera) -> bool:
    """Return whether two cameras may look in the same direction, mirrored or not."""
    axes = np.abs(camera.world_from_camera[:3, :3]) - np.abs(other.world_from_camera[:3, :3])
    return bool(np.abs(axes).max() < _SAME_AXES)


def _last_resort(own: Camera, other: Camera) -> Steps:
    """Return the turn, the move, the focal lengths and the offset between two cameras."""
    out: list[Step] = []
    camera = own
    for name in _LAST_RESORT:
        fitted = {step.fault.name: step for step in _fitted(camera, other)}
        if name not in fitted:  # of a panorama, or of mirrored axes
            return ()
        step = _simplest(fitted, name)
        if any(abs(v) > _NEGLIGIBLE for v in step.guess.values):
            out.append(step)
            camera = step.camera
    return tuple(out)


def _simplest(fitted: Mapping[str, Step], name: str) -> Step:
    """Return the fault of a name; of two focal lengths that are equal, one says as much."""
    is_one = name == "focal_lengths" and np.ptp([*fitted[name].guess.values]) <= _NEGLIGIBLE
    return fitted["focal_length" if is_one else name]


def focal_step(camera: Camera, other: Camera) -> Step | None:
    """Return the camera with the other one's focal lengths; None if it has them, or cannot."""
    fitted = {step.fault.name: step for step in _fitted(camera, other)}
    if "focal_lengths" not in fitted:
        return None
    step = _simplest(fitted, "focal_lengths")
    return step if any(abs(v) > _NEGLIGIBLE for v in step.guess.values) else None


def mistakes(camera: Camera, faults: Sequence[AnyFault] = _MISTAKES) -> Iterator[Step]:
    """Yield the camera with each mistake that has no numbers, in the order of the faults."""
    for fault in faults:
        assert isinstance(fault.assume, Ways)
        for option, change in fault.assume.options():
            if changed := change(camera):
                yield Step(fault, option, changed, change)


def _second(first: Step, other: Camera) -> Iterator[Step]:
    """Yield the camera of a mistake with another one, as far as that can make the other camera.

    A lens has nothing to do with a matrix: so after one of a lens there are those of lenses alone,
    and after one of a matrix these only if the camera then stands and looks as the other does.
    """
    if first.fault in MATRIX_FAULTS:
        yield from mistakes(first.camera, MATRIX_FAULTS)
        if not _looks_as(first.camera, other):
            return
    yield from mistakes(first.camera, LENS_FAULTS)


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

    def change(of: Camera) -> Camera | None:
        return family.camera(of, *values)

    changed = change(camera)
    if changed is None:
        return None
    words = family.words(camera, *values)
    return Step(_BY_NAME[name], Numbers(values=values, words=words), changed, change)


def _fitted(camera: Camera, other: Camera) -> list[Step]:
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

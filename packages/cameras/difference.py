"""Says how far apart two cameras see the same points, and which faults make one of the other.

There is no picture to be searched: a fault of the camera is named if the scene's camera with it
sees every point where the other camera does, to within `CLOSE`. The faults, and their sentences,
are those of the diagnosis of pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from itertools import chain, islice

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.pictures.certificate import certify, known_points
from reference_tracer.scene import Camera
from reference_tracer.tracer.camera import film_of

from .steps import Steps, fitted, half_pixels, last_resort, looks_as, mistakes, second

# Pixels: what float32 moves in a large picture, and a file's digits may; less is no difference.
CLOSE = 1e-3
_FEW = 40  # points: the view volume's corners, and some between, tell two cameras apart
_IN_LINE = 1e-6  # of the distance from the origin


Film = tuple[Floats, Floats, Floats]  # as `film_of` gives it
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


@np.errstate(invalid="ignore", divide="ignore", over="ignore")  # of points behind a camera
def difference(own: Camera, other: Camera) -> CameraDifference:
    """Compare another camera with the scene's own, and find out what makes one of the other."""
    return explained(measured(own, other), own, other)


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
    worst = np.argmax(far)
    return CameraDifference(
        far[worst],
        float(np.median(far)),
        (x[worst], y[worst]),
        depth[worst],
        max(CLOSE, certify(own, points, np.stack((x, y))).allowed),
    )


def explained(found: CameraDifference, own: Camera, other: Camera) -> CameraDifference:
    """Return what was measured of two cameras with what explains it, if they differ."""
    if found.agrees:
        return found
    found = replace(found, explanations=tuple(_explanations(own, other, found.allowed)))
    is_moved = any(step.fault.name == "camera_moved" for step in found.steps)
    return replace(found, unit=_unit(own, other) if is_moved else None)


def _unit(own: Camera, other: Camera) -> float | None:
    """Return the factor between the places of two cameras, if it is one, and not 1."""
    square = float(own.origin @ own.origin)
    factor = float(own.origin @ other.origin) / square if square else 1.0
    off = np.abs(other.origin - factor * own.origin).max()
    is_one = off <= _IN_LINE * np.abs(other.origin).max() and abs(factor - 1) > _IN_LINE
    return factor if is_one and factor > 0 else None


def apart(first: Film, second: Film) -> Floats:
    """Return how far apart points are on two films, (n,) pixels."""
    far = np.hypot(first[0] - second[0], first[1] - second[1])
    return np.where(np.isnan(far), np.inf, far)


def _explanations(own: Camera, other: Camera, allowed: float) -> list[Steps]:
    """Return what makes the scene's camera the other one, as simply as possible.

    Every camera that is not mirrored is the scene's with other focal lengths, an offset, moved and
    turned: so these are told only where no known mistake, alone or with another, does as well.
    """
    sees_as = _same_view(own, other, allowed)
    options = list(mistakes(own))
    halves = ((step,) for step in half_pixels(own))
    beside = ((first, step) for first in options for step in half_pixels(first.camera))
    alone = ((step,) for step in fitted(own, other))
    further = [(first, step) for first in options for step in fitted(first.camera, other)]
    # A turn, a move or an offset can look like two mistakes: these come before.
    focal = (steps for steps in further if steps[1].fault.name.startswith("focal"))
    return (
        _all(((step,) for step in options), sees_as)
        or _first(chain(halves, beside, alone, focal), sees_as)
        or _all(((a, b) for a in options for b in second(a, other)), sees_as)
        or _first(further, sees_as)
        or _first(last_resort(own, other), sees_as)
    )


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
        if not looks_as(camera, other):  # most do not, and this takes a tenth of the time
            return False
        return bool(np.all(apart(film_of(camera, points), film) <= allowed))

    return sees_as

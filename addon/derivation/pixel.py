"""Holds what one pixel's ray may meet, and asks the tracer what it sees of that.

A `Pixel` has all that its derivation needs of a scene, and stands alone: `reproducer.py` writes it
to a file, and what is derived from that is the same. An `Answer` is found by the tracer's own
functions, not by the steps that the derivation shows.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..arrays import Colors, Floats
from ..certainty import Certainty
from ..methods import Method
from ..rendering import trace
from ..scene import Camera, Instance, Mesh, Plane, Scene, SceneError
from ..tracer.camera import Rays, camera_rays
from ..tracer.hits import NOTHING, NOWHERE
from ..tracer.settings import UNPROVEN_SETTINGS, Precision, Settings
from ..tracer.ties import Name
from ..tracer.world import WorldTriangles


@dataclass(frozen=True, eq=False)
class Candidate:
    """A triangle or an infinite plane that the ray may meet."""

    object: str  # its name
    instance: int  # as in a `Frame`: a plane has a number after all instances,
    triangle: int  # and no triangle (NOTHING)
    # World space, metres: (3, 3) the corners, a row each; of a plane (2, 3), its point and normal.
    points: Floats
    colors: Colors  # linear RGBA: (1, 4), or (3, 4) with one at each corner
    mesh: str = ""
    slot: int = 0  # of the material that gives the colour

    @property
    def is_plane(self) -> bool:
        """Whether it is an infinite plane."""
        return self.triangle == NOTHING

    @property
    def name(self) -> Name:
        """Instance and triangle: of two at the same t, the lower is seen."""
        return self.instance, self.triangle

    @property
    def title(self) -> str:
        """The surface's name for a reader."""
        if self.is_plane:
            return f"{self.object}, infinite plane"
        return f"{self.object}, triangle {self.triangle}"


@dataclass(frozen=True, eq=False)
class Pixel:
    """A camera, one of its pixels, and the candidates.

    Raises
    ------
    SceneError
        If there is no such pixel.
    """

    camera: Camera
    x: int  # of the traced picture, the camera's region: (0, 0) is its lower left pixel
    y: int
    candidates: tuple[Candidate, ...]  # what is nearest first
    background: Colors  # (4,) linear RGBA
    first_plane: int = 0  # the number of the scene's first infinite plane: that of its instances
    triangles: int = 0  # in the whole scene
    left_out: int = 0  # candidates beyond the limit: none of them is nearer than what is seen
    refused: int = 0  # the scene's triangles with a corner that is not finite in world space
    source: str = ""  # where it comes from, for a reader

    def __post_init__(self) -> None:
        check_pixel(self.camera, self.x, self.y)

    @property
    def column(self) -> int:
        """The pixel's column in the whole picture."""
        return self.camera.region.x0 + self.x

    @property
    def row(self) -> int:
        """The pixel's row in the whole picture, from the bottom."""
        return self.camera.region.y0 + self.y

    def rays(self, precision: Precision = Precision.FLOAT64) -> Rays:
        """Return the pixel's ray as a batch of one."""
        film = np.array([self.column + 0.5]), np.array([self.row + 0.5])
        return camera_rays(self.camera, *film, precision.dtype)

    def world_triangles(self) -> WorldTriangles:
        """Return the candidates that are triangles, as the tracer takes them."""
        found = [c for c in self.candidates if not c.is_plane]
        corners = np.array([c.points for c in found]).reshape(-1, 3, 3)
        names = np.array([c.name for c in found], np.int32).reshape(-1, 2)
        return WorldTriangles(corners.transpose(1, 2, 0), *names.T)

    @cached_property
    def origin(self) -> Floats:
        """The ray's origin, (3,) metres."""
        return self.rays().origins[:, 0]

    @cached_property
    def direction(self) -> Floats:
        """The ray's direction, (3,), as long as it takes to a depth of 1."""
        return self.rays().directions[:, 0]


def check_pixel(camera: Camera, x: int, y: int) -> None:
    """Raise a SceneError if the traced picture has no pixel (x, y)."""
    width, height = camera.region.width, camera.region.height
    for name, value, count in (("x", x, width), ("y", y, height)):
        if not isinstance(value, (int, np.integer)):
            raise SceneError(f"{name} of the pixel is {value!r}; it must be an integer.")
        if not 0 <= value < count:
            raise SceneError(
                f"There is no pixel ({x}, {y}) in a picture of {width} x {height}: {name} must "
                f"be between 0 and {count - 1}. (0, 0) is the lower left."
            )


@dataclass(frozen=True, eq=False)
class Answer:
    """The answer of one method in one precision; `seen` is NOWHERE, and `t` inf, for nothing."""

    method: Method
    precision: Precision
    seen: Name
    t: float
    s: Floats  # (3,) barycentrics of the corners; zeros of a plane and of nothing
    certainty: Certainty = Certainty.NOT_CERTIFIED
    ties: frozenset[Name] = frozenset()  # all that an ambiguous ray may be said to see


def plain_answers(pixel: Pixel) -> list[Answer]:
    """Return the answers of the unproven methods, in the tracer's order.

    They are the picture's own but for one case: float32 may round a triangle so far that its box on
    the film holds the pixel, while float64 keeps it away. That triangle is no candidate.
    """
    triangles = pixel.world_triangles()
    return [answer(pixel, triangles, settings) for settings in UNPROVEN_SETTINGS]


def answer(pixel: Pixel, triangles: WorldTriangles, settings: Settings | None = None) -> Answer:
    """Return the nearest hit of these triangles and the pixel's planes, each tested with the ray.

    By default what is proven; NOT_CERTIFIED where this process can prove nothing.
    """
    # Sorted, as of equals the tracer takes the first.
    order = np.lexsort((triangles.triangle, triangles.instance))
    corners = triangles.corners[..., order].transpose(2, 0, 1).reshape(-1, 3)
    numbers = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
    planes = [c for c in pixel.candidates if c.is_plane]
    scene = Scene(
        pixel.camera,
        (Mesh(corners, numbers),),
        (Instance(0, 0, np.eye(4)),),
        tuple(Plane(0, *c.points) for c in planes),
        objects=("",),
    )
    names = {NOWHERE: NOWHERE}
    for number, k in enumerate(order):
        names[0, number] = int(triangles.instance[k]), int(triangles.triangle[k])
    names |= {(k, NOTHING): c.name for k, c in enumerate(planes, 1)}
    precision = settings.precision if settings else Precision.FLOAT64
    hits = trace(scene, settings or Settings(), rays=pixel.rays(precision))
    return Answer(
        settings.method if settings else Method.CERTIFIED,
        precision,
        names[int(hits.instance[0]), int(hits.triangle[0])],
        float(hits.t[0]),
        hits.s[:, 0].astype(np.float64),
        Certainty(int(hits.certainty[0])),
        frozenset(names[name] for name in hits.ties.get(0, ())),
    )

"""What one pixel's ray may meet, and what the tracer says of it.

A `Pixel` has all that its derivation needs of a scene, and stands alone: `reproducer.py` writes it
to a file, and what is derived from that is the same. An `Answer` is that of a plain method in one
precision, or the proof, by the tracer's own functions, not by the steps that the derivation shows.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..certainty import Certainty
from ..certified.arithmetic import broken_assumptions
from ..certified.ladder import Ladder
from ..certified.surfaces import Surfaces
from ..methods import Method
from ..scene import Camera, SceneError
from ..tracer import plane
from ..tracer.camera import Rays, camera_rays, corner_rays
from ..tracer.candidates import Pairs
from ..tracer.hits import NOTHING, NOWHERE, Hits, Name, Statistics
from ..tracer.nearest import within_clip
from ..tracer.progress import result_of
from ..tracer.settings import PLAIN_SETTINGS, Precision, Settings
from ..tracer.triangle import TESTS
from ..tracer.world import WorldTriangles


@dataclass(frozen=True, eq=False)
class Candidate:
    """A triangle or an infinite plane that the ray may meet."""

    object: str  # its name
    instance: int  # as in a `Frame`: a plane has a number after all instances,
    triangle: int  # and no triangle (NOTHING)
    # World space, metres: (3, 3) the corners, a row each; of a plane (2, 3), its point and normal.
    points: NDArray[np.float64]
    colors: NDArray[np.float32]  # linear RGBA: (1, 4), or (3, 4) with one at each corner
    mesh: str = ""
    slot: int = 0  # of the material whose colour it is

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
        """What a reader calls it."""
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
    background: NDArray[np.float32]  # (4,) linear RGBA
    first_plane: int = 0  # the number of the scene's first infinite plane: that of its instances
    triangles: int = 0  # in the whole scene
    left_out: int = 0  # candidates beyond the limit: none of them is nearer than what is seen
    refused: int = 0  # the scene's triangles with a corner that is not finite in world space
    source: str = ""  # where it comes from, for a reader

    def __post_init__(self) -> None:
        check_pixel(self.camera, self.x, self.y)

    @property
    def column(self) -> int:
        """Of the whole picture, of which the region is a part."""
        return self.camera.region.x0 + self.x

    @property
    def row(self) -> int:
        """Of the whole picture, from the bottom."""
        return self.camera.region.y0 + self.y

    def rays(self, dtype: np.dtype | type = np.float64) -> Rays:
        """Return its ray as the tracer has it, one of one."""
        return camera_rays(
            self.camera, np.array([self.column + 0.5]), np.array([self.row + 0.5]), dtype
        )

    @property
    def planes(self) -> list[Candidate]:
        """Those of the candidates that are infinite planes."""
        return [c for c in self.candidates if c.is_plane]

    def world_triangles(self) -> WorldTriangles:
        """Return the candidates that are triangles, as the tracer takes them."""
        kept = [c for c in self.candidates if not c.is_plane]
        if not kept:
            return WorldTriangles.none()
        return WorldTriangles(
            np.stack([c.points for c in kept], axis=2),
            np.array([c.instance for c in kept], np.int32),
            np.array([c.triangle for c in kept], np.int32),
        )

    @cached_property
    def origin(self) -> NDArray[np.float64]:
        """Where the ray begins, (3,) metres."""
        return self.rays().origins[:, 0]

    @cached_property
    def direction(self) -> NDArray[np.float64]:
        """Where it goes, (3,); its length is that at which the depth is 1."""
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
    """What one method in one precision sees; `seen` is NOWHERE, and `t` inf, for nothing."""

    method: Method
    precision: Precision
    seen: Name
    t: float
    s: NDArray[np.float64]  # (3,) barycentrics of the corners; zeros of a plane and of nothing
    certainty: Certainty = Certainty.NOT_CERTIFIED
    ties: frozenset[Name] = frozenset()  # all that an ambiguous ray may be said to see


def plain_answers(pixel: Pixel) -> list[Answer]:
    """Return the answers of the plain methods, in the tracer's order.

    They are the pictures' own, except where float32 rounds a triangle so far that its box on the
    film, which float64 keeps away from the pixel, holds it: that triangle is no candidate.
    """
    triangles = pixel.world_triangles()
    return [plain_answer(pixel, triangles, settings) for settings in PLAIN_SETTINGS]


def plain_answer(pixel: Pixel, triangles: WorldTriangles, settings: Settings) -> Answer:
    """Return what a plain method sees of these triangles and the pixel's planes."""
    method, precision = settings.method, settings.precision
    rays = pixel.rays(precision.dtype)
    with np.errstate(over="ignore"):  # what float32 cannot hold is inf, and is not hit
        corners = triangles.corners.astype(precision.dtype)
        planes = [(c.name, *c.points.astype(precision.dtype)) for c in pixel.planes]
    met = [(np.inf, NOWHERE, np.zeros(3))]
    if len(triangles.instance):
        hit, t, s = TESTS[method](rays, *corners)
        for k in np.flatnonzero(hit & within_clip(pixel.camera, t)):
            name = int(triangles.instance[k]), int(triangles.triangle[k])
            met.append((float(t[k]), name, s[:, k].astype(float)))
    for name, point, normal in planes:
        t = plane.intersect(rays, point[:, None], normal[:, None])
        if within_clip(pixel.camera, t)[0]:
            met.append((float(t[0]), name, np.zeros(3)))
    t, seen, s = min(met, key=lambda m: m[:2])
    return Answer(method, precision, seen, t, s)


def certified_hits(pixel: Pixel, triangles: WorldTriangles) -> Hits:
    """Return the certified `Hits` of the pixel's one ray among these triangles and its planes."""
    planes = [(c.points[0], c.points[1]) for c in pixel.planes]
    clip = pixel.camera.clip_start, pixel.camera.clip_end
    around = corner_rays(pixel.camera)  # the bounds are those for all of the picture's rays
    ladder = Ladder(pixel.rays(), Surfaces(planes, pixel.first_plane), clip, around)
    every = np.arange(len(triangles.instance))
    if len(every):
        ladder.test(Pairs(np.zeros_like(every), every, triangles))
    return result_of(ladder.hits(Statistics()))


def certified_answer(pixel: Pixel) -> Answer:
    """Return the answer that is proven; NOT_CERTIFIED where this process can prove nothing."""
    hits = certified_hits(pixel, pixel.world_triangles())
    certainty = Certainty(int(hits.certainty[0]))
    return Answer(
        Method.CERTIFIED,
        Precision.FLOAT64,
        (int(hits.instance[0]), int(hits.triangle[0])),
        float(hits.t[0]),
        hits.s[:, 0],
        Certainty.NOT_CERTIFIED if broken_assumptions() else certainty,
        hits.ties.get(0, frozenset()),
    )

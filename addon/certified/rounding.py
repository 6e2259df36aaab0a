"""Bounds the two roundings before the proof, and counts the pixels that they change.

Rays and corners are rounded before they are stored, and the proof is about what is stored.
Unrounded, the camera's own rays, x right + y up + forward for a pixel's centre, and
world_from_object . vertex are fractions, which may be other numbers.
"""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..arrays import Floats, Index, Integers
from ..methods import Method
from ..scene import SceneError, ViewWindow
from ..tracer.camera import Rays, camera_rays, corner_rays, dual_axes, film_positions, pixel_size
from ..tracer.candidates import candidates, cull
from ..tracer.hits import NOTHING, Hits, Name
from ..tracer.vector import Vectors, rational
from ..tracer.world import reaches, world_corners
from .arithmetic import check_assumptions
from .bounds import BOUND
from .ladder import BY_INTEGERS, Decisions, Ladder
from .surfaces import Candidates, Surfaces

if TYPE_CHECKING:
    from ..scene import Camera, Region, Scene
    from ..tracer.frame import Frame
    from ..tracer.progress import Work

# The roundings on the longest path, and one for the bound itself. A ray has four for x, a product
# and two sums.
_RAY = 8 * 2.0**-53
_CORNER = 5 * 2.0**-53  # a product and three sums
_SLACK = 2.0**-1060  # far above what gradual underflow may lose
_ROWS = 32  # of a tile


class Rounding(NamedTuple):
    """Bounds for a whole picture; lengths are sums over x, y and z."""

    ray: float  # of the error of a direction; for parallel rays, of an origin, in metres
    corner: float  # of the error of a corner, in metres
    pixels: float  # how far from its pixel's centre a ray passes

    def __str__(self) -> str:
        moved = f"rays by at most {self.pixels:.1g} px, corners by at most {self.corner:.1g} m"
        return f"before any test, rounding moves {moved}"


@np.errstate(over="ignore", invalid="ignore")  # what overflows has no bound
def rounding(scene: Scene) -> Rounding:
    """Bound how far rounding moves the rays and corners of a scene."""
    camera = scene.camera
    w = camera.window
    x = abs(w.left) + abs(w.right)
    y = abs(w.bottom) + abs(w.top)
    frame = np.stack((camera.right, camera.up, camera.forward, camera.origin))
    ray = _RAY * camera.projection.terms(x, y, frame) + _SLACK
    aside = np.max((np.abs(dual_axes(camera)) * ray).sum(axis=1))
    pixels = aside * camera.projection.slant(max(x, y)) / min(pixel_size(camera))
    corner = np.max((_CORNER * reaches(scene) + _SLACK).sum(axis=0), initial=0.0)
    return Rounding(float(ray.sum()), float(corner), float(pixels))


def check_is_proven(method: str) -> None:
    """Raise a SceneError if a method proves nothing: then there is no proof to round before."""
    if Method(method).is_plain:
        raise SceneError("--check-rounding is about proven pixels: --method certified has them")


def check_can_be_checked(camera: Camera) -> None:
    """Raise a SceneError if a camera's unrounded rays are no fractions."""
    if not camera.projection.is_linear:
        raise SceneError(
            f"The unrounded rays of an {camera.projection.name} camera are sines and cosines, "
            "which no fractions are: --check-rounding is for other cameras."
        )


def check_rounding(scene: Scene, frame: Frame) -> Work[list[str]]:
    """Count the pixels that would show another surface if nothing had been rounded; in words.

    Bounds that hold for all moved rays and corners decide most pixels. Fractions decide the others.

    Raises
    ------
    SceneError
        If rounding may move what is seen first behind the eye, if nothing is proven, or if rays
        are no fractions.
    """
    check_assumptions()
    camera = scene.camera
    check_is_proven(frame.statistics.method)
    check_can_be_checked(camera)
    region = camera.region
    loose, aside, reach = _loosened(scene)
    plan = yield from cull(loose, np.dtype(float), 1 << 26, reach)
    around = _around(corner_rays(camera), aside)
    found = _Found(scene, np.stack((frame.instance_index, frame.triangle_index)))
    for y in range(region.y0, region.y1, _ROWS):
        tile = replace(region, y0=y, y1=min(y + _ROWS, region.y1))
        film = film_positions(tile)
        ladder = Ladder.of(scene, camera_rays(camera, *film), around, aside)
        for _, pairs in candidates(plan, tile):
            if pairs:
                ladder.test(pairs)
        left, clear, surfaces = ladder.left()
        for part in left.take(np.flatnonzero(~clear)).by_ray(BY_INTEGERS):
            ray, seen = _unrounded(scene, film, part, surfaces)
            found.enter(tile, ray, seen, part, surfaces)
        yield (tile.y1 - region.y0) / region.height
    return found.lines()


def _loosened(scene: Scene) -> tuple[Scene, float, float]:
    """Return a scene whose clip range has room for rounding, and how far rays may be moved.

    Rays are moved by a length at the least depth that is seen, and by pixels. Moving a corner moves
    no point of its triangle farther than itself: it counts as moving the ray. All is twice the
    bound, as the moved numbers are rounded, too.
    """
    camera = scene.camera
    w = camera.window
    off = rounding(scene)
    axes = float(np.max(np.abs(dual_axes(camera)).sum(axis=1)))
    along = 2 * (off.ray + off.corner) * axes  # how far a depth is moved
    start = camera.clip_start - along
    loose = scene.seen_by(replace(camera, clip_start=start, clip_end=camera.clip_end + along))
    aside = 2 * (off.ray + off.corner / camera.projection.scale(loose.camera.clip_start))
    slant = camera.projection.slant(max(abs(w.left), abs(w.right), abs(w.bottom), abs(w.top)))
    return loose, aside, aside * axes * slant / min(pixel_size(camera))


def _around(rays: Rays, aside: float) -> Rays:
    """Return rays so far around others that error bounds for them hold for rays moved aside, too.

    An error bound is at least BOUND times the largest components.
    """
    ends = np.array((-1, 1)).repeat(4) * aside / BOUND

    def widened(vectors: Vectors) -> Vectors:
        return vectors if vectors.shape[1] == 1 else np.tile(vectors, 2) + ends

    return Rays(widened(rays.origins), widened(rays.directions))


class _Found:
    """The pixels that would show another surface; `stored` (2, h, w) is what they show."""

    def __init__(self, scene: Scene, stored: Integers) -> None:
        self._scene = scene
        self._stored = stored
        self._asked = 0
        self._others: list[tuple[int, int]] = []
        self._cracks: dict[str, str] = {}

    def enter(
        self, tile: Region, ray: Index, seen: Index, near: Candidates, surfaces: Surfaces
    ) -> None:
        """Compare what rays of a tile see unrounded, (2, n), with what is stored.

        `near` are all surfaces that these rays come near.
        """
        region = self._scene.camera.region
        rows = slice(tile.y0 - region.y0, tile.y1 - region.y0)
        shown = self._stored[:, rows].reshape(2, -1)[:, ray]
        self._asked += len(ray)
        for k in np.flatnonzero((seen != shown).any(axis=0)).tolist():
            own = int(ray[k])
            pixel = region.x0 + own % region.width, tile.y0 + own // region.width
            self._others.append(pixel)
            instance, triangle = surfaces.names(near.surface[near.ray == own])
            for other in zip(instance.tolist(), triangle.tolist(), strict=True):
                self._enter_crack(pixel, _name(seen[:, k]), _name(shown[:, k]), other)

    def _enter_crack(self, pixel: tuple[int, int], seen: Name, shown: Name, other: Name) -> None:
        """Note a crack if the ray passes between two triangles that share an edge unrounded."""
        if shown in (seen, other) or not _is_crack(self._scene, seen, other):
            return
        first, second = sorted((seen[0], other[0]))
        both = f"{self._called(first)} and {self._called(second)} share an edge"
        crack = f"{both}, but rounding parts it"
        self._cracks.setdefault(crack, f"the ray of pixel {pixel} passes between")

    def _called(self, instance: int) -> str:
        name = self._scene.objects[self._scene.instances[instance].object]
        return f"'{name}' (instance {instance})"

    def lines(self) -> list[str]:
        """Return what was found, in words."""
        at = f", as at {self._others[0]}" if self._others else ""
        total = self._stored[0].size
        count = f"{len(self._others):,} of {total:,} pixels would show another surface unrounded"
        cracks = [f"a crack: {both}: {where}" for both, where in self._cracks.items()]
        return [f"{count}{at} ({self._asked:,} were asked exactly)", *cracks]


def _name(column: Index) -> Name:
    return int(column[0]), int(column[1])


def _unrounded(
    scene: Scene, film: tuple[Floats, Floats], found: Candidates, surfaces: Surfaces
) -> tuple[Index, Index]:
    """Return the rays of these candidates, (n,), and what they see in fractions: names, (2, n)."""
    which, ray = np.unique(found.ray, return_inverse=True)
    camera = copy(scene.camera)
    w = camera.window
    window = ViewWindow(*rational((w.left, w.right, w.bottom, w.top)))
    # Not by `replace`: a camera of fractions is refused when it is made.
    vars(camera).update(window=window, world_from_camera=rational(camera.world_from_camera))
    unit = 4 * camera.width * camera.height  # of lengths: denominators are then powers of two
    px, py = film
    exact = camera_rays(camera, rational(px[which]), rational(py[which]), object)
    rays = Rays(exact.origins * unit, exact.directions * unit)
    some, surface = surfaces.only(found.surface)
    corners = world_corners(scene, some.triangles.instance, some.triangles.triangle, object)
    planes = [(rational(point) * unit, normal) for point, normal in some.planes]
    triangles = replace(some.triangles, corners=corners * unit)
    some = replace(some, planes=planes, triangles=triangles)
    hits = Hits.none(len(which))
    decisions = Decisions(hits, rays, some, (camera.clip_start, camera.clip_end), rays)
    decisions.by_integers(replace(found, ray=ray, surface=surface))
    return which, np.stack((hits.instance, hits.triangle))


def _is_crack(scene: Scene, one: Name, other: Name) -> bool:
    """Return whether triangles of two instances share an edge unrounded, but not as stored."""
    if one[0] == other[0] or NOTHING in (one[1], other[1]):
        return False
    unrounded = _shared_corners(scene, one, other, object)
    return unrounded == 2 and _shared_corners(scene, one, other, float) < 2


def _shared_corners(scene: Scene, one: Name, other: Name, dtype: type) -> int:
    """Count the corners that two triangles have in common in world space."""
    instance, triangle = np.array((one, other)).T
    corners = world_corners(scene, instance, triangle, dtype).transpose(2, 0, 1).tolist()
    first, second = ({tuple(corner) for corner in of_one} for of_one in corners)
    return len(first & second)

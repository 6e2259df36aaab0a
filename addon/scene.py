"""The contract between Blender (or a file) and the tracer: plain arrays in frozen dataclasses.

A `Scene` checks its input, so that nothing after this file has to ask whether an index is in range
or a vertex is finite.
World space is Blender's: metres, Z up. Camera space: -Z forward, +Y up.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from copy import copy
from dataclasses import dataclass, field, fields, is_dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from .arrays import Array, Bools, Colors, Floats, Index, Integers, Places
from .projections import PERSPECTIVE, PROJECTIONS, Projection

# Of a camera's axes: their inverse, two factors by the determinant, is below 2^602.
_LONGEST = 2.0**200
# Of a pixel on the view window: its inverse is finite, and where gradual underflow puts a ray, some
# 2^-1075 beside its place, is less than 2^-54 of a pixel beside it, far below the bounds' 2^-45.
_LEAST_PIXEL = 2.0**-1020
_MOST_PIXELS = 1 << 28  # along a side: the numbers of eight rows' pixels are int32

GREY = (0.8, 0.8, 0.8, 1.0)  # what Blender draws where a face has no material


class SceneError(ValueError):
    """The scene cannot be traced; the message names the thing and what to do about it."""


@dataclass(frozen=True)
class ViewWindow:
    """The bounds of the whole picture along the camera's right and up axes.

    On the plane at depth 1 (perspective), in metres (orthographic), or, of a panorama, in radians
    of longitude and latitude.
    """

    left: float
    right: float
    bottom: float
    top: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height."""
        return self.right - self.left, self.top - self.bottom

    @property
    def centre(self) -> tuple[float, float]:
        """The point in its middle."""
        return (self.left + self.right) / 2, (self.bottom + self.top) / 2

    def moved(self, x: float, y: float) -> ViewWindow:
        """Return it moved to the right and up."""
        return ViewWindow(self.left + x, self.right + x, self.bottom + y, self.top + y)

    def scaled(self, x: float, y: float) -> ViewWindow:
        """Return it scaled about the axis; a negative factor mirrors it."""
        left, right = sorted((x * self.left, x * self.right))
        bottom, top = sorted((y * self.bottom, y * self.top))
        return ViewWindow(left, right, bottom, top)

    def about(self, centre: tuple[float, float], x: float = 1.0, y: float = 1.0) -> ViewWindow:
        """Return one about another centre, of its size times x and y."""
        (cx, cy), (width, height) = centre, self.size
        half_x, half_y = x * width / 2, y * height / 2
        return ViewWindow(cx - half_x, cx + half_x, cy - half_y, cy + half_y)


@dataclass(frozen=True)
class Region:
    """The pixels to trace, x0 <= x < x1 and y0 <= y < y1, row 0 of the picture at the bottom."""

    x0: int
    y0: int
    x1: int
    y1: int

    @property
    def width(self) -> int:
        """Columns, in pixels."""
        return self.x1 - self.x0

    @property
    def height(self) -> int:
        """Rows, in pixels."""
        return self.y1 - self.y0

    @property
    def halves(self) -> tuple[Region, Region]:
        """The lower and the upper half; of one row, the left and the right."""
        y, x = (self.y0 + self.y1) // 2, (self.x0 + self.x1) // 2
        if self.height > 1:
            return replace(self, y1=y), replace(self, y0=y)
        return replace(self, x1=x), replace(self, x0=x)


@dataclass(frozen=True, eq=False)
class Camera:
    """A view window in front of a frame of axes.

    `world_from_camera` is (4, 4): its columns are right, up, backward and the position. The axes
    carry no scale of the camera object, but may be mirrored or sheared, as Blender's own may.

    Raises
    ------
    SceneError
        If there is nothing to see through it: an empty picture, clip range or window.
    """

    world_from_camera: Floats
    window: ViewWindow
    width: int  # of the whole picture, in pixels
    height: int
    projection: Projection = PERSPECTIVE  # one of `projections.PROJECTIONS`
    clip_start: float = 0.1  # depths along the view axis, metres; hits outside are not seen
    clip_end: float = 1000.0
    region: Region = None  # type: ignore[assignment]  # by default, the whole picture
    name: str = "Camera"

    def __post_init__(self) -> None:
        _store(
            self,
            "world_from_camera",
            _finite(self.world_from_camera, (4, 4), f"The matrix of camera '{self.name}'"),
        )
        axes = self.world_from_camera[:3, :3]
        if np.abs(axes).max() > _LONGEST or abs(np.linalg.det(axes)) < 1 / _LONGEST:
            wrong = "are too long" if np.abs(axes).max() > _LONGEST else "lie in a plane"
            raise SceneError(f"The axes of camera '{self.name}' {wrong}: clear its scale.")
        if self.region is None:
            _store(self, "region", Region(0, 0, self.width, self.height))
        check_size(self.width, self.height)
        if self.projection not in PROJECTIONS.values():
            raise SceneError(f"Camera '{self.name}' must be one of: {', '.join(PROJECTIONS)}.")
        r = self.region
        if not (0 <= r.x0 < r.x1 <= self.width and 0 <= r.y0 < r.y1 <= self.height):
            raise SceneError(
                f"The render border holds no pixel (x {r.x0} to {r.x1}, y {r.y0} to {r.y1} of "
                f"{self.width} x {self.height}): enlarge it or switch it off."
            )
        self._check_clip_range()
        self._check_window()

    def _check_clip_range(self) -> None:
        if not self.clip_start < self.clip_end:
            raise SceneError(
                f"Camera '{self.name}' sees nothing: its clip start ({self.clip_start:g} m) is not "
                f"below its clip end ({self.clip_end:g} m)."
            )
        if not self.projection.sees_behind and not self.clip_start > 0:
            raise SceneError(
                f"Camera '{self.name}' has a clip start of {self.clip_start:g} m: what a "
                f"{self.projection.name} camera sees begins in front of it, so raise it above 0."
            )

    def _check_window(self) -> None:
        w = self.window
        reach = max(map(abs, (w.left, w.right, w.bottom, w.top)))
        with np.errstate(all="ignore"):
            farthest = np.abs(self.world_from_camera[:3]) @ (reach, reach, 1.0, 1.0)
            size = w.size
        known = np.isfinite([reach, *farthest, *size]).all() and reach <= self.projection.farthest
        if not (known and min(size) > 0):
            raise SceneError(
                f"Camera '{self.name}' has an empty or infinite view window ({w}): check its focal "
                "length, sensor size, orthographic scale, longitudes, latitudes and shift."
            )
        if (least := min(size[0] / self.width, size[1] / self.height)) < _LEAST_PIXEL:
            raise SceneError(
                f"Camera '{self.name}' has pixels of {least:g}, which float64 cannot tell apart "
                f"(below {_LEAST_PIXEL:g}): enlarge its sensor size or orthographic scale."
            )

    @property
    def origin(self) -> Floats:
        """Position in world space, (3,) float64, metres."""
        return self.world_from_camera[:3, 3]

    @property
    def right(self) -> Floats:
        """World-space direction of +X in the picture, (3,) float64."""
        return self.world_from_camera[:3, 0]

    @property
    def up(self) -> Floats:
        """World-space direction of +Y in the picture, (3,) float64."""
        return self.world_from_camera[:3, 1]

    @property
    def forward(self) -> Floats:
        """World-space viewing direction, (3,) float64."""
        return -self.world_from_camera[:3, 2]

    def to_dict(self) -> dict[str, object]:
        """Return the camera as files hold it, for JSON."""
        return {
            "world_from_camera": self.world_from_camera.tolist(),
            "window": vars(self.window),
            "width": self.width,
            "height": self.height,
            "projection": self.projection.name,
            "clip_start": self.clip_start,
            "clip_end": self.clip_end,
            "region": vars(self.region),
            "name": self.name,
        }


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles in object space, kept in the precision in which they were stored.

    Raises
    ------
    SceneError
        If shapes do not fit, an index is out of range, or a vertex is not finite.
    """

    vertices: Floats  # (v, 3) float32 or float64, metres, finite
    triangles: Integers  # (n, 3), indices into `vertices`
    # Which of an instance's `colors` each triangle shows, (n,); all 0 by default.
    slots: Integers = None  # type: ignore[assignment]
    # Linear RGBA at each corner, (n, 3, 4); where given, it is what the mesh shows.
    corner_colors: Colors | None = None
    name: str = "Mesh"

    def __post_init__(self) -> None:
        what = f"Mesh '{self.name}'"
        vertices: Array = np.asarray(self.vertices)
        if vertices.dtype != np.float32:
            vertices = vertices.astype(np.float64, copy=False)
        _store(self, "vertices", _shaped(vertices, (*vertices.shape[:1], 3), f"{what}: vertices"))
        if not np.isfinite(vertices).all():
            do = "leave out their triangles (scene.drop_non_finite does)"
            raise SceneError(f"{what} has vertices that are not finite: {do}.")
        triangles = np.asarray(self.triangles)
        count = len(triangles)
        slots = np.zeros(count, np.int32) if self.slots is None else np.asarray(self.slots)
        of_triangles = f"{what}: indices of triangles"
        _store(self, "triangles", _indices(triangles, (count, 3), len(vertices), of_triangles))
        _store(self, "slots", _indices(slots, (count,), 2**31, f"{what}: slots"))
        if self.corner_colors is not None:
            colors = np.asarray(self.corner_colors, np.float32)
            _store(self, "corner_colors", _shaped(colors, (count, 3, 4), f"{what}: corner_colors"))

    @cached_property
    def bounds(self) -> Floats:
        """Lowest and highest coordinates of the vertices, (2, 3); zero where there are none."""
        if not len(self.vertices):
            return np.zeros((2, 3))
        across = self.vertices.T.copy()  # one behind the other they are looked at much faster
        return np.array((across.min(axis=1), across.max(axis=1)), np.float64)


@dataclass(frozen=True, eq=False)
class Instance:
    """One appearance of a mesh."""

    mesh: int  # index into `Scene.meshes`
    object: int  # index into `Scene.objects`: which object of the scene this is
    world_from_object: Floats  # (4, 4)
    # Linear RGBA by material slot, (k, 4); a slot past the end shows the last one.
    colors: Colors = field(default_factory=lambda: np.array([GREY], np.float32))

    def __post_init__(self) -> None:
        what = f"instance of object {self.object}"
        _store(
            self,
            "world_from_object",
            _finite(self.world_from_object, (4, 4), f"The matrix of {what}"),
        )
        _store(self, "colors", _colors(self.colors, what))


@dataclass(frozen=True, eq=False)
class Plane:
    """An infinite plane through `point` with the (not necessarily unit) `normal`, world space."""

    object: int
    point: Floats
    normal: Floats
    color: Colors = field(default_factory=lambda: np.array(GREY, np.float32))

    def __post_init__(self) -> None:
        _store(self, "point", _finite(self.point, (3,), "The point of an infinite plane"))
        _store(self, "normal", _finite(self.normal, (3,), "The normal of an infinite plane"))
        if not self.normal.any():
            raise SceneError("The normal of an infinite plane is zero: give its object a scale.")
        _store(self, "color", _colors([self.color], "infinite plane")[0])


@dataclass(frozen=True, eq=False)
class Scene:
    """The tracer's input.

    `objects` are names, by the `object` index of instances and planes. Some may have neither: they
    are there, but outside the view.
    """

    camera: Camera
    meshes: tuple[Mesh, ...] = ()
    instances: tuple[Instance, ...] = ()  # of surfaces exactly as near, the lower index is seen
    planes: tuple[Plane, ...] = ()
    # Linear RGBA of a pixel that sees nothing, (4,); alpha 0 for a transparent film.
    background: Colors = field(default_factory=lambda: np.zeros(4, np.float32))
    objects: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name in ("meshes", "instances", "planes", "objects"):
            _store(self, name, tuple(getattr(self, name)))
        _store(self, "background", _colors([self.background], "background")[0])
        for i in self.instances:
            if not 0 <= i.mesh < len(self.meshes):
                raise SceneError(f"An instance names mesh {i.mesh} of {len(self.meshes)}.")
        every: tuple[Instance | Plane, ...] = (*self.instances, *self.planes)
        for shown in every:
            if not 0 <= shown.object < len(self.objects):
                what = "infinite plane" if isinstance(shown, Plane) else "instance"
                raise SceneError(f"An {what} names object {shown.object} of {len(self.objects)}.")

    def with_meshes(self, others: Mapping[int, Mesh]) -> Scene:
        """Return the same with other meshes of some instances, which may share one, by number."""
        new = {id(mesh): mesh for mesh in others.values()}
        number = {key: k for k, key in enumerate(new, len(self.meshes))}
        instances = tuple(
            replace(i, mesh=number[id(others[n])]) if n in others else i
            for n, i in enumerate(self.instances)
        )
        return replace(self, meshes=(*self.meshes, *new.values()), instances=instances)

    def seen_by(self, camera: Camera) -> Scene:
        """Return the same scene with another camera; what is known of it stays known."""
        other = copy(self)
        _store(other, "camera", camera)
        return other

    @cached_property
    def instance_meshes(self) -> Places:
        """Which mesh each instance shows, (k,)."""
        return np.array([i.mesh for i in self.instances], np.intp)

    @cached_property
    def instance_objects(self) -> Integers:
        """Which object each instance and plane is, and -1 at the end, for nothing: (k + 1,)."""
        of_instances = [i.object for i in self.instances]
        return np.array([*of_instances, *(p.object for p in self.planes), -1], np.int32)

    @cached_property
    def instance_matrices(self) -> Floats:
        """world_from_object of every instance, (4, 4, k)."""
        matrices = [i.world_from_object for i in self.instances]
        return np.stack(matrices, axis=-1) if matrices else np.zeros((4, 4, 0))

    @cached_property
    def color_table(self) -> Colors:
        """The colours of all instances below one another, of the planes, and the background.

        (r, 4) linear RGBA; those of surfaces are opaque.
        """
        surfaces = [i.colors for i in self.instances] + [p.color[None] for p in self.planes]
        table = np.concatenate([*surfaces, self.background[None]])
        table[:-1, 3] = 1
        return table

    @cached_property
    def color_rows(self) -> Integers:
        """First and last row in `color_table`, (2, k + 1): of instances, planes, and nothing."""
        counts = np.array([*(len(i.colors) for i in self.instances), *(1,) * len(self.planes), 1])
        ends = np.cumsum(counts)
        return np.stack((ends - counts, ends - 1)).astype(np.int32)

    @property
    def triangle_count(self) -> int:
        """Triangles over all instances."""
        return sum(len(self.meshes[i.mesh].triangles) for i in self.instances)


def check_size(width: int, height: int) -> None:
    """Raise a SceneError if a picture of this size has no pixel, part of one, or too many."""
    for name, value in (("width", width), ("height", height)):
        if not isinstance(value, (int, np.integer)):
            raise SceneError(f"The {name} of the picture is {value!r}; it must be an integer.")
    if width < 1 or height < 1:
        raise SceneError(
            f"The picture has {width} x {height} pixels: raise the resolution or its percentage, "
            "so that both are at least 1."
        )
    if max(width, height) > _MOST_PIXELS:
        raise SceneError(
            f"The picture has {width} x {height} pixels: lower the resolution, so that both are at "
            f"most {_MOST_PIXELS}."
        )


def drop_non_finite(vertices: Floats, triangles: Index) -> tuple[Floats, Bools]:
    """Make vertices finite, and say which triangles may stay.

    Returns
    -------
    vertices : (v, 3)
        With zeros where a coordinate was not finite, so that indices stay as they were.
    keep : (n,) bool
        False for triangles that touched such a vertex.
    """
    if np.isfinite(vertices).all():
        return vertices, np.ones(len(triangles), bool)
    finite = np.isfinite(vertices).all(axis=1)
    cleared = np.where(finite[:, None], vertices, vertices.dtype.type(0))
    return cleared, finite[triangles].all(axis=1)


def _store(instance: object, name: str, value: object) -> None:
    object.__setattr__(instance, name, value)  # the one way into a frozen dataclass


def _shaped(array: Array, shape: tuple[int, ...], what: str) -> Array:
    """Return an array of this shape, read-only."""
    if array.shape != shape:
        raise SceneError(f"{what} must have the shape {shape}, not {array.shape}.")
    if array.flags.writeable:
        array = array.view()
        array.flags.writeable = False
    return array


def _finite(value: object, shape: tuple[int, ...], what: str) -> Floats:
    """Return a copy in float64 of this shape, read-only; its numbers must be finite."""
    array = _shaped(np.array(value, np.float64), shape, what)
    if not np.isfinite(array).all():
        raise SceneError(f"{what} must be finite numbers.")
    return array


def _indices(array: Array, shape: tuple[int, ...], end: int, what: str) -> Integers:
    """Return integers from 0 to below `end` as int32, of this shape, read-only."""
    if array.size:
        if array.dtype.kind not in "iu":
            raise SceneError(f"{what} must be integers, not {array.dtype}.")
        if array.min() < 0 or array.max() >= end:
            raise SceneError(f"{what} must be at least 0 and below {end}.")
    return _shaped(array.astype(np.int32, copy=False), shape, what)


def _colors(value: object, what: str) -> Colors:
    """Return a copy of one linear RGBA or more, (k, 4), read-only."""
    colors = np.array(value, np.float32, ndmin=1)
    return _shaped(colors, (max(1, len(colors)), 4), f"The linear RGBA of {what}")


def without(scene: Scene, names: Collection[str]) -> Scene:
    """Return a scene without some objects."""
    numbers = {n for n, name in enumerate(scene.objects) if name in names}
    return replace(
        scene,
        instances=tuple(i for i in scene.instances if i.object not in numbers),
        planes=tuple(p for p in scene.planes if p.object not in numbers),
    )


def alike(first: Any, second: Any) -> bool:
    """Return whether two scenes, or parts of them, hold the same, but for memory."""
    if first is second or type(first) is not type(second):
        return first is second
    if isinstance(first, tuple):
        return len(first) == len(second) and all(map(alike, first, second))
    if is_dataclass(first):
        return all(alike(getattr(first, f.name), getattr(second, f.name)) for f in fields(first))
    return np.array_equal(first, second)  # also of two numbers or texts

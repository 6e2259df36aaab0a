"""The surfaces of a scene: meshes, their instances, and infinite planes."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..arrays import Array, Bools, Colors, Floats, Index, Integers
from .checks import SceneError, colors, finite, indices, shaped, store

GREY = (0.8, 0.8, 0.8, 1.0)  # what Blender draws where a face has no material


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
        store(self, "vertices", shaped(vertices, (*vertices.shape[:1], 3), f"{what}: vertices"))
        if not np.isfinite(vertices).all():
            do = "leave out their triangles (scene.drop_non_finite does)"
            raise SceneError(f"{what} has vertices that are not finite: {do}.")
        triangles = np.asarray(self.triangles)
        count = len(triangles)
        slots = np.zeros(count, np.int32) if self.slots is None else np.asarray(self.slots)
        of_triangles = f"{what}: indices of triangles"
        store(self, "triangles", indices(triangles, (count, 3), len(vertices), of_triangles))
        store(self, "slots", indices(slots, (count,), 2**31, f"{what}: slots"))
        if self.corner_colors is not None:
            colors = np.asarray(self.corner_colors, np.float32)
            store(self, "corner_colors", shaped(colors, (count, 3, 4), f"{what}: corner_colors"))

    @cached_property
    def bounds(self) -> Floats:
        """Lowest and highest coordinates of the vertices, (2, 3); zero where there are none."""
        if not len(self.vertices):
            return np.zeros((2, 3))
        across = self.vertices.T.copy()  # contiguous, which is much faster
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
        store(
            self,
            "world_from_object",
            finite(self.world_from_object, (4, 4), f"The matrix of {what}"),
        )
        store(self, "colors", colors(self.colors, what))


@dataclass(frozen=True, eq=False)
class Plane:
    """An infinite plane through `point` with the (not necessarily unit) `normal`, world space."""

    object: int
    point: Floats
    normal: Floats
    color: Colors = field(default_factory=lambda: np.array(GREY, np.float32))

    def __post_init__(self) -> None:
        store(self, "point", finite(self.point, (3,), "The point of an infinite plane"))
        store(self, "normal", finite(self.normal, (3,), "The normal of an infinite plane"))
        if not self.normal.any():
            raise SceneError("The normal of an infinite plane is zero: give its object a scale.")
        store(self, "color", colors([self.color], "infinite plane")[0])


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

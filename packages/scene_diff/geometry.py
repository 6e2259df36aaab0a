"""The triangles of each object of a scene, in the world."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.scene import Instance, Scene, SceneError
from reference_tracer.tracer.world import world_corners

from .moves import Move

# What a file's digits move a coordinate by: the rounding of a float32, of its product with a matrix
# and a parent's, and of a text with six digits after the point.
ROUNDINGS = 16 * 2.0**-24  # of the object's largest coordinate
DIGITS = 1e-6  # metres
LARGEST = 1e150  # metres: the square of it is finite


@dataclass(frozen=True, eq=False)
class Shape:
    """The triangles of an object, in world space."""

    triangles: Floats  # (n, 3, 3) metres
    # The largest number that rounding was in proportion to, metres: a far object has no part in
    # what a near one is allowed.
    reach: float

    @classmethod
    def joined(cls, parts: Iterable[Shape]) -> Shape:
        """Return the triangles of several as those of one."""
        every = [*parts]
        return cls(np.concatenate([p.triangles for p in every]), max(p.reach for p in every))

    def moved_by(self, move: Move) -> Shape:
        """Return the object, moved."""
        size, by = np.abs(move.axes).sum(axis=1).max(), np.abs(move.by).max()
        return Shape(move.of(self.triangles), size * self.reach + by)

    @property
    def tolerance(self) -> float:
        """How far a file's digits may move a coordinate, metres."""
        return ROUNDINGS * self.reach + DIGITS


Shapes = dict[str, Shape]  # by the objects' names


def shapes_of(scene: Scene) -> Shapes:
    """Return the objects of a scene that have triangles.

    Raises
    ------
    SceneError
        If one is too large.
    """
    parts: dict[str, list[Shape]] = {}
    for number, instance in enumerate(scene.instances):
        count = len(scene.meshes[instance.mesh].triangles)
        own = world_corners(scene, np.full(count, number), np.arange(count))  # (3, 3, n)
        corners = np.moveaxis(np.asarray(own, np.float64), -1, 0)
        if not count:
            continue
        name = scene.objects[instance.object]
        if not (np.abs(corners) <= LARGEST).all():
            raise SceneError(f"'{name}' is too large to be compared: scale it down")
        parts.setdefault(name, []).append(Shape(corners, _reach(scene, instance)))
    return {name: Shape.joined(some) for name, some in parts.items()}


def _reach(scene: Scene, instance: Instance) -> float:
    """Return the largest sum of which a coordinate is made, metres: its parts may cancel out."""
    m = np.abs(instance.world_from_object)
    corners = np.abs(np.asarray(scene.meshes[instance.mesh].vertices, np.float64)).max(axis=0)
    return float((m[:3, :3] @ corners + m[:3, 3]).max())

"""The triangles of each object of a scene, in the world."""

from __future__ import annotations

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
class Objects:
    """The objects of a scene by their names: their triangles, (n, 3, 3) metres, world space."""

    triangles: dict[str, Floats]
    # The largest number that rounding was in proportion to, metres: a far object has no part in
    # what a near one is allowed.
    reach: dict[str, float]

    @classmethod
    def of(cls, scene: Scene) -> Objects:
        """Return the objects of a scene that have triangles.

        Raises
        ------
        SceneError
            If one is too large.
        """
        parts: dict[str, list[Floats]] = {}
        reach: dict[str, float] = {}
        for number, instance in enumerate(scene.instances):
            count = len(scene.meshes[instance.mesh].triangles)
            own = world_corners(scene, np.full(count, number), np.arange(count))  # (3, 3, n)
            corners = np.moveaxis(np.asarray(own, np.float64), -1, 0)
            if not count:
                continue
            name = scene.objects[instance.object]
            if not (np.abs(corners) <= LARGEST).all():
                raise SceneError(f"'{name}' is too large to be compared: scale it down")
            parts.setdefault(name, []).append(corners)
            reach[name] = max(reach.get(name, 0.0), _reach(scene, instance))
        return cls({name: np.concatenate(some) for name, some in parts.items()}, reach)

    def moved_by(self, move: Move) -> Objects:
        """Return the objects, all moved alike."""
        size, by = float(np.abs(move.axes).sum(axis=1).max()), float(np.abs(move.by).max())
        return Objects(
            {name: move.of(some) for name, some in self.triangles.items()},
            {name: size * far + by for name, far in self.reach.items()},
        )

    def joined(self, name: str) -> Objects:
        """Return all triangles as one object."""
        every = np.concatenate([*self.triangles.values()])
        return Objects({name: every}, {name: max(self.reach.values())})

    def tolerance(self, name: str) -> float:
        """Return how far a file's digits may move a coordinate of an object, in metres."""
        return ROUNDINGS * self.reach[name] + DIGITS


def _reach(scene: Scene, instance: Instance) -> float:
    """Return the largest sum of which a coordinate is made, metres: its parts may cancel out."""
    m = np.abs(np.asarray(instance.world_from_object, np.float64))
    corners = np.abs(np.asarray(scene.meshes[instance.mesh].vertices, np.float64)).max(axis=0)
    return float((m[:3, :3] @ corners + m[:3, 3]).max())

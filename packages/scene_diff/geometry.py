"""The triangles of each object of a scene, in the world."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.scene import Scene
from reference_tracer.tracer.world import world_corners

from .moves import Move

# What a file's digits move a coordinate by: the rounding of a float32, of its product with a matrix
# and a parent's, and of a text with six digits after the point.
ROUNDINGS = 16 * 2.0**-24  # of the largest coordinate
DIGITS = 1e-6  # metres


@dataclass(frozen=True, eq=False)
class Objects:
    """The objects of a scene by their names: their triangles, (n, 3, 3) metres, world space."""

    triangles: dict[str, Floats]

    @classmethod
    def of(cls, scene: Scene) -> Objects:
        """Return the objects of a scene that have triangles."""
        parts: dict[str, list[Floats]] = {}
        for number, instance in enumerate(scene.instances):
            count = len(scene.meshes[instance.mesh].triangles)
            own = world_corners(scene, np.full(count, number), np.arange(count))  # (3, 3, n)
            corners = np.moveaxis(np.asarray(own, np.float64), -1, 0)
            parts.setdefault(scene.objects[instance.object], []).append(corners)
        joined = {name: np.concatenate(some) for name, some in parts.items()}
        return cls({name: some for name, some in joined.items() if len(some)})

    def moved_by(self, move: Move) -> Objects:
        """Return the objects, all moved alike."""
        return Objects({name: move.of(some) for name, some in self.triangles.items()})

    @property
    def joined(self) -> Floats:
        """All triangles."""
        return np.concatenate([*self.triangles.values(), np.zeros((0, 3, 3))])

    @property
    def tolerance(self) -> float:
        """How far a file's digits may move a coordinate, in metres."""
        return float(ROUNDINGS * np.max(np.abs(self.joined), initial=0.0) + DIGITS)

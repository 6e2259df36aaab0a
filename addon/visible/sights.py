"""What rays through any film positions see, certified."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Index, parts
from ..certified.ladder import Ladder
from ..certified.surfaces import Surfaces
from ..certified.triangle_tree import TriangleTree
from ..scene import Scene
from ..tracer.camera import Rays, camera_rays
from ..tracer.hits import NOTHING, Hits, Statistics
from ..tracer.progress import result_of
from ..tracer.vector import cross, dot
from .faces import Faces

_APART = 2.0**-30  # of t, from a face towards what is before it
_TOGETHER = 1 << 14  # rays that are traced together


class Sights:
    """Traces rays through any film positions."""

    def __init__(self, scene: Scene, faces: Faces) -> None:
        self._scene = scene
        self._faces = faces
        self._tree = TriangleTree.of(scene)

    def look(self, at: Floats) -> tuple[Index, Rays]:
        """Return the faces that rays through film positions (2, n) see, and the rays.

        NOTHING for planes, and for nothing.
        """
        camera = self._scene.camera
        rays = camera_rays(camera, *at)
        return self._trace(
            rays, Surfaces.planes_of(self._scene), (camera.clip_start, camera.clip_end)
        ), rays

    def before(self, face: Index, rays: Rays) -> Index:
        """Return the faces that are met by n rays last before the given ones, (n,), about."""
        a, b, c = self._faces.points[:, self._faces.corners[:, face]].swapaxes(0, 1)
        normal = cross(b - a, c - a)
        t = dot(a - rays.origins, normal) / dot(rays.directions, normal) * (1 - _APART)
        known = np.flatnonzero(np.isfinite(t))
        back = Rays(rays.origins + t * rays.directions, -rays.directions).take(known)
        out = np.full(len(face), NOTHING)
        out[known] = self._trace(back, None, (0.0, np.inf))
        return out

    def _trace(self, rays: Rays, planes: Surfaces | None, clip: tuple[float, float]) -> Index:
        found: list[Index] = [np.zeros(0, np.intp)]
        for some in parts(rays.count, _TOGETHER):
            own = rays.take(np.arange(some.start, some.stop))
            ladder = Ladder(own, planes, clip)
            for pairs in self._tree.pairs(own, *clip):
                ladder.test(pairs)
            found.append(numbers(self._faces, result_of(ladder.hits(Statistics()))))
        return np.concatenate(found)


def numbers(faces: Faces, hits: Hits) -> Index:
    """Return the numbers of the faces that rays see, (n,): NOTHING for planes, and for nothing."""
    own = hits.triangle != NOTHING
    instance = np.where(own, hits.instance, 0)
    return np.where(own, faces.start[instance] + hits.triangle, NOTHING)

"""What rays through any film positions see, certified."""

from __future__ import annotations

import numpy as np

from ..arrays import Floats, Index
from ..certified.any_rays import hits_through
from ..certified.surfaces import Surfaces
from ..certified.triangle_tree import TriangleTree
from ..scene import Scene
from ..tracer.camera import Rays, camera_rays
from ..tracer.hits import NOTHING, Hits, Statistics
from ..tracer.progress import Work
from ..tracer.vector import cross, dot
from .faces import Faces

_APART = 2.0**-30  # of t, from a face towards what is before it


class Sights:
    """Traces rays through any film positions."""

    def __init__(self, scene: Scene, faces: Faces) -> None:
        self._scene = scene
        self._faces = faces
        self._tree = TriangleTree.of(scene)

    def look(self, at: Floats) -> Work[tuple[Index, Rays]]:
        """Return the faces that rays through film positions (2, n) see, and the rays.

        NOTHING for planes, and for nothing.
        """
        camera = self._scene.camera
        rays = camera_rays(camera, *at)
        # Few of the triangles are near: each is prepared with its rays, not all for any.
        origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
        rays = Rays(origins, directions)
        clip = camera.clip_start, camera.clip_end
        return (yield from self._trace(rays, Surfaces.planes_of(self._scene), clip)), rays

    def before(self, face: Index, rays: Rays) -> Work[Index]:
        """Return the faces that are met by n rays last before the given ones, (n,), about."""
        a, b, c = self._faces.points[:, self._faces.corners[:, face]].swapaxes(0, 1)
        normal = cross(b - a, c - a)
        t = dot(a - rays.origins, normal) / dot(rays.directions, normal) * (1 - _APART)
        known = np.flatnonzero(np.isfinite(t))
        back = Rays(rays.origins + t * rays.directions, -rays.directions).take(known)
        out = np.full(len(face), NOTHING)
        out[known] = yield from self._trace(back, Surfaces(), (0.0, np.inf))
        return out

    def _trace(self, rays: Rays, planes: Surfaces, clip: tuple[float, float]) -> Work[Index]:
        work = hits_through(self._tree, rays, planes, clip, Statistics())
        return numbers(self._faces, (yield from work))


def numbers(faces: Faces, hits: Hits) -> Index:
    """Return the numbers of the faces that rays see, (n,): NOTHING for planes, and for nothing."""
    own = hits.triangle != NOTHING
    instance = np.where(own, hits.instance, 0)
    return np.where(own, faces.start[instance] + hits.triangle, NOTHING)

"""What rays through any film positions see, certified."""

from __future__ import annotations

import numpy as np

from ..arrays import Bools, Floats, Index
from ..certified.any_rays import hits_through
from ..certified.surfaces import Surfaces
from ..certified.triangle_tree import TriangleTree
from ..scene import Scene
from ..tracer.camera import Rays, camera_rays
from ..tracer.hits import NOTHING, Hits, Statistics
from ..tracer.progress import Work
from ..tracer.world import WorldTriangles
from .faces import Faces


class Sights:
    """Traces rays through any film positions: none sees another face than `some` (m,)."""

    def __init__(self, scene: Scene, faces: Faces, some: Bools) -> None:
        self._scene = scene
        self._faces = faces
        face = np.flatnonzero(some).astype(np.int32)  # here, all are of one instance
        corners = faces.points[:, faces.corners[:, face]].swapaxes(0, 1)
        self._tree = TriangleTree.made_of(WorldTriangles(corners, np.zeros_like(face), face))

    def look(self, at: Floats, face: Index) -> Work[tuple[Index, Rays]]:
        """Return what rays through film positions (2, n) see, if not behind faces (n,); the rays.

        NOTHING for planes, and for nothing.
        """
        camera = self._scene.camera
        rays = camera_rays(camera, *at)
        # Few of the triangles are near: each is prepared with its rays, not all for any.
        origins, directions = np.broadcast_arrays(rays.origins, rays.directions)
        rays = Rays(origins, directions)
        planes = Surfaces.planes_of(self._scene)
        clip = camera.clip_start, camera.clip_end
        last = self._faces.last[face]
        hits = yield from hits_through(self._tree, rays, planes, clip, Statistics(), last)
        return hits.triangle.astype(np.intp), rays


def numbers(faces: Faces, hits: Hits) -> Index:
    """Return the numbers of the faces that rays see, (n,): NOTHING for planes, and for nothing."""
    own = hits.triangle != NOTHING
    instance = np.where(own, hits.instance, 0)
    return np.where(own, faces.start[instance] + hits.triangle, NOTHING)

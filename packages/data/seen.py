"""Follows named surfaces, wherever they end, to the rays through pixels' centres."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from reference_tracer.arrays import Floats, Integers
from reference_tracer.scene import Scene
from reference_tracer.tracer import plane, shading
from reference_tracer.tracer.camera import Rays, camera_rays, dual_axes
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.vector import Vectors
from reference_tracer.tracer.world import planes_of


@dataclass(frozen=True, eq=False)
class Seen:
    """The values of n pixels, if the ray through each centre met the plane of a named surface.

    A surface beside an edge is followed to the centre: that is where a renderer computes what it
    shows, whichever surface it takes to be there.
    """

    scene: Scene
    film: Floats  # (n, 2) where the rays pass, in pixels of the whole picture
    instance: Integers  # (n,) none of them NOTHING
    triangle: Integers  # (n,)
    t: Floats  # (n,) ray parameter

    @classmethod
    def of(cls, scene: Scene, film: Floats, hits: Hits, t: Floats | None = None) -> Seen:
        """Return what is seen of n hits; `t` (n,) is known if the hits are the centres' own."""
        own = cls(scene, film, hits.instance, hits.triangle, np.zeros(len(hits)))
        return replace(own, t=own._on_planes(own.rays) if t is None else t)

    @cached_property
    def rays(self) -> Rays:
        """The rays through the film positions."""
        return camera_rays(self.scene.camera, *self.film.T)

    @cached_property
    def hits(self) -> Hits:
        """The surfaces, with each corner weighed in full: a bound for all of them.

        With t, for planes.
        """
        measures = np.ones((4, len(self.t)))
        measures[0] = self.t
        known = np.zeros(len(self.t), np.uint8)
        return Hits(self.instance.astype(np.int32), self.triangle.astype(np.int32), known, measures)

    @cached_property
    def normals(self) -> Floats:
        """The geometric unit normals, (n, 3) world space, as `shading.normals` has them."""
        return shading.normals(self.scene, self.hits)

    @property
    def positions(self) -> Floats:
        """Where the rays end, (n, 3) metres, world space."""
        return self.rays.at(self.t).T

    def _on_planes(self, rays: Rays) -> Floats:
        """Return the t at which rays meet the planes of the surfaces, (n,); NaN if they do not."""
        return plane.intersect(rays, self._points, self.normals.T)

    @cached_property
    def _points(self) -> Vectors:
        """A point of each surface, (3, n) world space."""
        return planes_of(self.scene, self.instance, self.triangle)[0]

    def along(self, by: Floats) -> Seen:
        """Return what lies some t (n,) farther on the same rays."""
        return replace(self, t=self.t + by)

    def aside(self, x: float, y: float) -> Seen:
        """Return what rays beside these see of the same planes, (x, y) pixels away."""
        moved = replace(self, film=self.film + np.array((x, y)))
        t = self._on_planes(moved.rays)
        return replace(moved, t=np.where(np.isfinite(t), t, self.t))

    def in_camera(self, vectors: Floats, from_origin: bool) -> Floats:
        """Return world-space vectors (n, 3) in Blender's camera space: right, up, backward.

        Points are taken from the camera's origin, directions are not.
        """
        camera = self.scene.camera
        away = vectors - camera.origin if from_origin else vectors
        x, y, depth = (away @ axis for axis in dual_axes(camera))
        return np.stack((x, y, -depth), axis=1)

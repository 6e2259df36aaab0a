"""Rays that a picture does not have: beside their pixel's centre, or behind its first hit.

The comparison asks with them what a pixel would show had Blender's arithmetic moved it a little.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..scene import Region
from .camera import camera_rays
from .nearest import Hits, Pairs, Plan, candidates, film_positions, test_pairs, test_planes
from .progress import Work
from .shading import positions


@dataclass(frozen=True, eq=False)
class Probe:
    """Some pixels of a tile, with every triangle that rays near their centres may meet."""

    plan: Plan
    px: NDArray[np.float64]  # (n,) film positions of the centres, in pixels of the whole picture
    py: NDArray[np.float64]
    chunks: list[Pairs]  # `pixel` numbers the n pixels

    @classmethod
    def of(cls, plan: Plan, tile: Region, wanted: NDArray[np.bool_]) -> Work[Probe]:
        """Prepare n pixels of a tile, those where `wanted` (row by row from the lowest) is True.

        Yields the share of the work done; returns the probe.
        """
        number = np.cumsum(wanted) - 1
        chunks = []
        for share, some in candidates(plan, tile, wanted):
            if some is not None and len(some.pixel):
                chunks.append(replace(some, pixel=number[some.pixel]))
            yield share
        px, py = film_positions(tile, 0.0, 0.0)
        return cls(plan, px[wanted], py[wanted], chunks)

    def points(self, hits: Hits) -> NDArray[np.float64]:
        """Return where the rays through the n centres end, (n, 3) world space."""
        return positions(camera_rays(self.plan.scene.camera, self.px, self.py), hits)

    def trace(
        self,
        dx: NDArray[np.floating] | float = 0.0,
        dy: NDArray[np.floating] | float = 0.0,
        after: Hits | None = None,
    ) -> Hits:
        """Trace one ray a pixel.

        Parameters
        ----------
        dx, dy : float or (n,)
            Where the ray passes its pixel's centre, in pixels; at most the plan's reach.
        after : Hits, optional
            Of the n pixels: only what lies behind them counts.
        """
        scene, settings = self.plan.scene, self.plan.settings
        rays = camera_rays(scene.camera, self.px + dx, self.py + dy, settings.precision.dtype)
        hits = Hits.none(len(self.px))
        test_planes(scene, rays, hits, after)
        for some in self.chunks:
            test_pairs(scene, settings, rays, some, hits, after)
        return hits

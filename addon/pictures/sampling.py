"""How the other side's picture was sampled: by what renderer, where in a pixel, and how often."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..scene import SceneError
from .bounds import DECIDABLE, SNAPPING
from .renderers import RASTER, Renderer


@dataclass(frozen=True)
class Sampling:
    """The places of a picture's samples, and its renderer's rounding; in pixels."""

    sample_radius: float = 0.0  # how far from a pixel's centre it is sampled on purpose
    # How far the filter reaches that mixes several samples of a pixel; 0 for one sample.
    filter_radius: float = 0.0
    snapping: float = SNAPPING  # the step to which its rasteriser rounds triangles' corners
    # Metres: Embree drew it, which takes triangles with a coordinate beyond for invalid; else inf.
    farthest: float = np.inf
    renderer: Renderer = RASTER  # whose rounding excuses a pixel

    def to_dict(self) -> dict[str, object]:
        """Return what JSON says of it."""
        return {
            "sample_radius": self.sample_radius,
            "renderer": self.renderer.name,
            "snapping": self.snapping,
            "filter_radius": self.filter_radius,
        }

    @property
    def off_center(self) -> float:
        """How far from the pixel's centre a sample may lie, beyond SNAPPING."""
        return self.sample_radius + max(self.snapping - SNAPPING, 0.0)

    def check(self, source: object) -> None:
        """Refuse samples so far from the pixels' centres that nothing can be decided.

        Raises
        ------
        SceneError
            If they are; it names the picture's source.
        """
        if SNAPPING + self.off_center >= DECIDABLE:
            raise SceneError(
                f"{source} cannot be compared: it is sampled up to {self.sample_radius:.3g} "
                f"px from the pixels' centres, and corners are rounded to {self.snapping:.3g} px. "
                f"Together these must be less than {DECIDABLE} px."
            )


AT_CENTRES = Sampling()  # one sample a pixel, at its centre, of a rasteriser

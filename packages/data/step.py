"""How a file rounds the numbers that it holds: the only allowance that comes from the file."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.pictures.bounds import U32
from reference_tracer.pictures.storage import LEVEL_SLACK


@dataclass(frozen=True)
class Step:
    """How a file stores a number: floats of a type, or integers, of some unit."""

    type: str  # numpy's name of the floats, or '' for integers
    unit: float = 1.0  # what 1 is
    cut: bool = False  # digits are cut off, not rounded

    @property
    def words(self) -> str:
        """The type of the numbers, or their step, in words."""
        return self.type or f"steps of {self.unit:.6g}"

    def half(self, values: Floats) -> Floats:
        """Return how far rounding to the nearest moves values at most, in their shape.

        Of integers a little more: their writers compute in float32, as for a picture's levels.
        """
        if not self.type:
            return np.full(np.shape(values), (0.5 + LEVEL_SLACK) * self.unit)
        stored = np.nan_to_num(np.abs(values / self.unit), posinf=0.0)
        size = np.minimum(stored, float(np.finfo(self.type).max)).astype(self.type)
        return self.unit * np.spacing(size).astype(np.float64) / (1 if self.cut else 2)

    def holds(self, values: Floats) -> bool:
        """Return whether all finite values lie on such steps, but for float32's own rounding."""
        values = values[np.isfinite(values)]
        if self.type:
            with np.errstate(over="ignore"):
                on = self.unit * (values / self.unit).astype(self.type).astype(np.float64)
        else:
            on = np.rint(values / self.unit) * self.unit
        return bool((np.abs(values - on) <= U32 * np.abs(values)).all())

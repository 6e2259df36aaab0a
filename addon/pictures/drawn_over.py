"""What draws itself over surfaces in a picture, as hair does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..arrays import Colors, Integers, Where
from .identity import NOTHING

D = TypeVar("D", bound=np.generic)


@dataclass(frozen=True, eq=False)
class DrawnOver:
    """Features that draw themselves over surfaces, as hair does: where, and what is beneath."""

    feature: Integers  # (...) its index among the unmodelled features, or NOTHING
    beneath: Colors | None = None  # (..., 4) the colour without these; NaN: not known

    @property
    def known(self) -> Integers:
        """The feature that each pixel shows over known surfaces, (...), or NOTHING."""
        known = self.beneath is not None and np.isfinite(self.beneath).all(axis=-1)
        return np.where(known, self.feature, np.int32(NOTHING))

    def taken_off(self, color: Colors) -> Colors:
        """Return colours (..., 4) with those beneath in place of them, where they are known."""
        if self.beneath is None:
            return color
        return np.where((self.known != NOTHING)[..., None], self.beneath, color)

    def at(self, where: Where) -> DrawnOver:
        """Return some of the pixels."""
        return DrawnOver(self.feature[where], some(self.beneath, where))


def some(values: NDArray[D] | None, where: Where) -> NDArray[D] | None:
    """Index an optional array."""
    return None if values is None else values[where]

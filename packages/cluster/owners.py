"""What a worker finds of rays, as it travels: owners, and what cannot be found again here.

Whose surface each ray sees, and how that was decided. Of a certified picture t and the barycentrics
follow from the owners, and are found here, once they are asked for: only where integers decided who
is nearest they come along.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from reference_tracer.certainty import Certainty
from reference_tracer.certified.measures import Known, Measured
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer.hits import Hits, Statistics
from reference_tracer.tracer.ties import Ties


@dataclass(frozen=True, eq=False)
class Owners:
    """What n rays see, row by row, by the certified method."""

    names: NDArray[np.int32]  # (2, n): instance and triangle
    certainty: NDArray[np.uint8]  # (n,)
    known: Known  # of all rays that integers decided, and no other
    ties: Ties

    @classmethod
    def of(cls, hits: Hits) -> Owners:
        """Return what hits say."""
        decided = np.flatnonzero(hits.certainty > Certainty.BOUND)
        names = np.stack((hits.instance, hits.triangle))
        return cls(names, hits.certainty, Known(decided, hits.measured(decided)), hits.ties)


def joined(every: Sequence[Owners], scene: Scene, band: Region, dx: float, dy: float) -> Hits:
    """Return what owners are of a band, row by row: what the sweep finds of it."""
    starts = np.cumsum([0, *(len(each.certainty) for each in every)]).tolist()
    instance, triangle = np.concatenate([each.names for each in every], axis=1)
    numbered = list(zip(every, starts, strict=False))
    known = Known.joined([replace(e.known, ray=e.known.ray + s) for e, s in numbered])
    return Hits(
        instance,
        triangle,
        np.concatenate([each.certainty for each in every]),
        Measured(scene, band, known, dx, dy),
        Ties.joined([each.ties.numbered(start) for each, start in numbered]),
    )


def count_in(own: Statistics, other: Statistics) -> None:
    """Add what a worker says that it took."""
    own.pairs_tested += other.pairs_tested
    own.reasons += other.reasons

"""Finds over which range depths were normalised: two numbers, from the pixels alone."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.diagnosis.evidence import Evidence, spread
from reference_tracer.tracer.hits import NOTHING

from ..kind import Data
from ..seen import Seen
from .turned import Turned

_LEAST = 16  # pixels that say where values are 0 and full
_MOST = 4096
_OUTLIERS = 1  # per cent of the pixels at either end that may be wrong for another reason
_SLOPES = 65  # that are tried at once; the next ones lie beside the best
_ROUNDS = 8
_BEFORE = 0.01  # of the range: as far may it begin behind the camera
_OFFSET = 1e-3  # a slope of 1, a metre a metre, is of depths with an offset


def normalised(evidence: Evidence, data: Data) -> Iterator[Turned]:
    """Guess at which depths values are 0 and full: the former is the larger if reversed."""
    where = evidence.unexplained & (evidence.frame.instance_index != NOTHING) & ~data.blank
    at = spread(where, _MOST)
    held = data.values.reshape(-1)[at]
    made = data.of_frame(evidence.frame).reshape(-1)[at]
    if len(at) < _LEAST or not np.ptp(made) > 0:
        return
    if np.percentile(held, 100 - _OUTLIERS) > data.full or np.percentile(held, _OUTLIERS) < 0:
        return
    start, slope = _line(made, held, data.step.half(held))
    if not slope or abs(slope - 1) < _OFFSET:
        return
    zero, one = -start / slope, (data.full - start) / slope
    if min(zero, one) < -_BEFORE * abs(one - zero):
        return

    def turn(made: Floats, seen: Seen) -> Floats:
        return start + slope * made

    yield Turned((zero, one), turn=turn)


def _line(made: Floats, held: Floats, half: Floats) -> tuple[float, float]:
    """Return where the line begins, and its slope, that passes within half a step of most points.

    Of a slope it is known in which room the line may begin, which is the larger the better the
    slope: that is searched.
    """
    order = np.argsort(made)
    few, many = order[: len(order) // 3], order[-(len(order) // 3) :]
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = float(np.nanmedian((held[many] - held[few]) / (made[many] - made[few])))
    reach = abs(slope) / 4
    start = 0.0
    for _ in range(_ROUNDS):
        slopes = slope + reach * np.linspace(-1, 1, _SLOPES)
        along = slopes[:, None] * made
        low = np.percentile(held - half - along, 100 - _OUTLIERS, axis=1)
        high = np.percentile(held + half - along, _OUTLIERS, axis=1)
        best = int(np.argmax(high - low))
        slope, start = float(slopes[best]), float(low[best] + high[best]) / 2
        reach *= 4 / _SLOPES
    return start, slope

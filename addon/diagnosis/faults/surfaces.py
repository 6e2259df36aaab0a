"""The surfaces of a picture, each with one traced colour, away from edges.

What is done to all colours is the same everywhere, so it is looked for in these.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...arrays import Bools, Colors
from ...causes.checks.color import groups, medians
from ...files.images import EIGHT_BITS, encoded
from ...pictures.metrics import boundary
from ...pictures.picture import Picture, Transform
from ...tracer.hits import NOTHING
from ..evidence import Evidence, spread

MOST = 1 << 14  # sampled pixels of surfaces
FLAT = 0.3  # levels of 8 bits: the least standard deviation of noise within a surface
ENOUGH = 32  # pixels, at least, for a surface to be measured


class Surfaces(NamedTuple):
    """The traced and shown colours of k surfaces of one colour each, away from edges."""

    traced: Colors  # (k, 4)
    shown: Colors  # (k, 4) the median of its pixels
    wrong: Bools  # (k,) most of its pixels are unexplained
    noisy: Bools  # (k,) its pixels deviate by more than rounding
    measured: Bools  # (k,) it has enough pixels to say so


def inside(evidence: Evidence) -> Bools:
    """Return which pixels (h, w) show a surface away from edges, and can be judged."""
    inside = ~boundary(evidence.frame) & (evidence.causes.blind < 0)
    inside &= evidence.unexplained | evidence.judged
    return inside & (evidence.frame.instance_index != NOTHING)


def surfaces(evidence: Evidence) -> Surfaces | None:
    """Return the surfaces (cached); None where colours say nothing, or none is wrong."""
    if "surfaces" not in evidence.known:
        evidence.known["surfaces"] = _looked_at(evidence)
    found: Surfaces | None = evidence.known["surfaces"]
    return found


def _looked_at(evidence: Evidence) -> Surfaces | None:
    picture, some = evidence.picture, spread(inside(evidence), MOST)
    if picture.transform is not None or picture.lit or not len(some):
        return None
    traced, shown = (v.reshape(-1, 4)[some] for v in (evidence.frame.color, picture.color))
    if not np.isfinite(shown).all():
        return None
    group = groups(np.column_stack((evidence.frame.instance_index.ravel()[some], traced)))
    first, middle = medians(shown, group)
    count = np.bincount(group)
    wrong = np.bincount(group, evidence.unexplained.ravel()[some]) > count / 2
    if not wrong.any():
        return None
    levels = EIGHT_BITS * encoded(shown)[:, :3]
    means = np.array([np.bincount(group, v) / count for v in levels.T])
    apart = (levels.T - means[:, group]) ** 2
    deviation = np.sqrt(np.max([np.bincount(group, v) / count for v in apart], axis=0))
    return Surfaces(traced[first], middle, wrong, deviation > FLAT, count >= ENOUGH)


def agree(picture: Picture, found: Surfaces, of: Transform | None) -> Bools:
    """Return which of k surfaces agree after a transform of the traced colours, (k,)."""
    one = replace(picture, color=found.shown.astype(np.float32), owners=None)
    return ~replace(one, transform=of).other_color(found.traced)

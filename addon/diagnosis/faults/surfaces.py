"""The surfaces of a picture, each with one traced colour, away from edges.

What is done to all colours is the same everywhere, so it is looked for in these.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...arrays import Bools, Colors, Floats, Index
from ...causes.checks.color import groups, medians
from ...pictures.metrics import boundary
from ...pictures.picture import Picture, Transform
from ...scene import Scene
from ...tracer.hits import NOTHING
from ..evidence import Evidence, spread

MOST = 1 << 15  # sampled pixels of surfaces
ALL = 0.8  # of the surfaces, at least, that are wrong where all are
SEVERAL = 3  # surfaces, at least


class Surfaces(NamedTuple):
    """The traced and shown colours of k surfaces of one colour each, the largest first."""

    instance: Index  # (k,) or plane
    traced: Colors  # (k, 4)
    shown: Colors  # (k, 4) the median of its pixels
    wrong: Bools  # (k,) most of its pixels are unexplained
    alike: Floats  # (k,) the share of its pixels that show the median
    pixels: Index  # (k,) of the sample

    @property
    def nearly_all_wrong(self) -> bool:
        """Whether they are several, and nearly all are wrong."""
        return len(self.wrong) >= SEVERAL and bool(self.wrong.mean() >= ALL)

    def take(self, some: Bools | Index) -> Surfaces:
        """Return some of them."""
        return Surfaces._make(values[some] for values in self)

    def names(self, scene: Scene) -> list[str]:
        """Return the objects that have them."""
        return [scene.objects[n] for n in scene.instance_objects[self.instance]]


def inside(evidence: Evidence) -> Bools:
    """Return which pixels (h, w) show a surface away from edges, and can be judged."""
    return _judged(evidence) & ~boundary(evidence.frame) & (evidence.causes.blind < 0)


def _judged(evidence: Evidence) -> Bools:
    seen = evidence.frame.instance_index != NOTHING
    return seen & (evidence.unexplained | evidence.judged)


def surfaces(evidence: Evidence, whole: bool = False) -> Surfaces | None:
    """Return the surfaces (cached), away from edges or as a `whole`.

    None where colours say nothing, or none is wrong.
    """
    where = _judged if whole else inside
    return evidence.once(f"surfaces {whole}", lambda: _looked_at(evidence, where(evidence)))


def _looked_at(evidence: Evidence, where: Bools) -> Surfaces | None:
    picture = evidence.picture
    some = spread(where, MOST)
    some = some[np.isfinite(picture.color.reshape(-1, 4)[some]).all(axis=1)]
    if picture.transform is not None or picture.lit or not picture.has_colors or not len(some):
        return None
    traced, shown = (v.reshape(-1, 4)[some] for v in (evidence.frame.color, picture.color))
    instance = evidence.frame.instance_index.ravel()[some]
    group = groups(np.column_stack((instance, traced)))
    first, middle = medians(shown, group)
    count = np.bincount(group)
    wrong = np.bincount(group, evidence.unexplained.ravel()[some]) > count / 2
    if not wrong.any():
        return None
    flat = replace(picture, color=middle[group].astype(np.float32), owners=None)
    alike = np.bincount(group, ~flat.other_color(shown)) / count
    found = Surfaces(instance[first], traced[first], middle, wrong, alike, count)
    order = np.argsort(-count, kind="stable")
    return found.take(order)


def agree(picture: Picture, found: Surfaces, of: Transform | None) -> Bools:
    """Return which of k surfaces agree after a transform of the traced colours, (k,)."""
    one = replace(picture, color=found.shown.astype(np.float32), owners=None)
    return ~replace(one, transform=of).other_color(found.traced)

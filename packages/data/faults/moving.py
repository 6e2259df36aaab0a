"""Finds by how much an object was moved, from the points that a file's depths are.

A depth is right to a few parts in 10^7, so that no search by trial comes to the place: it is
solved for. Each point lies on the moved object's surface, n . (p - q) = 0 for the point q that its
own ray meets there: least squares of that, and again with what the rays then meet (point-to-plane
registration: Chen and Medioni, "Object modelling by registration of multiple range images", 1992).
"""

from __future__ import annotations

import numpy as np
from reference_tracer.arrays import Floats, Places
from reference_tracer.diagnosis.evidence import Evidence, spread
from reference_tracer.diagnosis.faults.changes import MOVED
from reference_tracer.diagnosis.faults.fault import instances_named
from reference_tracer.diagnosis.faults.looked import only
from reference_tracer.diagnosis.faults.pose import Posed
from reference_tracer.scene import Scene
from reference_tracer.tracer.hits import Hits
from reference_tracer.tracer.progress import Work

from ..depth import ray_length
from ..kind import Data
from ..seen import Seen
from .turned import data_of

KINDS = "depth", "distance"
_ROUNDS = 12  # of registration; each is a Newton step, and edges need some more
_LEAST = 12  # pixels of an object whose place is solved for
_MOST = 2048
# Shares of the points, the nearest, that are the object's: others show what is before or behind it.
_OWN = (1.0, 0.9, 0.75)
_DONE = 2.0**-26  # metres, per metre of the points' distance: float32 knows no nearer place


def by_points(evidence: Evidence) -> Work[list[Posed]]:
    """Guess where each object that is seen in unexplained pixels is, from their depths."""
    data = data_of(evidence)
    if data.kind.name not in KINDS:
        return []
    out = []
    scene, seen = evidence.case.scene, evidence.frame.object_index
    for name in evidence.suspects:
        own = evidence.unexplained & (seen == scene.objects.index(name)) & ~data.blank
        at = spread(own, _MOST)
        if len(at) >= _LEAST:
            for share in _OWN:
                by = yield from _registered(evidence, data, name, at, share)
                if by is not None:
                    values = tuple(np.round(by, 9).tolist())  # a nanometre
                    out.append(Posed(values, values, values, object=name))
    return out


def _registered(
    evidence: Evidence, data: Data, name: str, at: Places, share: float
) -> Work[Floats | None]:
    """Return the move of an object with which n pixels, by flat index, show it, (3,) metres."""
    scene = evidence.case.scene
    rows, columns = np.divmod(at, evidence.unexplained.shape[1])
    film, values = data.at((rows, columns)).film, data.values[rows, columns, 0]
    own, by = only(scene, instances_named(scene, name)), np.zeros(3)
    for _ in range(_ROUNDS):
        other = MOVED[0].of(own, name, tuple(by))
        hits = yield from evidence.trace(other, (rows, columns))
        step = _step(other, film, hits, values, data, share)
        if step is None:
            return None
        by += step
        if np.abs(step).max() <= _DONE * np.median(np.abs(values)):
            break
    return by if by.any() else None


def _step(
    scene: Scene, film: Floats, hits: Hits, values: Floats, data: Data, share: float
) -> Floats | None:
    """Return the move that takes the surfaces nearest to the points, (3,); None if too few hit."""
    hit = np.flatnonzero(hits.instance >= 0)
    if len(hit) < _LEAST:
        return None
    seen = Seen.of(scene, film[hit], hits.take(hit))
    t = values[hit] / (ray_length(seen) if data.kind.name == "distance" else 1.0)
    away = seen.along(t - seen.t).positions - seen.positions
    left = (seen.normals * away).sum(axis=1)
    near = np.abs(left) <= np.quantile(np.abs(left), share)
    found = np.linalg.lstsq(seen.normals[near], left[near], rcond=None)[0]
    return np.asarray(found) if np.isfinite(found).all() else None

"""Decides rays that are not a camera's: with every triangle, or pair by pair.

They share nothing that could say which triangles they come near: where there are many, a tree of
boxes does (`triangle_tree.py`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Bools, Floats, Index, parts
from ..certainty import Certainty
from ..scene import Scene
from ..tracer.camera import Rays
from ..tracer.hits import Hits, Statistics
from ..tracer.nearest import every_pair
from ..tracer.progress import Progress, Work, result_of
from ..tracer.settings import Settings
from ..tracer.vector import occurring
from .arithmetic import sound, sound_steps
from .bounds import FromPoint
from .exact import IntegerBatch
from .ladder import Ladder, in_range, sides
from .surfaces import SURE, Surfaces
from .triangle_tree import TriangleTree

_FEW = 1 << 20  # pairs that are tested faster than a tree is made
_RAYS = 1 << 14  # that go down the tree together


def trace_rays(scene: Scene, rays: Rays, settings: Settings, statistics: Statistics) -> Work[Hits]:
    """Find the nearest hits of n rays with t in the camera's clip range, with proof, in steps."""
    clip = scene.camera.clip_start, scene.camera.clip_end
    culled = rays.count * scene.triangle_count > _FEW
    return (yield from nearest_hits(scene, rays, clip, statistics, culled))


@sound_steps
def nearest_hits(
    scene: Scene,
    rays: Rays,
    clip: tuple[float, float],
    statistics: Statistics,
    culled: bool = True,
) -> Work[Hits]:
    """Find the nearest hits of n rays with start <= t <= end, with proof, in steps.

    Parameters
    ----------
    scene : Scene
        Its camera has no effect.
    rays : Rays
        Finite, float64.
    clip : (start, end) float
        As of a `Ladder`.
    statistics : Statistics
        To count in.
    culled : bool
        Whether a tree of boxes proposes the pairs; else each ray is tested with each triangle.
        What is seen, t and ties are the same. Where the tree drops a pair that only integers
        could decide, the certainty is another, and barycentrics are within `measures.WITHIN`.
    """
    surfaces = Surfaces.planes_of(scene)
    if not culled:
        ladder = Ladder(rays, surfaces, clip)
        for pairs in every_pair(scene, rays, statistics):
            ladder.test(pairs)
            yield None
        return (yield from ladder.hits(statistics))
    tree = TriangleTree.of(scene)
    return (yield from hits_through(tree, rays, surfaces, clip, statistics))


def hits_through(
    tree: TriangleTree,
    rays: Rays,
    surfaces: Surfaces,
    clip: tuple[float, float],
    statistics: Statistics,
    last: Floats | float = np.inf,
) -> Work[Hits]:
    """Find the nearest hits as :func:`nearest_hits`, of surfaces and what is in a tree.

    What is in the tree is missed, perhaps, if t is larger than `last` (n,).
    """
    ends = np.broadcast_to(np.minimum(clip[1], last), rays.count)
    found = []
    for some in parts(rays.count, _RAYS):
        yield Progress(some.start / rays.count)
        own = rays.take(np.arange(some.start, some.stop))
        ladder = Ladder(own, surfaces, clip)
        for pairs in tree.pairs(own, clip[0], ends[some]):
            statistics.pairs_tested += len(pairs.pixel)
            ladder.test(pairs)
        found.append(result_of(ladder.hits(statistics)))
    return Hits.joined(found) if found else Hits.none(0, Certainty.BOUND)


@dataclass(frozen=True, eq=False)
class Decision:
    """How n rays meet n triangles, pair by pair: (n,) bool each."""

    crossed: Bools  # by the ray, moved infinitesimally by the rule, in the clip range
    edge: Bools  # the ray as it is meets its edge or corner exactly
    along: Bools  # of what is crossed: the ray runs along its normal, D > 0
    exact: Bools  # integers decided


@sound
def decide(
    rays: Rays,
    corners: Floats,
    start: float = 0.0,
    end: float = np.inf,
    row: Index | None = None,
) -> Decision:
    """Decide n pairs of a ray and a triangle, each by itself.

    Parameters
    ----------
    rays : Rays
        n rays, finite, float64.
    corners : (3, 3, m) float64
        Corner, component, triangle; finite, in world space.
    start, end : float
        The clip range, as of a `Ladder`.
    row : (n,) int, optional
        The triangle of each pair; by default they come in the order of the rays.
    """
    every = np.arange(corners.shape[2] if row is None else len(row))
    row = every if row is None else row
    crossed, edge, along, undecided = np.zeros((4, len(every)), bool)
    with np.errstate(all="ignore"):  # what overflows is not known, and goes to integers
        prepared = FromPoint(rays.origins, np.abs(rays.directions), corners.take(row, axis=2))
        sure, possible = sides(prepared, every, rays)
        fractions = prepared.fractions(possible, rays.take(possible))
        _, _, outside, doubt = in_range(fractions, sure, start, end)
    crossed[possible] = ~outside & (doubt == SURE)
    along[possible] = fractions.denominator > 0
    undecided[possible] = ~outside & (doubt != SURE)
    rest = np.flatnonzero(undecided)
    for part in (rest[some] for some in parts(len(rest), 4096)):
        used, number = occurring(row[part], corners.shape[2])
        batch = IntegerBatch(rays.take(part), corners.take(used, axis=2), (), start, end)
        for k, pair in enumerate(part.tolist()):
            if hit := batch.hit(k, number.item(k)):
                crossed[pair], edge[pair] = hit.is_crossed(), hit.on_edge
                along[pair] = hit.denominator > 0
    return Decision(crossed, edge, along, undecided)

"""Finds all that rays meet, in order, each surface once: what the ray that the rule moves crosses.

The hits of a ray are the crossings of `certified/definition.py`. The error bound decides them, else
integers do, as `certified/ladder.py` has it. Their order is that of t, which is rounded once:
rounding keeps the order, so that integers are asked only where two rounded t are equal.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cmp_to_key
from typing import Any

import numpy as np
from reference_tracer.arrays import Bools, Bytes, Floats, Index, Places, parts, run_starts
from reference_tracer.certainty import Certainty
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.arithmetic import sound_steps
from reference_tracer.certified.decisions import Decisions
from reference_tracer.certified.exact import gap, sign_of_difference
from reference_tracer.certified.integers import cross, dot, integers
from reference_tracer.certified.ladder import Ladder
from reference_tracer.certified.surfaces import Surfaces
from reference_tracer.certified.triangle_tree import TriangleTree
from reference_tracer.scene import Scene
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.hits import Hits, Names, Statistics
from reference_tracer.tracer.progress import Progress, Work, result_of
from reference_tracer.tracer.vector import Arrays, Vectors

Clip = tuple[float, float]
RAYS = 1 << 14  # that go down the tree together


@dataclass(frozen=True, eq=False)
class Crossings(Arrays):
    """k hits of rays, by ray and then in the order of the moved ray.

    Parameters
    ----------
    ray : (k,) int
    t : (k,) float64
        Of the ray as it is, the nearest float64.
    instance, triangle : (k,) int32
        As of `Hits`.
    s : (3, k) float64
        The barycentrics.
    enters : (k,) bool
        Whether the ray runs against the surface's normal, which a mirrored instance does not turn
        over: into a closed mesh, where its faces are turned outward. False of infinite planes.
    same_t : (k,) bool
        Whether t is exactly that of the row before, of the same ray. Of several in one plane the
        lower (instance, triangle) comes first.
    certainty : (k,) uint8
        AMBIGUOUS where the ray as it is meets an edge or a corner, or another surface at this t.
    """

    ray: Index
    t: Floats
    instance: Names
    triangle: Names
    s: Vectors
    enters: Bools
    same_t: Bools
    certainty: Bytes

    def start(self, count: int) -> Places:
        """Return where the rows of each of n rays begin, and where the last ones end, (n + 1,)."""
        return np.searchsorted(self.ray, np.arange(count + 1))


@sound_steps
def all_hits(
    scene: Scene, rays: Rays, clip: Clip, tree: TriangleTree | None = None
) -> Work[Crossings]:
    """Find all hits of n finite rays with start <= t <= end, the clip range, with proof, in steps.

    `tree` is the scene's, if it is there.
    """
    tree = tree or TriangleTree.of(scene)
    surfaces = replace(Surfaces.planes_of(scene), triangles=tree.triangles)
    found = [np.zeros((4, 0), int)]
    for some in parts(rays.count, RAYS):
        yield Progress(some.start / rays.count)
        found += _crossed(rays, np.arange(some.start, some.stop), surfaces, tree, clip)
    ray, surface, enters, certainty = np.concatenate(found, axis=1)
    hits = Hits.none(len(ray))
    if len(ray):
        of_hits = rays.take(ray)
        decisions = Decisions(hits, of_hits, surfaces, clip, of_hits)
        yield from decisions.by_bound(np.arange(len(ray)), surface)
    axes = (integers(instance.world_from_object[:3, :3])[0] for instance in scene.instances)
    mirrored = [k for k, (x, y, z) in enumerate(axes) if dot(x, cross(y, z)) < 0]
    every = Crossings(
        ray,
        hits.t,
        hits.instance,
        hits.triangle,
        hits.s,
        enters != np.isin(hits.instance, mirrored),
        np.zeros(len(ray), bool),
        certainty.astype(np.uint8),
    )
    order = np.lexsort((hits.triangle, hits.instance, hits.t, ray))
    return _in_order(every.take(order), rays, surfaces, surface[order])


def _crossed(
    rays: Rays, some: Index, surfaces: Surfaces, tree: TriangleTree, clip: Clip
) -> Iterator[Index]:
    """Yield what some rays cross, (4, k): ray, surface, if it is met from outside, certainty."""
    own = rays.take(some)
    for number, plane in enumerate(surfaces.planes):
        hits = result_of(Ladder(own, Surfaces([plane]), clip).hits(Statistics()))
        met = np.flatnonzero(hits.instance == 0)
        yield np.stack(np.broadcast_arrays(some[met], number, 0, hits.certainty[met]))
    for pairs in tree.pairs(own, *clip):
        how = decide(own.take(pairs.pixel), pairs.corners, *clip)
        certainty = Certainty.BOUND + how.exact + how.edge  # an edge is decided in integers
        surface = len(surfaces.planes) + pairs.row
        yield np.stack((some[pairs.pixel], surface, ~how.along, certainty))[:, how.crossed]


def _in_order(hits: Crossings, rays: Rays, surfaces: Surfaces, surface: Index) -> Crossings:
    """Return hits that are sorted by ray, t and name, those of one t in the moved ray's order."""
    follows = np.ones(len(hits), bool)
    follows[run_starts(hits.ray, hits.t + 0.0)] = False  # -0 is 0
    some = np.flatnonzero(follows | np.append(follows[1:], False))
    batch, *pairs = surfaces.integers(rays, hits.ray[some], surface[some])
    hit_of = map(batch.hit, *(v.tolist() for v in pairs))
    met: dict[Any, Any] = dict(zip(some.tolist(), hit_of, strict=True))
    ray = hits.ray.tolist()
    rank = cmp_to_key(lambda a, b: ray[a] - ray[b] or sign_of_difference(met[a], met[b]))
    order = np.arange(len(hits))
    order[some] = sorted(met, key=rank)  # which is stable: else by name
    hits = hits.take(order)
    for k in np.flatnonzero(follows).tolist():
        if gap(met[order[k - 1]], met[order[k]]) == 0:
            hits.same_t[k] = True
            hits.certainty[k - 1 : k + 1] = Certainty.AMBIGUOUS
    return hits

"""Finds all that rays meet, in order, each surface once: what the ray that the rule moves crosses.

The hits of a ray are the crossings of `certified/definition.py`. The error bound decides them, else
integers do, as `certified/ladder.py` has it. Their order is that of t, which is rounded once:
rounding keeps the order, so that integers are asked only where two rounded t are equal.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cmp_to_key
from typing import Any

import numpy as np
from reference_tracer.arrays import Bools, Bytes, Floats, Index, Places, parts, run_starts
from reference_tracer.certainty import Certainty
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.arithmetic import sound_steps
from reference_tracer.certified.exact import gap, sign_of_difference
from reference_tracer.certified.integers import cross, dot, integers
from reference_tracer.certified.ladder import Ladder
from reference_tracer.certified.measures import Prepared
from reference_tracer.certified.surfaces import Surfaces, surfaces_of
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
    found = []
    for some in parts(rays.count, RAYS) or [slice(0, 0)]:
        yield Progress(some.start / max(rays.count, 1))
        part = _crossings(scene, rays.take(np.arange(rays.count)[some]), clip, tree)
        found.append(replace(part, ray=part.ray + some.start))
    every = Crossings.joined(found)
    axes = (integers(instance.world_from_object[:3, :3])[0] for instance in scene.instances)
    mirrored = [k for k, (x, y, z) in enumerate(axes) if dot(x, cross(y, z)) < 0]
    return replace(every, enters=every.enters != np.isin(every.instance, mirrored))


def _crossings(scene: Scene, rays: Rays, clip: Clip, tree: TriangleTree) -> Crossings:
    """Return all hits of some rays; `enters` as if no instance were mirrored."""
    none = np.zeros(0, np.int32)
    found: list[Any] = [(none, none, none, none > 0, none)]
    for number, plane in enumerate(scene.planes, len(scene.instances)):
        ladder = Ladder(rays, Surfaces([(plane.point, plane.normal)], number), clip)
        hits = result_of(ladder.hits(Statistics()))
        met = np.flatnonzero(hits.instance == number)
        names = hits.instance[met], hits.triangle[met]
        found.append((met, *names, met < 0, hits.certainty[met]))
    for pairs in tree.pairs(rays, *clip):
        how = decide(rays.take(pairs.pixel), pairs.corners, *clip)
        met = np.flatnonzero(how.crossed)
        some = pairs.take(met)
        certainty = (Certainty.BOUND + how.exact + how.edge)[met]  # an edge is decided in integers
        found.append((some.pixel, some.instance, some.triangle, ~how.along[met], certainty))
    ray, instance, triangle, enters, certainty = map(np.concatenate, zip(*found, strict=True))
    of_hits = rays.take(ray)
    surfaces, surface = surfaces_of(scene, instance, triangle)
    hits = Hits.none(len(ray))
    if len(ray):
        prepared = Prepared(of_hits, surfaces)
        for _ in prepared.enter(hits, np.arange(len(ray)), surface, of_hits.take):
            pass
    out = Crossings(
        ray, hits.t, instance, triangle, hits.s, enters, enters & False, certainty.astype(np.uint8)
    )
    order = np.lexsort((triangle, instance, out.t, ray))
    return _in_order(rays, out.take(order), surfaces, surface[order])


def _in_order(rays: Rays, hits: Crossings, surfaces: Surfaces, surface: Index) -> Crossings:
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

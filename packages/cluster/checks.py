"""Whether a claim can be true: each ray must meet its owner, exactly, in front of every plane.

What is claimed enters a contest of its own, with what it is said to tie with. Who is met is then
proven as in any certified picture; what else might be nearer is not looked at. That a surface was
left out is found by tracing again alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import DTypeLike, NDArray
from reference_tracer.certainty import Certainty
from reference_tracer.certified.arithmetic import sound_steps
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.certified.ladder import Ladder
from reference_tracer.scene import Region, Scene
from reference_tracer.tracer.camera import Rays, camera_rays, corner_rays, film_positions
from reference_tracer.tracer.hits import NOTHING, Hits, Statistics
from reference_tracer.tracer.nearest import test_pairs, test_planes
from reference_tracer.tracer.progress import Work
from reference_tracer.tracer.settings import Settings
from reference_tracer.tracer.vector import parts, spread
from reference_tracer.tracer.world import Pairs, WorldTriangles, world_corners

from .claims import Claim

_PIXELS = 1 << 15  # that are checked together


def plain_hits(
    scene: Scene, region: Region, dx: float, dy: float, claim: Claim, settings: Settings
) -> Work[Hits]:
    """Return what an unproven method makes of the claimed owners, and of all planes."""
    found, dtype = [], settings.precision.dtype
    for part in parts(len(claim.certainty), _PIXELS):
        rays = _rays(scene, region, dx, dy, part, dtype)
        instance, triangle = names = claim.names[:, part]
        hits = Hits.none(names.shape[1])
        test_planes(scene, rays, hits)
        pairs = _pairs(scene, np.arange(len(hits)), instance, triangle, dtype)
        test_pairs(scene, settings, rays, pairs, hits)
        found.append(hits)
        yield 0.0
    return Hits.joined(found)


@sound_steps
def can_be(scene: Scene, region: Region, dx: float, dy: float, claim: Claim) -> Work[bool]:
    """Return whether a claim of certified owners can be true."""
    around, ties = corner_rays(scene.camera, dx, dy), claim.ties
    for part in parts(len(claim.certainty), _PIXELS):
        rays, names = _rays(scene, region, dx, dy, part), claim.names[:, part]
        ladder = Ladder.of(scene, rays, around)
        some = slice(*np.searchsorted(ties.ray, (part.start, part.stop)))
        tied, number = spread(ties.ray[some] - part.start, ties.count[some])
        row = np.repeat(ties.start[some], ties.count[some]) + number
        ray = np.append(np.arange(names.shape[1]), tied)
        every = np.hstack((names, np.stack((ties.instance, ties.triangle))[:, row]))
        ladder.test(_pairs(scene, ray, *every))
        hits = yield from ladder.hits(Statistics())
        rule = [c == Certainty.AMBIGUOUS for c in (hits.certainty, claim.certainty[part])]
        same = np.array_equal(names, (hits.instance, hits.triangle)) and np.array_equal(*rule)
        own = {k - part.start: ties[k] for k in ties.ray[some].tolist()}
        if not same or own != dict(hits.ties) or not _known(scene, rays, claim, part, hits):
            return False
    return True


def _known(scene: Scene, rays: Rays, claim: Claim, part: slice, hits: Hits) -> bool:
    """Return whether t is the one, and the barycentrics are, in floats or correctly rounded.

    Which of the two, who was beaten has decided; whoever traces again alone sees it.
    """
    some = slice(*np.searchsorted(claim.known.ray, (part.start, part.stop)))
    ray, (t, *s) = claim.known.ray[some] - part.start, claim.known.values[:, some]
    other = np.flatnonzero((np.stack(s) != hits.s[:, ray]).any(axis=0))
    at = ray[other]
    if not (np.array_equal(t, hits.t[ray]) and (hits.triangle[at] != NOTHING).all()):
        return False
    corners = world_corners(scene, hits.instance[at], hits.triangle[at])
    for k in range(len(at)):
        met = IntegerBatch(rays.take(at[k : k + 1]), corners[..., k : k + 1], (), -np.inf).hit(0, 0)
        if met is None or met.weights != tuple(np.stack(s)[:, other[k]]):
            return False
    return True


def _rays(
    scene: Scene, region: Region, dx: float, dy: float, part: slice, dtype: DTypeLike = float
) -> Rays:
    pixel = np.arange(*part.indices(region.width * region.height))
    return camera_rays(scene.camera, *film_positions(region, dx, dy, pixel), dtype)


def _pairs(
    scene: Scene, ray: NDArray, instance: NDArray, triangle: NDArray, dtype: DTypeLike = float
) -> Pairs:
    """Return pairs of rays and the triangles among these names, once each."""
    ray, instance, triangle = (v[triangle != NOTHING] for v in (ray, instance, triangle))
    key = instance.astype(np.int64) << 32 | triangle
    _, first, row = np.unique(key, return_index=True, return_inverse=True)
    pair = np.unique(ray.astype(np.int64) * len(first) + row)
    names = instance[first], triangle[first]
    triangles = WorldTriangles(world_corners(scene, *names).astype(dtype), *names)
    return Pairs(*np.divmod(pair, max(1, len(first))), triangles)

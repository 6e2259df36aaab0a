"""Says which points lie inside closed meshes, and how often these wind about them.

A ray from the point crosses a closed mesh an odd number of times if the point is inside of it. The
ray is moved by the rule, and so meets no edge and no corner: any direction has the same answer.
Integers say where a triangle holds the point itself. One without an area holds none.

Closed is a mesh whose edges can be paired, as `Closed.closed_surface_rule` (proofs/) wants it. Two
edges are the same where their ends have the same coordinates; between equal corners there is none.
If each is passed as often one way as the other, it is oriented: else no winding number is defined.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from reference_tracer.arrays import Bytes, Floats, Integers
from reference_tracer.certified.any_rays import decide
from reference_tracer.certified.arithmetic import sound_steps
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.certified.triangle_tree import TriangleTree
from reference_tracer.scene import Mesh, Scene, SceneError, finite
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.progress import Work, result_of
from reference_tracer.tracer.vector import transform_points
from reference_tracer.tracer.world import Pairs, refused

from .every import all_hits

OUTSIDE, INSIDE, ON = range(3)
# Uneven, so that few rays through a regular mesh meet its edges, and integers have less to do.
_ALONG = ((0.8291,), (0.4673,), (0.3067,))


@dataclass(frozen=True, eq=False)
class Inside:
    """Where n points lie.

    Parameters
    ----------
    place : (n,) uint8
        OUTSIDE of all meshes, INSIDE of one at least, or ON the surface of one.
    winding : (n,) int32, or None
        How often all meshes together wind about the point; of one on a surface, about those just
        beside it, where its ray goes. None where a mesh is not oriented.
    """

    place: Bytes
    winding: Integers | None


def rays_from(points: Floats) -> Rays:
    """Return a ray from each of n points, (3, n) float64: each has a direction of its own."""
    return Rays(points, np.broadcast_to(_ALONG, points.shape))


@sound_steps
def places(scene: Scene, rays: Rays) -> Work[Inside]:
    """Find where the origins of n rays lie, in steps; any directions but 0 have the same answer.

    Raises
    ------
    SceneError
        If a mesh is not closed; the message has its name, and the length of its boundary.
    """
    oriented = require_closed(scene)
    tree = TriangleTree.of(scene)
    hits = yield from all_hits(scene, rays, (0.0, np.inf), tree)
    name, times = np.unique((hits.ray, hits.instance), axis=1, return_counts=True)
    place = np.zeros(rays.count, np.uint8)
    place[name[0, times % 2 == 1]] = INSIDE
    for pairs in tree.pairs(rays, 0.0, 0.0):
        place[_held(rays, pairs)] = ON
    winding = np.bincount(hits.ray, 1 - 2 * hits.enters, rays.count).astype(np.int32)
    return Inside(place, winding if oriented else None)


def inside(scene: Scene, points: ArrayLike) -> Inside:
    """Find where points lie; see `reference_tracer.inside`."""
    given = np.atleast_2d(points)
    return result_of(places(scene, rays_from(finite(given, (len(given), 3), "points").T)))


def _held(rays: Rays, pairs: Pairs) -> list[int]:
    """Return the rays whose origin is held by a triangle of these pairs.

    A ray from it along an axis, to which the triangle is not parallel, meets that at t = 0.
    """
    decision = decide(rays.take(pairs.pixel), pairs.corners, 0.0, 0.0)
    some = pairs.take(np.flatnonzero(decision.exact))
    origins = rays.take(some.pixel).origins
    found = []
    for axis in np.eye(3):
        batch = IntegerBatch(Rays(origins, axis[:, None]), some.corners, start=-np.inf)
        hits = (batch.hit(k, k) for k in range(len(some.pixel)))
        found += [
            ray for ray, hit in zip(some.pixel, hits, strict=True) if hit and not hit.numerator
        ]
    return found


def require_closed(scene: Scene) -> bool:
    """Return whether all meshes are oriented; raise a SceneError if one is not closed."""
    edges = [open_edges(mesh) for mesh in scene.meshes]
    wrong = [f"'{scene.objects[plane.object]}' is an infinite plane" for plane in scene.planes]
    for instance in scene.instances:
        ends, _ = edges[instance.mesh]
        a, b = (transform_points(instance.world_from_object, v.T) for v in ends)
        if length := sum(map(math.dist, a.T, b.T)):
            wrong.append(f"'{scene.objects[instance.object]}' has a boundary of {length:.6g} m")
    if count := refused(scene):
        wrong.append(f"{count:,} triangles with corners that are not finite")
    if wrong:
        raise SceneError(f"only a closed mesh has an inside: {'; '.join(wrong)}")
    return all(edges[instance.mesh][1] for instance in scene.instances)


def open_edges(mesh: Mesh) -> tuple[Floats, bool]:
    """Return the ends of edges of an odd number of triangles, (2, e, 3); and if it is oriented.

    Those of no length are no edges, and take no part in the length of a boundary.
    """
    points, place = np.unique(mesh.vertices, axis=0, return_inverse=True)
    ways = place.reshape(-1)[mesh.triangles[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2)
    key = np.sort(ways, axis=1) @ (len(points), 1)
    edge, which, times = np.unique(key, return_inverse=True, return_counts=True)
    net = np.bincount(which, np.sign(np.diff(ways)[:, 0]))
    return points[np.stack(np.divmod(edge[times % 2 == 1], len(points)))], not net.any()

"""Says which points lie inside closed meshes, and how often these wind about them.

A ray from the point crosses a closed mesh an odd number of times if the point is inside of it. The
ray is moved by the rule, and so meets no edge and no corner: any direction has the same answer.
Integers say where a triangle holds the point itself. One without an area holds none.

Closed is a mesh whose edges can be paired, as `Closed.closed_surface_rule` (proofs/) wants it. Two
edges are the same where their ends are in the world; between corners in one place there is none.
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
from reference_tracer.tracer.world import refused
from reference_tracer.wording import listed

from .every import all_hits

OUTSIDE, INSIDE, ON = range(3)
# Uneven, so that few rays through a regular mesh meet its edges, and integers have less to do.
ALONG = np.array([[0.8291], [0.4673], [0.3067]])
# Parallel to no triangle: in integers, the components of a normal have less digits, some 4,200.
_ACROSS = np.array([[1], [1 << 9999], [1 << 19998]], object)


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
        near = decide(rays.take(pairs.pixel), pairs.corners, 0.0, 0.0).exact
        some = pairs.take(np.flatnonzero(near))
        lines = Rays(rays.take(some.pixel).origins, _ACROSS)
        batch = IntegerBatch(lines, some.corners, start=-np.inf)
        for k, ray in enumerate(some.pixel):
            if (hit := batch.hit(k, k)) and hit.numerator == 0:
                place[ray] = ON
    winding = np.bincount(hits.ray, 1 - 2 * hits.enters, rays.count).astype(np.int32)
    return Inside(place, winding if oriented else None)


def inside(scene: Scene, points: ArrayLike) -> Inside:
    """Find where points lie; see `reference_tracer.inside`."""
    given = np.atleast_2d(points)
    return result_of(places(scene, Rays(finite(given, (len(given), 3), "points").T, ALONG)))


def require_closed(scene: Scene) -> bool:
    """Return whether all meshes are oriented; raise a SceneError if one is not closed."""
    wrong = [f"'{scene.objects[plane.object]}' is an infinite plane" for plane in scene.planes]
    if count := refused(scene):
        wrong.append(f"{count:,} triangles with corners that are not finite")
    oriented = True
    for instance in scene.instances:
        length, is_oriented = boundary(scene.meshes[instance.mesh], instance.world_from_object)
        oriented &= is_oriented
        if length:
            wrong.append(f"'{scene.objects[instance.object]}' has a boundary of {length:.6g} m")
    if wrong:
        raise SceneError(f"only a closed mesh has an inside: {listed(wrong, 9)}")
    return oriented


def boundary(mesh: Mesh, world_from_object: Floats) -> tuple[float, bool]:
    """Return the length of the edges of an odd number of triangles, and if the mesh is oriented."""
    world = transform_points(world_from_object, mesh.vertices.T)
    points, place = np.unique(world.T, axis=0, return_inverse=True)
    ends = place.reshape(-1)[mesh.triangles[:, [0, 1, 1, 2, 2, 0]]].reshape(-1, 2)
    edge, which = np.unique(np.sort(ends) @ (len(points), 1), return_inverse=True)
    net = np.bincount(which, np.sign(np.diff(ends)[:, 0]))  # ways in order, less those against it
    odd = points[np.stack(np.divmod(edge[net % 2 == 1], len(points)))]
    return sum(map(math.dist, *odd)), not net.any()

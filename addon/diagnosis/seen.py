"""Finds what single rays see of a scene: a diagnosis asks the same few about hundreds of scenes.

Each mesh has a tree of its triangles' boxes in object space, which is kept for as long as the mesh
is: scenes that share it, and its instances, share the tree. The triangles that are left are tested
as by any unproven method. Nothing here is proven: reported faults were traced again, with proof.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import is_
from weakref import WeakKeyDictionary

import numpy as np

from ..arrays import Bools, Floats, Places, parts
from ..causes.checks.probe import SOUND
from ..certified.tree import BoxRays, Crossed, Tree
from ..scene import Mesh, Scene
from ..tracer.camera import Rays
from ..tracer.hits import Hits
from ..tracer.nearest import test_pairs, test_planes
from ..tracer.progress import Work
from ..tracer.vector import transform_points
from ..tracer.world import Pairs, WorldTriangles, box_corners, world_corners

RAYS = 1 << 12  # traced together
PAIRS = 1 << 22  # of a ray and an instance that are listed together, at most
TOGETHER = 1 << 15  # pairs of a ray and a triangle that are tested together, about
SLACK = 1e-9  # of the coordinates, by which boxes are larger
NEAREST = 4  # instances on a ray that are tested first; then those that may be nearer


@dataclass(eq=False)
class Trees:
    """The trees of meshes, and those of the last scene's as one."""

    of_mesh: WeakKeyDictionary[Mesh, Tree] = field(default_factory=WeakKeyDictionary)
    _last: Sequence[Mesh] = ()
    _joined: Tree = field(default_factory=lambda: Tree.joined(()))

    def trace(self, scene: Scene, rays: Rays) -> Work[Hits]:
        """Return the nearest hit of each of n rays, as :func:`..tracer.nearest.trace_rays`."""
        hits = Hits.none(rays.count)
        test_planes(scene, rays, hits)
        yield None
        if scene.instances:
            meshes, instances = self._of_meshes(scene.meshes), _instances(scene)
            together = int(np.clip(PAIRS // len(scene.instances), 64, RAYS))
            for part in parts(rays.count, together):
                some = np.arange(part.start, part.stop)
                yield from _enter(scene, rays, some, meshes, instances, hits)
        return hits

    def _of_meshes(self, meshes: Sequence[Mesh]) -> Tree:
        if not identical(self._last, meshes):
            for mesh in meshes:
                if mesh not in self.of_mesh:
                    self.of_mesh[mesh] = _tree(mesh)
            self._joined = Tree.joined([self.of_mesh[mesh] for mesh in meshes])
            self._last = meshes
        return self._joined


def identical(first: Sequence[object], second: Sequence[object]) -> bool:
    """Return whether two sequences hold the identical objects."""
    return first is second or (len(first) == len(second) and all(map(is_, first, second)))


@np.errstate(over="ignore", invalid="ignore")
def _tree(mesh: Mesh) -> Tree:
    corners = mesh.vertices.astype(np.float64)[mesh.triangles]  # (m, 3, 3)
    return _tree_of(corners.min(axis=1).T, corners.max(axis=1).T)


def _instances(scene: Scene) -> Tree:
    """Return the tree of a scene's instances by their boxes in world space."""
    corners = box_corners(scene.instance_bounds, scene.instance_matrices)
    return _tree_of(corners.min(axis=0), corners.max(axis=0))


def _tree_of(low: Floats, high: Floats) -> Tree:
    """Build the tree of m finite boxes, (3, m) each; rays in object space are rounded."""
    finite = np.flatnonzero(np.isfinite(low).all(axis=0) & np.isfinite(high).all(axis=0))
    boxes = np.concatenate((low[:, finite], high[:, finite]))
    more = SLACK * np.max(np.abs(boxes), initial=0.0)
    boxes[:3] -= more
    boxes[3:] += more
    return Tree.of(boxes, finite)


def _enter(
    scene: Scene, rays: Rays, some: Places, meshes: Tree, instances: Tree, hits: Hits
) -> Work[None]:
    """Find the nearest hits of some rays, testing the instances on each from near to far."""
    own = BoxRays.of(rays.take(some), -np.inf, np.inf)
    found = list(instances.crossed(own, np.arange(len(some)), instances.roots.repeat(len(some))))
    if not found:
        return
    ray, instance, near = Crossed.joined(found).arrays()
    near = np.ldexp(near, -own.exponent[ray])
    order = np.lexsort((near, ray))
    ray, instance, near = ray[order], instance[order], near[order]
    rank = np.arange(len(ray)) - np.searchsorted(ray, ray)
    for turn in (rank < NEAREST, rank >= NEAREST):
        now = np.flatnonzero(turn & (near <= hits.t[some[ray]]))
        yield from _test(scene, rays, some[ray[now]], instance[now], meshes, hits)


def _test(
    scene: Scene, rays: Rays, ray: Places, instance: Places, meshes: Tree, hits: Hits
) -> Work[None]:
    """Test each of p rays with one instance: with the triangles of all boxes that it crosses."""
    own = rays.take(ray)
    used, number = np.unique(instance, return_inverse=True)
    inverse, regular = _object_from_world(scene.instance_matrices[:3, :, used])
    m = inverse[:, :, number]
    o = transform_points(m, own.origins)
    d = (m[:, :3] * own.directions).sum(axis=1)
    mesh = scene.instance_meshes[instance]
    of_object = BoxRays.of(Rays(o, d), -np.inf, np.inf)
    flat = ~regular[number]  # nothing is dropped: all its triangles are tested
    of_object.steep[:, flat] = True
    of_object.still[:, flat] = False
    for pairs in meshes.crossed(of_object, np.arange(len(ray)), meshes.roots[mesh]):
        for part in parts(len(pairs), TOGETHER):
            _test_triangles(scene, rays, ray, instance, pairs.take(part), hits)
            yield None


def _test_triangles(
    scene: Scene, rays: Rays, ray: Places, instance: Places, pairs: Crossed, hits: Hits
) -> None:
    of, triangle = instance[pairs.ray].astype(np.int32), pairs.item.astype(np.int32)
    order = np.argsort(scene.instance_meshes[of], kind="stable")
    of, triangle = of[order], triangle[order]
    world = WorldTriangles(world_corners(scene, of, triangle), of, triangle)
    some = Pairs(ray[pairs.ray[order]], np.arange(len(of)), world)
    test_pairs(scene, SOUND, rays, some, hits)


def _object_from_world(matrices: Floats) -> tuple[Floats, Bools]:
    """Return the inverses of matrices (3, 4, k), and which have one, (k,)."""
    m = np.moveaxis(matrices, -1, 0)
    with np.errstate(all="ignore"):
        size = np.abs(np.linalg.det(m[:, :, :3]))
        regular = np.isfinite(m).all(axis=(1, 2)) & np.isfinite(size) & (size > 0)
        axes = np.where(regular[:, None, None], m[:, :, :3], np.eye(3))
        inverse = np.linalg.inv(axes)
        at = -(inverse * m[:, None, :, 3]).sum(axis=-1)
    return np.moveaxis(np.concatenate((inverse, at[..., None]), axis=2), 0, -1), regular

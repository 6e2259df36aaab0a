"""Leaves out clusters of triangles that no pixel sees, before any of their vertices is projected.

The clusters of some instances are sorted into depth bins, as triangles are afterwards. When it is a
bin's turn, those of its clusters that the depth buffer hides are left out, as whole instances are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Index, Integers
from ...scene import Region, Scene
from ...tracer.vector import grouped, occurring, parts
from .boxes import InstanceBoxes
from .chunks import Part
from .clusters import SIZE, Clusters
from .film import Film
from .small_triangles import SmallTriangles

_GROWTH = 4.0  # by how much each bin has more layers than the one before
_FIRST = 3.0  # layers of boxes in the first bin
_TILE = 32  # pixels
_TOGETHER = 1 << 14  # triangles at a time


@dataclass(frozen=True, eq=False)
class Clustered:
    """The k clusters of some instances on a camera's film.

    `instances` (k,) and `numbers` (k,) name them; `clusters` are those of the meshes by number.
    """

    scene: Scene
    clusters: dict[int, Clusters]
    instances: Integers
    numbers: Index
    boxes: InstanceBoxes
    small: SmallTriangles

    @classmethod
    def of(
        cls,
        scene: Scene,
        film: Film,
        region: Region,
        clusters: dict[int, Clusters],
        instances: Integers,
        density: Floats,
    ) -> Clustered:
        """Project the boxes of all clusters of instances, of these many triangles a pixel."""
        own = [clusters[k] for k in scene.instance_meshes[instances].tolist()]
        counts = np.array([len(c) for c in own])
        density = np.repeat(density, counts)
        instances = np.repeat(instances, counts)
        bounds = np.concatenate([c.bounds for c in own], axis=-1)
        matrices = scene.instance_matrices[..., instances]
        boxes = InstanceBoxes.of(film, bounds, matrices)
        sizes = np.full(len(instances), SIZE)
        with np.errstate(all="ignore"):
            area = np.minimum(boxes.area, SIZE / density)
            small = SmallTriangles(film, region, bounds, matrices, sizes, area)
        numbers = np.concatenate([np.arange(n) for n in counts])
        return cls(scene, clusters, instances, numbers, boxes, small)

    def bins(self, region: Region, limit: int) -> Iterator[Index]:
        """Yield the clusters in view, from the front to the back, `limit` triangles at a time."""
        seen = np.flatnonzero(self.boxes.in_region(region))
        if not len(seen):
            return
        low, high = self.boxes.clipped(region)
        area = self.boxes.area[seen]
        middle = (low + high)[:, seen] // (2 * _TILE)
        for own in _by_layer(self.boxes.nearest[seen], middle, area):
            depth_bin = seen[own]
            for part in parts(len(depth_bin), max(1, limit // SIZE)):
                yield depth_bin[part]

    def parts(self, some: Index) -> Iterator[Part | None]:
        """Yield the triangles of some clusters, instance by instance, and None in between."""
        dense = self.small.is_dense[some]
        for is_dense in (False, True):
            own = np.sort(some[dense == is_dense])
            starts = np.flatnonzero(np.diff(self.instances[own])) + 1
            for members in np.split(own, starts) if len(own) else ():
                yield None
                yield self._part(members, is_dense)

    def _part(self, members: Index, is_dense: bool) -> Part:
        """Return the triangles of clusters of one instance."""
        instances = self.instances[members[:1]]
        number = int(self.scene.instance_meshes[instances[0]])
        mesh = self.scene.meshes[number]
        clusters = self.clusters[number]
        if is_dense:
            own = self._triangles(clusters, members)
        else:
            own = clusters.triangles(self.numbers[members])
        used, corners = occurring(mesh.triangles.take(own, axis=0).T, len(mesh.vertices))
        return Part(mesh, instances, np.array([len(own)]), corners, used, own)

    def _triangles(self, clusters: Clusters, members: Index) -> Integers:
        """Return those triangles of clusters that may cover a pixel."""
        found = []
        for part in parts(len(members), _TOGETHER // SIZE):
            own = self.numbers[members[part]]
            places = clusters.places.take(own, axis=2).reshape(3, 3, -1)
            found.append(clusters.triangles(own, self.small.among(list(places), members)))
        return np.concatenate(found)


def _by_layer(nearest: Floats, middle: Index, area: Floats) -> list[Index]:
    """Split n clusters into bins, so that what lies in front of others comes before them.

    Clusters are sorted by nearness in each tile of the picture, where their box has its `middle`
    (2, n). The boxes of those that are nearer cover the tile so many times: this number of layers
    says which bin a cluster is in.
    """
    x, y = middle
    tile = y * (int(x.max()) + 1) + x
    order = np.lexsort((-nearest, tile))
    own = area[order]
    before = np.cumsum(own) - own
    first = np.flatnonzero(np.diff(tile[order], prepend=-1))
    before -= np.repeat(before[first], np.diff(first, append=len(tile)))
    layers = before / (_FIRST * _TILE**2)
    number = (np.log1p(layers * (_GROWTH - 1)) / np.log(_GROWTH)).astype(np.uint8)
    bins = grouped(number, int(number.max()) + 1)
    return [order[members] for members in bins if len(members)]

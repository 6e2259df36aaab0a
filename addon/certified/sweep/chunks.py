"""Splits a scene into chunks that fit into memory, and expands one of them at a time.

A chunk is several whole instances, or a part of a large one. Instances out of view have no chunk:
their bounding boxes are all that they cost.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Index, Integers, Places, groups, parts
from ...scene import Scene
from ...tracer.progress import Work
from ...tracer.vector import Vectors, gather, occurring, transform_points
from .film import Film
from .small_triangles import Part, SmallTriangles
from .vertices import Vertices

_CHUNK = 1 << 13  # vertices transformed together: their temporaries stay in a core's cache


@dataclass(frozen=True, eq=False)
class Chunk:
    """The triangles first <= k < last of one instance, or all of several (`last` is None).

    Of `dense` instances only those that may cover a pixel (`small_triangles.py`).
    """

    instances: Integers
    first: int = 0
    last: int | None = None
    dense: bool = False


@dataclass(frozen=True, eq=False)
class Names:
    """The names, instance and triangle, of a chunk's triangles.

    The triangles `starts[i]` <= k < `starts[i + 1]` are those of `instances[i]`, from its triangle
    `first` on. If `own` is given, k is the instance's triangle `own[k]`.
    """

    instances: Integers
    starts: Places
    first: int
    own: Integers | None = None

    def of(self, triangle: Index) -> tuple[Integers, Integers]:
        """Return instance and triangle of some of the chunk's triangles, (n,) each."""
        one = len(self.instances) == 1
        which = 0 if one else np.searchsorted(self.starts, triangle, side="right") - 1
        instance = np.broadcast_to(self.instances[which], triangle.shape)
        if self.own is not None:
            return instance, gather(self.own, triangle)
        own = triangle - (self.starts[which] - self.first)
        return instance, own.astype(np.int32)


class Numbering:
    """Array the surfaces of all chunks, one chunk after the other."""

    def __init__(self) -> None:
        self._names: list[Names] = []
        self._starts = np.zeros(1, np.int64)  # the number of the first surface of each

    def enter(self, names: Names) -> int:
        """Give numbers to a chunk's surfaces, and return the first."""
        start = int(self._starts[-1])
        self._names.append(names)
        self._starts = np.append(self._starts, start + names.starts[-1])
        return start

    def names_of(self, surface: Index) -> tuple[Integers, Integers]:
        """Return instance and triangle of surfaces, (n,) each."""
        if len(self._names) == 1:
            return self._names[0].of(surface)
        out = np.empty((2, len(surface)), np.int32)
        chunk = np.searchsorted(self._starts, surface, side="right") - 1
        for k in np.flatnonzero(np.bincount(chunk)).tolist():
            own = np.flatnonzero(chunk == k)
            out[0, own], out[1, own] = self._names[k].of(gather(surface, own) - self._starts[k])
        return out[0], out[1]


@dataclass(frozen=True, eq=False)
class Expanded:
    """A chunk on the film: its vertices, and the vertices `corners` (3, m) of its triangles."""

    vertices: Vertices
    corners: Integers
    names: Names


def chunks(scene: Scene, in_view: Bools, depth: Floats, limit: int, dense: Bools) -> list[Chunk]:
    """Return the chunks of the instances in view, from the front to the back.

    Parameters
    ----------
    scene : Scene
        It has n instances.
    in_view : (n,) bool
    depth : (n,) float64
        The least depth of each instance, in metres.
    limit : int
        The most triangles of a chunk.
    dense : (n,) bool
        Whether each instance is dense (`small_triangles.py`).
    """
    sizes = np.array([(len(m.triangles), len(m.vertices)) for m in scene.meshes], np.intp)
    counts, vertices = sizes.reshape(-1, 2)[scene.instance_meshes].T
    order = np.flatnonzero(in_view & (counts > 0))
    order = order[np.argsort(depth[order], kind="stable")].astype(np.int32)
    out = []
    size = np.maximum(counts, vertices // 3)  # there may be vertices that no triangle uses
    large = size[order] > limit
    for instance in order[large].tolist():
        count = int(counts[instance])
        for first in range(0, count, limit):
            out.append(Chunk(np.array([instance], np.int32), first, min(first + limit, count)))
    for is_dense in (False, True):
        rest = order[~large & (dense[order] == is_dense)]
        for start, end in groups(size[rest], limit):
            group = rest[start:end]
            group = group[np.argsort(scene.instance_meshes[group], kind="stable")]
            out.append(Chunk(group, dense=is_dense))
    nearest = [np.min(depth[chunk.instances]) for chunk in out]
    return [out[k] for k in np.argsort(nearest, kind="stable")]


def _world(scene: Scene, of: Part) -> Iterator[tuple[int, Vectors]]:
    """Yield some thousand vertices in world space at a time, after the first one's number."""
    matrices = scene.instance_matrices[:3, :, of.instances]
    vertices = of.mesh.vertices
    for part in parts(len(of.used), _CHUNK):
        copy = of.used[part] // len(vertices)
        vertex = of.used[part] - copy * len(vertices)
        own = matrices[..., copy[:1]] if copy[0] == copy[-1] else gather(matrices, copy)
        yield part.start, transform_points(own, vertices.take(vertex, axis=0).T)


def expand(scene: Scene, film: Film, chunk: Chunk, small: SmallTriangles) -> Work[Expanded]:
    """Project a chunk's vertices to the film, in small steps.

    Vertices that are not finite there make triangles that are dropped, or decided elsewhere.
    """
    found: list[Part] = []
    for part in _parts(scene, chunk, small):
        if part:
            found.append(part)
        yield None
    size = max(film.camera.width, film.camera.height)
    count = sum(len(part.used) for part in found)
    vertices = Vertices.empty(count, np.int16 if size < 1 << 14 else np.int32)
    at = 0
    for part in found:
        for first, world in _world(scene, part):
            film.enter(vertices, at + first, world)
            yield None
        part.corners[:] += at
        at += len(part.used)
    starts = np.concatenate(([0], np.cumsum(np.concatenate([part.counts for part in found]))))
    own = [part.own for part in found if part.own is not None]
    # Contiguous rows: `take` of rows that are not would copy all of them each time.
    corners = np.ascontiguousarray(np.hstack([part.corners for part in found]))
    instances = np.concatenate([part.instances for part in found])
    names = Names(instances, starts, chunk.first, np.concatenate(own) if own else None)
    return Expanded(vertices, corners, names)


def _parts(scene: Scene, chunk: Chunk, small: SmallTriangles) -> Iterator[Part | None]:
    """Yield a chunk's triangles, mesh by mesh, and None after each step in between."""
    of = scene.instance_meshes[chunk.instances]
    for members in np.split(chunk.instances, np.flatnonzero(np.diff(of)) + 1):
        mesh = scene.meshes[scene.instances[members[0]].mesh]
        if chunk.dense:
            yield from small.within(mesh, members)
            continue
        corners = mesh.triangles[chunk.first : chunk.last].T
        count = len(mesh.vertices)
        used = np.arange(len(members) * count)
        if chunk.last is not None:
            used, corners = occurring(corners, count)
        counts = np.full(len(members), corners.shape[1])
        starts = count * np.arange(len(members), dtype=np.int32)
        corners = (corners[:, None] + starts[:, None]).reshape(3, -1)
        yield Part(mesh, members, counts, corners, used)

"""The scene in chunks that are worked on together, from the front to the back.

In comes a scene; out go chunks: whole instances whose triangles fit into the memory that there is,
or a part of one that does not. What lies wholly outside the view is left out by its bounding box,
so that an instance costs no more than that; no more than one chunk is expanded at a time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...scene import Mesh, Scene
from ...tracer.progress import Steps
from ...tracer.vector import Index, Vectors, gather, grouped, groups, occurring, transform_points
from ...tracer.vector import parts as slices
from .film import Film, Vertices
from .small_triangles import SmallTriangles

_CHUNK = 1 << 13  # vertices transformed together: their temporaries stay in a core's cache


@dataclass(frozen=True, eq=False)
class Chunk:
    """Triangles first <= k < last of one instance, or all of several (`last` is None).

    Where these are `dense`, only the triangles that may cover a pixel (`small_triangles.py`).
    """

    instances: NDArray[np.int32]
    first: int = 0
    last: int | None = None
    dense: bool = False


@dataclass(frozen=True, eq=False)
class Names:
    """How the scene calls a chunk's triangles.

    Those `starts[i]` <= k < `starts[i + 1]` are `instances[i]`'s, from its triangle `first` on;
    or its triangles `own[k]`, where that is given.
    """

    instances: NDArray[np.int32]
    starts: NDArray[np.intp]
    first: int
    own: NDArray[np.int32] | None = None

    def of(self, triangle: Index) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle, as the scene counts them, of triangles of the chunk."""
        which = np.zeros(len(triangle), np.intp)
        if len(self.instances) > 1:
            which = np.searchsorted(self.starts, triangle, side="right") - 1
        if self.own is not None:
            return self.instances[which], self.own[triangle]
        own = triangle - self.starts[which] + self.first
        return self.instances[which], own.astype(np.int32)


class Numbering:
    """One number for each surface of all chunks, in the order in which the chunks come."""

    def __init__(self) -> None:
        self._names: list[Names] = []
        self._starts = np.zeros(1, np.int64)  # the number of the first surface of each

    def enter(self, names: Names) -> int:
        """Give numbers to a chunk's surfaces; returns the first."""
        start = int(self._starts[-1])
        self._names.append(names)
        self._starts = np.append(self._starts, start + names.starts[-1])
        return start

    def names_of(self, surface: Index) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle of surfaces."""
        if len(self._names) == 1:
            return self._names[0].of(surface)
        out = np.empty((2, len(surface)), np.int32)
        chunk = np.searchsorted(self._starts, surface, side="right") - 1
        chunk = grouped(chunk.astype(np.uint16), len(self._names))
        for names, own, start in zip(self._names, chunk, self._starts.tolist(), strict=False):
            if len(own):
                out[:, own] = names.of(surface[own] - start)
        return out[0], out[1]


@dataclass(frozen=True, eq=False)
class Expanded:
    """A chunk with its vertices on the film; `corners` (3, m) are those of its triangles."""

    vertices: Vertices
    corners: NDArray[np.int32]
    names: Names


def chunks(
    scene: Scene,
    in_view: NDArray[np.bool_],
    depth: NDArray[np.float64],
    limit: int,
    dense: NDArray[np.bool_],
) -> list[Chunk]:
    """Return the chunks of the instances in view, of at most `limit` triangles each.

    `in_view`, `depth`, the least of each instance, and whether it is `dense`, are (n,).
    """
    sizes = np.array([(len(m.triangles), len(m.vertices)) for m in scene.meshes], np.intp)
    counts, vertices = sizes.reshape(-1, 2)[scene.instance_meshes].T
    order = np.flatnonzero(in_view & (counts > 0))
    order = order[np.argsort(depth[order], kind="stable")].astype(np.int32)
    out = []
    size = np.maximum(counts, vertices // 3)  # there may be many that no triangle uses
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
    nearest = [depth[chunk.instances].min() for chunk in out]
    return [out[k] for k in np.argsort(nearest, kind="stable")]


@dataclass(frozen=True, eq=False)
class _Part:
    """Triangles of k instances of a mesh: `counts` (k,) of each.

    `corners` (3, m) count the vertices that are `used`, (v,): their numbers in the mesh, and that
    of its vertices more for each instance before. `own` (m,): see `Names`.
    """

    mesh: Mesh
    instances: NDArray[np.int32]
    counts: Index
    corners: Index
    used: Index
    own: Index | None = None

    def world(self, scene: Scene) -> Iterator[tuple[int, Vectors]]:
        """Yield the vertices' world positions, some thousand at a time, and the first's number."""
        matrices, count = scene.instance_matrices[:3, :, self.instances], len(self.mesh.vertices)
        for part in slices(len(self.used), _CHUNK):
            copy = self.used[part] // count
            vertex = self.used[part] - copy * count
            own = matrices[..., copy[:1]] if copy[0] == copy[-1] else gather(matrices, copy)
            yield part.start, transform_points(own, self.mesh.vertices.take(vertex, axis=0).T)


def expand(scene: Scene, film: Film, chunk: Chunk, small: SmallTriangles) -> Steps[Expanded]:
    """Return a chunk's triangles, with their vertices on the film, in small steps.

    What is not finite there is dropped, or decided elsewhere.
    """
    parts = []
    for part in _parts(scene, chunk, small):
        parts += [part] if part else []
        yield "project"
    size = max(film.camera.width, film.camera.height)
    vertices = Vertices.empty(
        sum(len(part.used) for part in parts), np.int16 if size < 1 << 14 else np.int32
    )
    at = 0
    for part in parts:
        for first, world in part.world(scene):
            film.enter(vertices, at + first, world)
            yield "project"
        part.corners[:] += at
        at += len(part.used)
    starts = np.concatenate(([0], np.cumsum(np.concatenate([part.counts for part in parts]))))
    own = np.concatenate([part.own for part in parts]) if chunk.dense else None
    # Row by row in memory: of columns that lie together, `take` would copy all for each few.
    corners = np.ascontiguousarray(np.hstack([part.corners for part in parts]))
    names = Names(np.concatenate([part.instances for part in parts]), starts, chunk.first, own)
    return Expanded(vertices, corners, names)


def _parts(scene: Scene, chunk: Chunk, small: SmallTriangles) -> Iterator[_Part | None]:
    """Yield a chunk's triangles, mesh by mesh; and None after each short step between."""
    of = scene.instance_meshes[chunk.instances]
    for members in np.split(chunk.instances, np.flatnonzero(np.diff(of)) + 1):
        mesh = scene.meshes[scene.instances[members[0]].mesh]
        if chunk.dense:
            for found in small.within(mesh, members):
                yield found and _Part(mesh, *found)
            continue
        corners, count = mesh.triangles[chunk.first : chunk.last].T, len(mesh.vertices)
        used = np.arange(len(members) * count)
        if chunk.last is not None:
            used, corners = occurring(corners, count)
        counts = np.full(len(members), corners.shape[1])
        starts = count * np.arange(len(members), dtype=np.int32)
        corners = (corners[:, None] + starts[:, None]).reshape(3, -1)
        yield _Part(mesh, members, counts, corners, used)

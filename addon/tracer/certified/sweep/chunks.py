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

from ....scene import Scene
from ...vector import Index, Vectors, grouped, groups, transform_points
from .film import Film, Vertices

_CHUNK = 1 << 13  # vertices transformed together: their temporaries stay in a core's cache


@dataclass(frozen=True, eq=False)
class Chunk:
    """Triangles first <= k < last of one instance, or all of several (`last` is None)."""

    instances: NDArray[np.int32]
    first: int = 0
    last: int | None = None


@dataclass(frozen=True, eq=False)
class Names:
    """How the scene calls a chunk's triangles.

    Those `starts[i]` <= k < `starts[i + 1]` are `instances[i]`'s, from its triangle `first` on.
    """

    instances: NDArray[np.int32]
    starts: NDArray[np.intp]
    first: int

    @property
    def count(self) -> int:
        """How many triangles the chunk has."""
        return int(self.starts[-1])

    def of(self, triangle: Index) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
        """Return instance and triangle, as the scene counts them, of triangles of the chunk."""
        which = np.zeros(len(triangle), np.intp)
        if len(self.instances) > 1:
            which = np.searchsorted(self.starts, triangle, side="right") - 1
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
        self._starts = np.append(self._starts, start + names.count)
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
    scene: Scene, in_view: NDArray[np.bool_], depth: NDArray[np.float64], limit: int
) -> list[Chunk]:
    """Return the chunks of the instances in view, of at most `limit` triangles each.

    `in_view` and `depth`, the least of each instance, are (n,).
    """
    counts = np.array([len(m.triangles) for m in scene.meshes], np.intp)[scene.instance_meshes]
    order = np.flatnonzero(in_view & (counts > 0))
    order = order[np.argsort(depth[order], kind="stable")].astype(np.int32)
    out = []
    large = counts[order] > limit
    for instance in order[large].tolist():
        count = int(counts[instance])
        for first in range(0, count, limit):
            out.append(Chunk(np.array([instance], np.int32), first, min(first + limit, count)))
    rest = order[~large]
    for start, end in groups(counts[rest], limit):
        group = rest[start:end]
        out.append(Chunk(group[np.argsort(scene.instance_meshes[group], kind="stable")]))
    nearest = [depth[chunk.instances].min() for chunk in out]
    return [out[k] for k in np.argsort(nearest, kind="stable")]


def expand(scene: Scene, film: Film, chunk: Chunk) -> Expanded:
    """Return a chunk's triangles, with their vertices on the film."""
    if chunk.last is not None:
        mesh = scene.meshes[scene.instances[chunk.instances[0]].mesh]
        own, corners = _used(mesh.vertices, mesh.triangles[chunk.first : chunk.last])
        parts = [(chunk.instances, own, corners)]
    else:
        of = scene.instance_meshes[chunk.instances]
        parts = []
        for members in np.split(chunk.instances, np.flatnonzero(np.diff(of)) + 1):
            mesh = scene.meshes[scene.instances[members[0]].mesh]
            parts.append((members, mesh.vertices, mesh.triangles))
    total = sum(len(members) * len(v) for members, v, _ in parts)
    size = max(film.camera.width, film.camera.height)
    vertices = Vertices.empty(total, np.int16 if size < 1 << 14 else np.int32)
    corners = np.empty((3, sum(len(m) * len(t) for m, _, t in parts)), np.int32)
    counts, at, triangle = [], 0, 0
    with np.errstate(all="ignore"):  # what is not finite is dropped, or decided elsewhere
        for members, own, triangles in parts:
            matrices = scene.instance_matrices[..., members]
            for first, world in _world(matrices, own):
                film.enter(vertices, at + first, world)
            copies = corners[:, triangle : triangle + len(members) * len(triangles)]
            offsets = at + len(own) * np.arange(len(members), dtype=np.int32)
            copies.reshape(3, len(members), len(triangles))[:] = (
                triangles.T[:, None] + offsets[:, None]
            )
            counts += [len(triangles)] * len(members)
            at, triangle = at + len(members) * len(own), triangle + copies.shape[1]
    starts = np.concatenate(([0], np.cumsum(counts)))
    return Expanded(vertices, corners, Names(chunk.instances, starts, chunk.first))


def _used(vertices: NDArray, triangles: Index) -> tuple[NDArray, Index]:
    """Return those vertices that some triangles may use, and the triangles that count from them."""
    low, high = int(triangles.min()), int(triangles.max())
    if high - low < 3 * len(triangles):
        return vertices[low : high + 1], triangles - low
    used, number = np.unique(triangles, return_inverse=True)
    return vertices[used], number.reshape(triangles.shape)


def _world(matrices: NDArray[np.float64], vertices: NDArray) -> Iterator[tuple[int, Vectors]]:
    """Yield the world positions of vertices (v, 3) in each of k instances, one after the other.

    With the number of the first of them; some thousand at a time.
    """
    count, copies = len(vertices), matrices.shape[2]
    together = max(1, _CHUNK // max(count, 1))
    for copy in range(0, copies, together):
        some = matrices[..., copy : copy + together, None]
        for first in range(0, count, _CHUNK):
            local = vertices[first : first + _CHUNK].T.astype(np.float64)
            world = transform_points(some, local[:, None, :])
            yield copy * count + first, world.reshape(3, -1)

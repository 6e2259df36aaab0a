"""The contents of a mesh file: placed meshes, and notes on the file."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from reference_tracer.arrays import Floats, Index
from reference_tracer.manifest import Unmodelled
from reference_tracer.scene import Mesh

from .cut import cut


class Placed(NamedTuple):
    """A mesh at a place; several may share one mesh."""

    mesh: Mesh
    world_from_object: Floats  # (4, 4) float64
    object: str  # the name of the object whose mesh it is


@dataclass(frozen=True, eq=False)
class Contents:
    """The meshes of a file, in the file's own axes until they are turned to have Z up."""

    placed: tuple[Placed, ...]
    # What the file holds and the meshes do not show, or show in one of several ways: a sentence
    # each, with what it changes.
    notes: tuple[str, ...] = ()
    # What of the file's surfaces is not traced, in the same words: it may change the picture, and
    # nobody knows where, so a comparison cannot agree.
    missing: tuple[str, ...] = ()
    unmodelled: tuple[Unmodelled, ...] = ()  # what Blender has of the file, and the tracer lacks


def of_faces(
    vertices: Floats,
    corners: Index,
    sizes: Index,
    objects: Iterable[tuple[str, int]],
    notes: Iterable[str] = (),
    missing: Iterable[str] = (),
) -> Contents:
    """Return a mesh for each object that has triangles, once its faces are cut into triangles.

    Parameters
    ----------
    vertices : (v, 3) float32 or float64
    corners : (c,) int
        The indices of vertices of all faces, one face after the other.
    sizes : (f,) int
        The number of corners of each face.
    objects : (o,) of str and int
        The name of an object, and how many faces are its own: of the first faces, of the next ones,
        and so on. Those of one name are one object.
    notes, missing : (n,) str
        As of `Contents`.

    Raises
    ------
    ValueError
        If an index is out of range, or a face cannot be cut.
    """
    wrong = np.flatnonzero((corners < 0) | (corners >= len(vertices)))
    if len(wrong):
        face = np.searchsorted(np.cumsum(sizes), wrong[0], "right") + 1
        raise ValueError(
            f"face {face} names vertex {corners[wrong[0]]} of {len(vertices)}, counted from 0"
        )
    parts = cut(vertices, corners, sizes)
    names, counts = zip(*objects, strict=True)
    numbers = {name: number for number, name in enumerate(dict.fromkeys(names))}
    owners = np.repeat([numbers[name] for name in names], counts)[parts.faces]
    placed = tuple(_placed(vertices, parts.triangles, owners, numbers))
    return Contents(placed, (*notes, *parts.notes), (*missing, *parts.missing))


def _placed(
    vertices: Floats, triangles: Index, owners: Index, names: Collection[str]
) -> Iterator[Placed]:
    """Yield each object's mesh, in time that does not depend on how many objects there are."""
    order = np.argsort(owners, kind="stable")
    ends = np.cumsum(np.bincount(owners, minlength=len(names)))
    for name, own in zip(names, np.split(triangles[order], ends[:-1]), strict=True):
        if not len(own):
            continue
        if own.size < len(vertices):  # in its own size alone, as there may be many objects
            used, index = np.unique(own, return_inverse=True)
        else:
            used = np.zeros(len(vertices), bool)
            used[own] = True
            index = (np.cumsum(used) - 1)[own]
        yield Placed(
            Mesh(vertices[used], index.reshape(-1, 3).astype(np.int32), name=name), np.eye(4), name
        )

"""Places a file's nodes: the tree, each node's matrix, what is hidden, and instances of a mesh.

Source: Khronos, glTF 2.0 specification, 3.5; EXT_mesh_gpu_instancing; KHR_node_visibility.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from ...scene import SceneError
from .accessors import Accessors, check_fits
from .document import Document, Thing
from .extensions import INSTANCING, VISIBILITY
from .notes import Notes

# How far the fourth row of a matrix may be from 0 0 0 1, which float32 rounds where a writer has
# inverted or multiplied matrices. It is taken to be 0 0 0 1.
_ROUNDING = 1e-5
# How far a quaternion's length may be from 1 without a word: that of signed bytes, half of 1/127
# in each of four components.
_QUANTISED = 1 / 127
_AN_INSTANCE = 1000  # bytes that an instance's matrix and records take at most


@dataclass(frozen=True, eq=False)
class Tree:
    """All nodes of a file, by their numbers, in world space."""

    nodes: tuple[Thing, ...]
    worlds: Floats  # (n, 4, 4) world_from_node
    hidden: frozenset[int]  # by themselves or by a parent
    order: tuple[int, ...]  # each node after its parent
    parents: dict[int, int]

    def below(self, roots: list[int]) -> Iterator[int]:
        """Yield nodes that are roots or descend from one, parents first."""
        found = set(roots)
        for number in self.order:
            if number in found or self.parents.get(number) in found:
                found.add(number)
                yield number


def read_tree(document: Document, notes: Notes) -> Tree:
    """Return a file's nodes, placed.

    Raises
    ------
    SceneError
        If nodes stand in a circle, a node has two parents, or is placed nowhere.
    """
    nodes = tuple(document.every("nodes"))
    children = [node.refers_all("children") for node in nodes]
    parents = _parents(document, nodes, children)
    order = [k for k in range(len(nodes)) if k not in parents]
    for number in order:  # it grows while it is read
        order += children[number]
    if len(order) < len(nodes):
        circle = min(set(range(len(nodes))) - set(order))
        raise SceneError(f"{nodes[circle].label} descends from itself: its children form a circle")
    worlds, hidden = np.empty((len(nodes), 4, 4)), set()
    for number in order:
        node, parent = nodes[number], parents.get(number)
        local = _local(node, notes)
        worlds[number] = local if parent is None else product(worlds[parent], local)
        visibility = node.extension(VISIBILITY)
        shown = visibility is None or visibility.flag("visible", True)
        if not shown or parent in hidden:
            hidden.add(number)
    if not np.isfinite(worlds).all():
        lost = int(np.flatnonzero(~np.isfinite(worlds).all(axis=(1, 2)))[0])
        raise SceneError(f"{nodes[lost].label} is placed or scaled beyond the range of numbers")
    return Tree(nodes, worlds, frozenset(hidden), tuple(order), parents)


def _parents(
    document: Document, nodes: tuple[Thing, ...], children: list[list[int]]
) -> dict[int, int]:
    """Return the parent of each node that has one."""
    parents: dict[int, int] = {}
    for number, below in enumerate(children):
        for child in below:
            document.thing("nodes", child, nodes[number].label)
            if child in parents:
                both = f"{nodes[parents[child]].label} and {nodes[number].label}"
                raise SceneError(f"{nodes[child].label} is a child of both {both}: it may have one")
            parents[child] = number
    return parents


def product(first: Floats, second: Floats) -> Floats:
    """Return the product of matrices, (..., 4, 4), by operations that round the same everywhere.

    The matrix product of numpy rounds as the machine's library does.
    """
    terms = [first[..., :, k, None] * second[..., None, k, :] for k in range(4)]
    return ((terms[0] + terms[1]) + terms[2]) + terms[3]


def affine(columns: Floats, what: str) -> Floats:
    """Return matrices that are stored column by column, (..., 16), as (..., 4, 4) float64.

    Raises
    ------
    SceneError
        If the fourth row is not 0 0 0 1: such a matrix projects, which no node may do.
    """
    matrix: Floats = np.swapaxes(columns.reshape(*columns.shape[:-1], 4, 4), -1, -2)
    matrix = matrix.astype(np.float64)
    if (np.abs(matrix[..., 3, :] - (0, 0, 0, 1)) > _ROUNDING).any():
        raise SceneError(f"{what} has a matrix whose fourth row is not 0 0 0 1")
    matrix[..., 3, :] = 0, 0, 0, 1
    return matrix


def composed(translation: Floats, rotation: Floats, scale: Floats) -> Floats:
    """Return T · R · S of vectors and unit quaternions (x, y, z, w), (..., 4, 4)."""
    x, y, z, w = np.moveaxis(rotation, -1, 0)
    out = np.zeros((*x.shape, 4, 4))
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    for i, row in enumerate(rows):
        for j, term in enumerate(row):
            out[..., i, j] = term * scale[..., j]
        out[..., i, 3] = translation[..., i]
    out[..., 3, 3] = 1
    return out


def _unit(rotation: Floats, what: str, notes: Notes) -> Floats:
    """Return quaternions of length 1, (..., 4): only these are rotations."""
    rotation = rotation.astype(np.float64)
    x, y, z, w = np.moveaxis(rotation, -1, 0)
    length = np.sqrt(x * x + y * y + z * z + w * w)
    if not (length > 0).all() or not np.isfinite(length).all():
        raise SceneError(f"{what} has a rotation of length 0: a rotation has length 1")
    if (np.abs(length - 1) > _QUANTISED).any():
        notes.add("Rotations are not of length 1, as they must be; they are made so", what)
    return rotation / length[..., None]


def _local(node: Thing, notes: Notes) -> Floats:
    """Return parent_from_node, (4, 4)."""
    matrix = node.numbers("matrix", 16)
    if matrix is not None:
        if not {"translation", "rotation", "scale"}.isdisjoint(node.content):
            notes.add(
                "Nodes have a matrix, and parts of one beside it, which are not used", node.label
            )
        return affine(matrix, node.label)
    translation, rotation, scale = (
        node.numbers(key, count)
        for key, count in (("translation", 3), ("rotation", 4), ("scale", 3))
    )
    return composed(
        np.zeros(3) if translation is None else translation,
        np.array((0.0, 0, 0, 1)) if rotation is None else _unit(rotation, node.label, notes),
        np.ones(3) if scale is None else scale,
    )


def instances(tree: Tree, number: int, accessors: Accessors, notes: Notes) -> Floats:
    """Return world_from_mesh of each copy of a node's mesh, (k, 4, 4).

    Raises
    ------
    SceneError
        If the attributes of EXT_mesh_gpu_instancing do not fit one another.
    """
    node, world = tree.nodes[number], tree.worlds[number]
    extension = node.extension(INSTANCING)
    if extension is None:
        return world[None]
    attributes = extension.part("attributes")
    known = ("TRANSLATION", "VEC3"), ("ROTATION", "VEC4"), ("SCALE", "VEC3")
    found = {
        key: accessors.floats(attributes.whole(key), node.label, kind)
        for key, kind in known
        if attributes is not None and key in attributes.content
    }
    counts = {len(values) for values in found.values()}
    if len(counts) != 1:
        wrong = "differ in number" if counts else "are missing"
        raise SceneError(f"{node.label} has instances whose places {wrong}")
    (count,) = counts
    check_fits(count * _AN_INSTANCE, node.label)
    rotation = found.get("ROTATION", np.broadcast_to((0.0, 0, 0, 1), (count, 4)))
    copies = composed(
        found.get("TRANSLATION", np.zeros((count, 3))),
        _unit(rotation, node.label, notes),
        found.get("SCALE", np.ones((count, 3))),
    )
    worlds = product(world, copies)
    if not np.isfinite(worlds).all():
        raise SceneError(f"{node.label} has instances beyond the range of numbers")
    return worlds

"""Bounding volume hierarchies: which of many boxes each ray crosses.

A node holds up to `EACH` nodes, or items. What is in one lies close together: items are sorted by
the Morton code of their centres (Morton 1966; Lauterbach et al., "Fast BVH Construction on GPUs",
2009, for trees). Boxes are a little too large, rather than too small.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..arrays import Array, Floats, Places
from ..tracer.vector import spread

EACH = 8  # nodes or items in a node
BITS = 10  # of a Morton code, an axis
SLACK = 1e-9  # of the coordinates, by which a box is larger; of t, by which it is left later
TINY = 1e-300  # in place of a direction's zero: its inverse is finite
TOGETHER = 1 << 15  # pairs of a ray and a box that are tested together


@dataclass(frozen=True, eq=False)
class Nodes:
    """The nodes of some trees; the children of a node are contiguous."""

    box: Floats  # (2, 3, n) lowest and highest corner
    first: Places  # (n,) the first of the nodes in it; of an item, its number
    count: Places  # (n,) how many are in it; 0 of an item
    roots: Places  # (k,) of k trees, -1 of one without an item


class Crossed(NamedTuple):
    """Pairs of a ray and an item, where the ray crosses the item's box, (p,)."""

    ray: Places
    item: Places
    near: Floats  # where the ray enters the box, t


def tree(low: Floats, high: Floats) -> Nodes:
    """Build the tree of m items from their boxes, (3, m) each; non-finite ones are left out.

    The root is the first node, the items are the last ones.
    """
    order = np.flatnonzero(np.isfinite(low).all(axis=0) & np.isfinite(high).all(axis=0))
    if not len(order):
        none = np.zeros(0, np.intp)
        return Nodes(np.zeros((2, 3, 0)), none, none, np.array([-1]))
    order = order[np.argsort(_morton((low + high)[:, order] / 2), kind="stable")]
    more = SLACK * max(np.abs(low[:, order]).max(), np.abs(high[:, order]).max())
    levels = [np.stack((low[:, order] - more, high[:, order] + more))]
    while levels[0].shape[2] > 1:
        starts = np.arange(0, levels[0].shape[2], EACH)
        least = np.minimum.reduceat(levels[0][0], starts, axis=1)
        most = np.maximum.reduceat(levels[0][1], starts, axis=1)
        levels.insert(0, np.stack((least, most)))
    sizes = [level.shape[2] for level in levels]
    first, count = [], []
    ends = np.cumsum(sizes)
    for size, below, start in zip(sizes[:-1], sizes[1:], ends[:-1], strict=True):
        own = np.arange(0, below, EACH)
        first.append(start + own)
        count.append(np.minimum(EACH, below - own))
        assert len(own) == size
    first.append(order)
    count.append(np.zeros(len(order), np.intp))
    return Nodes(
        np.concatenate(levels, axis=2), np.concatenate(first), np.concatenate(count), np.array([0])
    )


def _morton(points: Floats) -> Array:
    """Return the Morton codes of points (3, m), within the box around them."""
    least, most = points.min(axis=1, keepdims=True), points.max(axis=1, keepdims=True)
    size = np.where(most > least, most - least, 1)
    cell = ((points - least) / size * (2**BITS - 1)).astype(np.int64)
    code = np.zeros(points.shape[1], np.int64)
    for bit in range(BITS):
        for axis in range(3):
            code |= ((cell[axis] >> bit) & 1) << (3 * bit + axis)
    return code


def together(trees: Sequence[Nodes]) -> Nodes:
    """Concatenate the nodes of some trees."""
    starts = np.append(0, np.cumsum([len(t.first) for t in trees], dtype=np.intp))
    pairs = list(zip(trees, starts[:-1], strict=True))
    return Nodes(
        np.concatenate([np.zeros((2, 3, 0)), *(t.box for t in trees)], axis=2),
        np.concatenate(
            [np.zeros(0, np.intp), *(np.where(t.count > 0, t.first + s, t.first) for t, s in pairs)]
        ),
        np.concatenate([np.zeros(0, np.intp), *(t.count for t in trees)]),
        np.array([s + r if r >= 0 else -1 for t, s in pairs for r in t.roots], np.intp),
    )


def inverted(directions: Floats) -> Floats:
    """Return 1 / d, kept finite."""
    return 1 / np.where(np.abs(directions) < TINY, TINY, directions)


@np.errstate(over="ignore", invalid="ignore")
def crossed(nodes: Nodes, node: Places, origins: Floats, inverse: Floats) -> Iterator[Crossed]:
    """Yield the items whose boxes each of k rays crosses, some at a time.

    Parameters
    ----------
    node : (k,) int
        Where each ray begins: the root of a tree.
    origins, inverse : (3, k) float64
        Of the rays: their origins, and the inverses of their directions; where the inverses are
        0, all boxes count as passed.
    """
    rays = np.flatnonzero(node >= 0)
    todo = [(rays, node[rays])]
    while todo:
        ray, node = todo.pop()
        if len(ray) > TOGETHER:
            todo += [(ray[TOGETHER:], node[TOGETHER:])]
            ray, node = ray[:TOGETHER], node[:TOGETHER]
        o, d = origins.take(ray, axis=1), inverse.take(ray, axis=1)
        low, high = ((corner.take(node, axis=1) - o) * d for corner in nodes.box)
        near = np.minimum(low, high).max(axis=0)
        far = np.maximum(low, high).min(axis=0)
        through = near <= far + SLACK * np.abs(far)
        ray, node, near = ray[through], node[through], near[through]
        count = nodes.count[node]
        item = count == 0
        if item.any():
            yield Crossed(ray[item], nodes.first[node[item]], near[item])
            ray, node, count = ray[~item], node[~item], count[~item]
        if len(ray):
            more, number = spread(np.arange(len(ray)), count)
            todo.append((ray[more], nodes.first[node[more]] + number))

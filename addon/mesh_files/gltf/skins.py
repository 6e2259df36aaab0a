"""Moves a mesh's corners with the joints of a skin, as it stands at rest.

A corner is moved by the weighted sum of its joints' matrices, each a joint's world matrix times
its inverse bind matrix. The transform of the node that shows the mesh is not used.

Source: Khronos, glTF 2.0 specification, 3.7.3 (skins).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count as numbers_from

import numpy as np

from ...arrays import Floats, Index
from ...scene import SceneError
from ...tracer.vector import transform_points
from .accessors import Accessors, check_fits
from .document import Document, Thing
from .nodes import Tree, affine, product
from .notes import Notes

_AT_ONCE = 1 << 16  # corners, whose matrices take 128 bytes each
# How far the sum of a corner's weights may be from 1, for each weight that is not 0: what the
# Khronos validator allows.
_SUM = 2e-7


@dataclass(frozen=True, eq=False)
class Skin:
    """The joints of a skin, in order."""

    label: str
    world_from_bind: Floats  # (j, 4, 4)
    notes: Notes


def read_skin(
    document: Document, number: int, asker: str, tree: Tree, accessors: Accessors, notes: Notes
) -> Skin:
    """Return a skin.

    Raises
    ------
    SceneError
        If it has no joints, or names nodes or matrices that are not there.
    """
    thing = document.thing("skins", number, asker)
    joints = thing.refers_all("joints")
    if not joints:
        raise SceneError(f"{thing.label} has no joints")
    for joint in joints:
        document.thing("nodes", joint, thing.label)
    check_fits(len(joints) * 1000, thing.label)
    matrices = tree.worlds[joints]
    inverse = thing.refers("inverseBindMatrices")
    if inverse is not None:
        columns = accessors.floats(inverse, thing.label, "MAT4")
        if len(columns) < len(joints):
            raise SceneError(
                f"{thing.label} has {len(joints)} joints, but {len(columns)} inverse bind matrices"
            )
        matrices = product(matrices, affine(columns[: len(joints)], thing.label))
    return Skin(thing.label, matrices, notes)


def skinned(
    corners: Floats, attributes: Thing, asker: str, skin: Skin, accessors: Accessors
) -> Floats:
    """Return corners in world space, (n, 3) float64.

    Raises
    ------
    SceneError
        If the primitive has no joints or weights, or names a joint that the skin does not have.
    """
    joints, weights = _influences(attributes, asker, accessors)
    if len(joints) != len(corners):
        raise SceneError(f"{asker} has {len(corners)} corners, but joints for {len(joints)}")
    joints = np.where(weights == 0, 0, joints)  # a joint without weight may be anything
    highest, count = int(np.max(joints)), len(skin.world_from_bind)
    if highest >= count:
        raise SceneError(f"{asker} names joint {highest}, and {skin.label} has {count} joints")
    _check_sums(weights, asker, skin.notes)
    check_fits(corners.size * 8, asker)
    out = np.empty(corners.shape)
    for first in range(0, len(corners), _AT_ONCE):
        some = slice(first, first + _AT_ONCE)
        matrices = np.zeros((4, 4, len(corners[some])))
        for joint, weight in zip(joints[some].T, weights[some].T, strict=True):
            matrices += weight * np.moveaxis(skin.world_from_bind[joint], 0, -1)
        out[some] = transform_points(matrices, corners[some].T).T
    return out


def _influences(attributes: Thing, asker: str, accessors: Accessors) -> tuple[Index, Floats]:
    """Return the joints of each corner and their weights, of all sets: (n, 4 k) each."""
    joints, weights = [], []
    for k in numbers_from():
        joint, weight = attributes.refers(f"JOINTS_{k}"), attributes.refers(f"WEIGHTS_{k}")
        if joint is None and weight is None:
            break
        if joint is None or weight is None:
            raise SceneError(f"{asker} has JOINTS_{k} without WEIGHTS_{k}, or the reverse")
        joints.append(accessors.whole_numbers(joint, asker, "VEC4", packed=False))
        weights.append(accessors.floats(weight, asker, "VEC4"))
    if not joints:
        raise SceneError(f"{asker} is shown with a skin, but has no JOINTS_0 and WEIGHTS_0")
    if len(set(map(len, (*joints, *weights)))) > 1:
        raise SceneError(f"{asker} has joints and weights that differ in number")
    check_fits(48 * len(joints) * len(joints[0]), asker)
    return (
        np.concatenate(joints, axis=1).astype(np.int64),
        np.concatenate(weights, axis=1).astype(np.float64),
    )


def _check_sums(weights: Floats, asker: str, notes: Notes) -> None:
    """Name what is moved by weights that no writer should give; they are used as they are."""
    sums = weights.sum(axis=1)
    off = np.abs(sums - 1) > _SUM * (weights != 0).sum(axis=1)
    if off.any() or (weights < 0).any():
        notes.add(
            "Weights of joints do not sum to 1, or are negative; they are used as they are",
            f"{asker} (sums from {np.min(sums):.7g} to {np.max(sums):.7g})",
        )

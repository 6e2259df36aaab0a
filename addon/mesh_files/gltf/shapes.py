"""Makes a file's meshes: what their primitives hold, moved by morph targets and by a skin.

Source: Khronos, glTF 2.0 specification, 3.7.2 (meshes) and 3.7.4 (instantiation).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats
from ...scene import Mesh, SceneError
from .accessors import Accessors, check_fits
from .document import Document, Thing
from .extensions import DECODED_NOT, DRACO
from .notes import Notes
from .primitives import FAN, TRIANGLES, Triangles, triangles_of
from .skins import Skin, skinned

Number = TypeVar("Number", bound=np.generic)


@dataclass(frozen=True)
class Pose:
    """How a node shows its mesh: the same pose of the same mesh is made once."""

    mesh: int
    weights: tuple[float, ...]  # of the morph targets; empty where all are zero
    skin: int | None


def pose_of(node: Thing, document: Document) -> Pose:
    """Return how a node shows its mesh.

    Raises
    ------
    SceneError
        If it names no mesh that is there, or gives weights for other targets than there are.
    """
    mesh = document.thing("meshes", node.whole("mesh"), node.label)
    counts = {len(p.items("targets")) for p in mesh.things("primitives", "primitive")}
    if len(counts) > 1:
        raise SceneError(f"{mesh.label} has primitives with different numbers of morph targets")
    count = max(counts, default=0)
    weights = node.numbers("weights")
    if weights is None:
        weights = mesh.numbers("weights")
    if weights is None or not weights.any():
        weights = np.zeros(0)
    elif len(weights) != count:
        raise SceneError(
            f"{node.label} has {len(weights)} weights for {count} morph targets of {mesh.label}"
        )
    return Pose(node.whole("mesh"), tuple(weights.tolist()), node.refers("skin"))


class Shapes:
    """Makes the meshes of one file."""

    def __init__(self, document: Document, accessors: Accessors, notes: Notes) -> None:
        self._document = document
        self._accessors = accessors
        self._notes = notes

    def mesh(self, pose: Pose, skin: Skin | None) -> Mesh:
        """Return a mesh in a pose; a skinned one in world space.

        Primitives that share their corners share them here, too.

        Raises
        ------
        SceneError
            If its accessors do not fit one another, or an index is out of range.
        """
        thing = self._document.thing("meshes", pose.mesh, "a node")
        starts: dict[str, int] = {}
        corners: list[Floats] = []
        triangles: list[Triangles] = []
        total = 0
        for primitive, attributes in self._surfaces(thing):
            key = repr((attributes.content, primitive.content.get("targets")))
            count = self._accessors.length(attributes.whole("POSITION"), primitive.label)
            if key not in starts:
                starts[key] = total
                corners.append(self._corners(primitive, attributes, pose, skin))
                total += count
            own = triangles_of(primitive, count, self._accessors)
            triangles.append(own + np.int32(starts[key]) if starts[key] else own)
        check_fits(24 * total + 12 * sum(map(len, triangles)), thing.label)
        return Mesh(
            _joined(corners, np.zeros((0, 3))),
            _joined(triangles, np.zeros((0, 3), np.int32)),
            name=thing.name or thing.label,
        )

    def _surfaces(self, mesh: Thing) -> Iterator[tuple[Thing, Thing]]:
        """Yield the primitives of triangles and their attributes; say what has none."""
        for primitive in mesh.things("primitives", "primitive"):
            mode, attributes = primitive.whole("mode", TRIANGLES), primitive.part("attributes")
            if mode > FAN:
                raise primitive.wrong("mode", f"between 0 and {FAN}")
            if attributes is None:
                raise SceneError(f"{primitive.label} has no 'attributes'")
            if mode < TRIANGLES:
                self._notes.add("Points and lines have no surface and are not traced", mesh.label)
            elif "POSITION" not in attributes.content:
                self._notes.lack("Primitives without positions are not traced", mesh.label)
            else:
                self._check_plain(primitive, attributes)
                yield primitive, attributes

    def _check_plain(self, primitive: Thing, attributes: Thing) -> None:
        """Refuse a primitive that has its data in Draco's form alone."""
        if primitive.extension(DRACO) is None:
            return
        moved = [k for k in attributes.content if k.startswith(("POSITION", "JOINTS", "WEIGHTS"))]
        needed = [primitive.refers("indices"), *map(attributes.whole, moved)]
        if any(n is not None and self._accessors.is_empty(n, primitive.label) for n in needed):
            raise SceneError(
                f"{primitive.label} is compressed by {DRACO}, which is not decoded, and has no "
                "plain data beside it: export it without compression"
            )
        self._notes.add(DECODED_NOT, DRACO)

    def _corners(
        self, primitive: Thing, attributes: Thing, pose: Pose, skin: Skin | None
    ) -> Floats:
        """Return a primitive's corners, moved by morph targets, then by the skin: (n, 3)."""
        corners = self._positions(attributes, primitive.label)
        if pose.weights:
            corners = self._morphed(primitive, corners, pose.weights)
        if skin is not None:
            corners = skinned(corners, attributes, primitive.label, skin, self._accessors)
        if not np.isfinite(corners).all():
            raise SceneError(f"{primitive.label} is moved beyond the range of numbers")
        return corners

    def _positions(self, attributes: Thing, asker: str) -> Floats:
        return self._accessors.floats(attributes.whole("POSITION"), asker, "VEC3")

    def _morphed(self, primitive: Thing, corners: Floats, weights: tuple[float, ...]) -> Floats:
        """Return corners + sum of weight · displacement, (n, 3) float64 (3.7.2.2)."""
        check_fits(corners.size * 16, primitive.label)
        out = corners.astype(np.float64)
        targets = primitive.things("targets", "morph target")
        for target, weight in zip(targets, weights, strict=True):
            if not weight or "POSITION" not in target.content:
                continue
            moved = self._positions(target, target.label)
            if moved.shape != out.shape:
                raise SceneError(f"{target.label} has {len(moved)} corners, not {len(out)}")
            out += weight * moved.astype(np.float64)
        return out


def _joined(arrays: list[NDArray[Number]], empty: NDArray[Number]) -> NDArray[Number]:
    """Return arrays below one another, a single one without a copy."""
    if len(arrays) == 1:
        return arrays[0]
    return np.concatenate(arrays) if arrays else empty

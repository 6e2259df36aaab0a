"""Faults of normals and positions: in another space, along other axes, of the other side."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from reference_tracer.arrays import Floats
from reference_tracer.diagnosis.evidence import Evidence
from reference_tracer.tracer.vector import dot

from ..kind import Data, Turn
from ..seen import Seen
from ..vectors import SPACES, normals, positions
from .turned import Turned, data_fault

BOTH = "normals", "positions"
# By space: which axes, with their signs, the file's x, y and z are.
_AXES: dict[str, dict[str, tuple[int, int, int]]] = {
    "camera": {
        "y down and z forward, as OpenCV has them": (1, -2, -3),
        "y down": (1, -2, 3),
        "z forward": (1, 2, -3),
    },
    "world": {
        "Y up, as glTF has them": (1, 3, -2),
        "y and z exchanged": (1, 3, 2),
        "y down": (1, -2, 3),
    },
}
_BGR = {"x and z exchanged, as of BGR for RGB": (3, 2, 1)}


def _coded(data: Data, change: Turn) -> Turn:
    """Return a turn of vectors as the file has them, by what is done to vectors from -1 to 1."""
    if not data.kind.encoded:
        return change
    return lambda made, seen: change(2 * made - 1, seen) / 2 + 0.5


def _right(data: Data, space: str, _: Floats, seen: Seen) -> Floats:
    """Return right vectors in a space, (n, 3), from -1 to 1 if they are normals."""
    kind = normals(space, "signed") if data.kind.name == "normals" else positions(space)
    return kind.made(seen)


def _along(data: Data, space: str, axes: tuple[int, int, int], made: Floats, seen: Seen) -> Floats:
    vectors = _right(data, space, made, seen)
    return np.stack([np.sign(a) * vectors[:, abs(a) - 1] for a in axes], axis=1)


def _other_space(evidence: Evidence, data: Data) -> Iterator[Turned]:
    for space in SPACES:
        if space != data.kind.space:
            own = _coded(data, partial(_right, data, space))
            yield Turned(words=f"{space} space, not in {data.kind.space} space", turn=own)


def _other_axes(evidence: Evidence, data: Data) -> Iterator[Turned]:
    for space in SPACES:
        for words, axes in (_AXES[space] | _BGR).items():
            own = _coded(data, partial(_along, data, space, axes))
            yield Turned(words=f"those of {space} space with {words}", turn=own)


def _range(evidence: Evidence, data: Data) -> list[Turned]:
    if data.kind.encoded:
        return [Turned(words="-1 to 1, not from 0 to 1", turn=lambda made, seen: 2 * made - 1)]
    return [Turned(words="0 to 1, not from -1 to 1", turn=lambda made, seen: made / 2 + 0.5)]


def _facing(evidence: Evidence, data: Data) -> Iterator[Turned]:
    for sign, words in ((-1, "towards the camera"), (1, "away from the camera")):

        def change(n: Floats, seen: Seen, sign: int = sign) -> Floats:
            ways = np.broadcast_to(seen.rays.directions, n.T.shape)
            turned = sign * dot(seen.normals.T, ways) < 0
            return np.where(turned[:, None], -n, n)

        yield Turned(words=words, turn=_coded(data, change))


def _object_space(made: Floats, seen: Seen) -> Floats:
    """Return normals as the objects' own vertices have them, untransformed."""
    own = (_axes(seen) * seen.normals.T[:, None]).sum(axis=0)  # M^T (M^-T n)
    return _unit(own.T)


def _as_points(made: Floats, seen: Seen) -> Floats:
    """Return normals transformed as points are, by M in place of its inverse transpose."""
    own = _object_space(made, seen).T
    return _unit((_axes(seen) * own[None]).sum(axis=1).T)


def _axes(seen: Seen) -> Floats:
    """Return the axes of the object of each surface, (3, 3, n); a plane has the world's."""
    of_planes = np.repeat(np.eye(3)[..., None], len(seen.scene.planes), axis=2)
    every = np.concatenate((seen.scene.instance_matrices[:3, :3], of_planes), axis=2)
    return every[..., seen.instance]


def _unit(vectors: Floats) -> Floats:
    length = np.sqrt((vectors * vectors).sum(axis=1, keepdims=True))
    return vectors / np.where(length > 0, length, 1)


def _untransformed(evidence: Evidence, data: Data) -> Iterator[Turned]:
    if data.kind.space == "world":
        yield Turned(words="not transformed at all", turn=_coded(data, _object_space))
        yield Turned(
            words="transformed by the object's matrix, not by its inverse transposed",
            turn=_coded(data, _as_points),
        )


VECTOR_FAULTS = (
    data_fault(
        "data_space",
        BOTH,
        "the values are in {words}",
        "Rasterisers shade in camera space; ray tracers in world space.",
        "transform them by the camera's matrix, or name their space with space= of --holds",
        _other_space,
        words="camera or world space",
        witness="hbb1/2d-gaussian-splatting#68",
    ),
    data_fault(
        "data_axes",
        BOTH,
        "the values are {words}",
        "OpenCV's cameras have y down and look along +Z, Blender's y up and along -Z. glTF's world "
        "has Y up.",
        "exchange the axes: Blender's world has Z up, its cameras look along -Z with Y up",
        _other_axes,
        words="which axes, of which space",
        witness="EasternJournalist/utils3d#7",
    ),
    data_fault(
        "normal_range",
        ("normals",),
        "the values are from {words}",
        "Pictures hold 0 to 1: n / 2 + 1/2 of a normal n, which a reader has to undo.",
        "store n / 2 + 1/2 or n as is meant, or name it with range= of --holds",
        _range,
        words="0 or from -1 to 1",
        witness="unrealcv/unrealcv#77",
    ),
    data_fault(
        "normal_facing",
        ("normals",),
        "the normals of all surfaces are turned {words}",
        "Ray tracers turn the normal of a surface that is seen from behind, before they shade it.",
        "save the normals before they are turned, or after",
        _facing,
        words="towards the camera, or away from it",
        witness="pygfx/pygfx#105",
    ),
    data_fault(
        "normal_transform",
        ("normals",),
        "the normals are {words}",
        "A normal is transformed by the inverse transposed of the object's matrix, not by the "
        "matrix.",
        "transform normals by the inverse transposed of the object's matrix, and normalise them",
        _untransformed,
        words="not transformed, or by the wrong matrix",
        witness="KhronosGroup/glTF-Sample-Viewer#60",
    ),
)

"""Writes a kit's scene as .glb: Y up, a node for each transform, unlit materials, the camera.

Axes are only exchanged and negated, so that all numbers stay as they are.
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
from reference_tracer.arrays import Array
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.frame import Y_UP_FROM_Z_UP
from reference_tracer.camera_files.gltf import GLTF, camera_of, node_of
from reference_tracer.scene import Camera

from .scenes import PALETTE, KitScene, Move, Sheared
from .shapes import Shape

_FLOAT, _UINT32 = 5126, 5125  # glTF's names of types
_VERTICES, _INDICES = 34962, 34963  # and of what buffer views hold
_JSON, _BINARY = 0x4E4F534A, 0x004E4942  # chunks


def glb(kit: KitScene) -> bytes:
    """Return the file.

    References
    ----------
    .. [1] Khronos, "glTF 2.0 Specification", 4.4, and KHR_materials_unlit.
    """
    writer = _Writer()
    for item in kit.items:
        writer.item(item.name, item.shape, item.moves, item.colors)
    writer.camera(kit.camera)
    return writer.packed()


class _Writer:
    """A file in the making."""

    def __init__(self) -> None:
        self._binary = b""
        self._meshes: dict[tuple[Shape, tuple[int, ...]], int] = {}
        self._positions: dict[Shape, int] = {}
        self._materials: dict[int, int] = {}
        self._roots: list[int] = []
        self._document: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "Reference Tracer's conformance kit"},
            "extensionsUsed": ["KHR_materials_unlit"],
            "scene": 0,
            **{
                k: []
                for k in ("nodes", "meshes", "materials", "accessors", "bufferViews", "cameras")
            },
        }

    def item(
        self, name: str, shape: Shape, moves: tuple[Move | Sheared, ...], colors: tuple[int, ...]
    ) -> None:
        """Add an object below a node for each of its parents."""
        mesh = self._mesh(shape, colors)
        chain = [_transform(m) for m in moves] or [{}]
        child = self._add("nodes", {"name": name, "mesh": mesh} | chain[-1])
        for level, parent in enumerate(reversed(chain[:-1])):
            child = self._add(
                "nodes", {"name": f"{name}, parent {level + 1}", "children": [child]} | parent
            )
        self._roots.append(child)

    def camera(self, camera: Camera) -> None:
        """Add the camera, if glTF can say it."""
        if GLTF.lacks(camera):
            del self._document["cameras"]
            return
        view = View(camera, "Camera")
        number = self._add("cameras", camera_of(view))
        self._roots.append(self._add("nodes", node_of(view, number)))

    def packed(self) -> bytes:
        """Return the file."""
        document = self._document | {
            "scenes": [{"nodes": self._roots}],
            "buffers": [{"byteLength": len(self._binary)}],
        }
        text = json.dumps(document, separators=(",", ":")).encode()
        chunks = b"".join(
            struct.pack("<II", len(held), kind) + held
            for held, kind in (
                (_padded(text, b" "), _JSON),
                (_padded(self._binary, b"\0"), _BINARY),
            )
        )
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def _add(self, kind: str, thing: dict[str, Any]) -> int:
        self._document[kind].append(thing)
        return len(self._document[kind]) - 1

    def _mesh(self, shape: Shape, colors: tuple[int, ...]) -> int:
        if (shape, colors) not in self._meshes:
            if shape not in self._positions:
                x, y, z = shape.vertices.T
                points = np.stack((x, z, -y), axis=1)
                ends = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
                self._positions[shape] = self._accessor(points, _FLOAT, "VEC3", _VERTICES, ends)
            slots = shape.triangle_slots
            primitives = []
            for slot, color in enumerate(colors):
                some = shape.triangles[slots == slot].astype(np.uint32)
                indices = self._accessor(some.reshape(-1), _UINT32, "SCALAR", _INDICES, {})
                primitives.append(
                    {
                        "attributes": {"POSITION": self._positions[shape]},
                        "indices": indices,
                        "material": self._material(color),
                    }
                )
            mesh = {"name": shape.name, "primitives": primitives}
            self._meshes[shape, colors] = self._add("meshes", mesh)
        return self._meshes[shape, colors]

    def _material(self, color: int) -> int:
        if color not in self._materials:
            factor = [*PALETTE[color].tolist(), 1.0]
            self._materials[color] = self._add(
                "materials",
                {
                    "name": f"color{color}",
                    "doubleSided": True,
                    "pbrMetallicRoughness": {"baseColorFactor": factor, "metallicFactor": 0.0},
                    "extensions": {"KHR_materials_unlit": {}},
                },
            )
        return self._materials[color]

    def _accessor(
        self, values: Array, kind: int, shape: str, target: int, ends: dict[str, Any]
    ) -> int:
        held = np.ascontiguousarray(values).tobytes()
        where = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": len(held)}
        seen = self._add("bufferViews", where | {"target": target})
        self._binary += held
        said = {"bufferView": seen, "componentType": kind, "count": len(values), "type": shape}
        return self._add("accessors", said | ends)


def _padded(held: bytes, with_: bytes) -> bytes:
    return held + with_ * (-len(held) % 4)


def _transform(move: Move | Sheared) -> dict[str, Any]:
    """Return a node's transform, with Y up on both its sides."""
    if isinstance(move, Sheared):
        matrix = Y_UP_FROM_Z_UP @ move.matrix @ Y_UP_FROM_Z_UP.T
        return {"matrix": matrix.T.reshape(-1).tolist()}
    (x, y, z), (qx, qy, qz, qw), (sx, sy, sz) = move.at, move.turn, move.scale
    return {
        "translation": [x, z, -y],
        "rotation": [qx, qz, -qy, qw],
        "scale": [sx, sz, sy],
    }

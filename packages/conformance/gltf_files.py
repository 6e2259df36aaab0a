"""Writes a kit's scene as .glb: Y up, a node for each transform, unlit materials, the camera.

Axes are only exchanged and negated, so that all numbers stay as they are.
"""

from __future__ import annotations

import json
import struct
from functools import cache

import numpy as np
from reference_tracer.arrays import Array
from reference_tracer.camera_files.convention import View
from reference_tracer.camera_files.frame import Y_UP_FROM_Z_UP
from reference_tracer.camera_files.gltf import GLTF, camera_of, node_of
from reference_tracer.files.checked_json import Content
from reference_tracer.scene import Camera

from .scenes import PALETTE, Item, KitScene, Move, Sheared
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
        writer.item(item)
    writer.camera(kit.camera)
    return writer.packed()


class _Writer:
    """A file in the making: what several objects share is in it once."""

    def __init__(self) -> None:
        self._binary = b""
        self._roots: list[int] = []
        self._document: Content = {
            "asset": {"version": "2.0", "generator": "Reference Tracer's conformance kit"},
            "extensionsUsed": ["KHR_materials_unlit"],
            "scene": 0,
            **{
                k: []
                for k in ("nodes", "meshes", "materials", "accessors", "bufferViews", "cameras")
            },
        }
        self._mesh = cache(self._add_mesh)
        self._positions = cache(self._add_positions)
        self._material = cache(self._add_material)

    def item(self, item: Item) -> None:
        """Add an object below a node for each of its parents."""
        node: Content = {"mesh": self._mesh(item.shape, item.colors)}
        for level, transform in enumerate(map(_transform, reversed(item.moves or (None,)))):
            name = f"{item.name}, parent {level}" if level else item.name
            node = {"children": [self._add("nodes", {"name": name} | node | transform)]}
        self._roots += node["children"]

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
        chunks = _chunk(text, b" ", _JSON) + _chunk(self._binary, b"\0", _BINARY)
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def _add(self, kind: str, thing: Content) -> int:
        self._document[kind].append(thing)
        return len(self._document[kind]) - 1

    def _add_positions(self, shape: Shape) -> int:
        x, y, z = shape.vertices.T
        points = np.stack((x, z, -y), axis=1)
        ends = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
        return self._accessor(points, _FLOAT, "VEC3", _VERTICES, ends)

    def _add_mesh(self, shape: Shape, colors: tuple[int, ...]) -> int:
        positions = {"POSITION": self._positions(shape)}
        primitives = []
        for slot, color in enumerate(colors):
            some = shape.triangles[shape.triangle_slots == slot].astype(np.uint32)
            indices = self._accessor(some.reshape(-1), _UINT32, "SCALAR", _INDICES, {})
            material = self._material(color)
            primitives.append({"attributes": positions, "indices": indices, "material": material})
        return self._add("meshes", {"name": shape.name, "primitives": primitives})

    def _add_material(self, color: int) -> int:
        factor = [*PALETTE[color].tolist(), 1.0]
        return self._add(
            "materials",
            {
                "name": f"color{color}",
                "doubleSided": True,
                "pbrMetallicRoughness": {"baseColorFactor": factor, "metallicFactor": 0.0},
                "extensions": {"KHR_materials_unlit": {}},
            },
        )

    def _accessor(self, values: Array, kind: int, shape: str, target: int, ends: Content) -> int:
        held = values.tobytes()
        where = {"buffer": 0, "byteOffset": len(self._binary), "byteLength": len(held)}
        seen = self._add("bufferViews", where | {"target": target})
        self._binary += held
        said = {"bufferView": seen, "componentType": kind, "count": len(values), "type": shape}
        return self._add("accessors", said | ends)


def _chunk(held: bytes, filler: bytes, kind: int) -> bytes:
    held += filler * (-len(held) % 4)
    return struct.pack("<II", len(held), kind) + held


def _transform(move: Move | Sheared | None) -> Content:
    """Return a node's transform, with Y up on both its sides."""
    if move is None:
        return {}
    if isinstance(move, Sheared):
        matrix = Y_UP_FROM_Z_UP @ move.matrix @ Y_UP_FROM_Z_UP.T
        return {"matrix": matrix.T.reshape(-1).tolist()}
    (x, y, z), (qx, qy, qz, qw), (sx, sy, sz) = move.at, move.turn, move.scale
    return {
        "translation": [x, z, -y],
        "rotation": [qx, qz, -qy, qw],
        "scale": [sx, sz, sy],
    }

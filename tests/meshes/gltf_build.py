"""Small glTF files, made by hand from the rules of the specification, and what is read of them."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from reference_tracer.tracer.vector import transform_points
from reference_tracer_meshes.gltf import read as read_gltf

SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], np.float32)
INDICES = np.array((0, 1, 2, 0, 2, 3), np.uint16)
UNIT = [[0, 0, 0], [1, 1, 0]]  # the box of the square
CODES = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Build:
    """A file in the making; `json` may be changed freely before it is written."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.json: dict[str, Any] = {"asset": {"version": "2.0"}, "scene": 0, "scenes": []}

    def add(self, kind: str, **thing: Any) -> int:
        """Add to one of the file's lists."""
        self.json.setdefault(kind, []).append(thing)
        return len(self.json[kind]) - 1

    def view(self, content: bytes, **more: Any) -> int:
        self.data += bytes(-len(self.data) % 4)
        start = len(self.data)
        self.data += content
        sizes = {"byteOffset": start, "byteLength": len(content)}
        return self.add("bufferViews", buffer=0, **(sizes | more))

    def accessor(self, values: Any, **more: Any) -> int:
        """Add an accessor of an array, (n,) or (n, width), packed."""
        values = np.asarray(values)
        width = 1 if values.ndim == 1 else values.shape[1]
        head = {
            "bufferView": self.view(values.tobytes()),
            "componentType": CODES[values.dtype.str[1:]],
            "count": len(values),
            "type": KINDS[width],
        }
        return self.add("accessors", **(head | more))

    def mesh(self, corners: Any = SQUARE, indices: Any = INDICES, **more: Any) -> int:
        """Add a mesh of one primitive; `targets` and `mode` and so on are the primitive's."""
        primitive = {"attributes": {"POSITION": self.accessor(corners)}} | more
        if indices is not None:
            primitive["indices"] = self.accessor(indices)
        return self.add("meshes", primitives=[primitive])

    def node(self, **more: Any) -> int:
        return self.add("nodes", **more)

    def scene(self, *nodes: int) -> int:
        return self.add("scenes", nodes=list(nodes))

    def shown(self, **node: Any) -> Build:
        """Add a square, a node that shows it, and a scene of that node."""
        mesh = self.mesh()
        self.scene(self.node(mesh=mesh, **node))
        return self

    def extension(self, name: str, required: bool = False) -> None:
        for key in ("extensionsUsed", "extensionsRequired")[: 1 + required]:
            self.json.setdefault(key, []).append(name)

    def skin(self, joints: list[int], **more: Any) -> int:
        return self.add("skins", joints=joints, **more)

    def with_data_uri(self) -> str:
        """Return the text of a .gltf that needs no other file."""
        uri = "data:;base64," + base64.b64encode(self.data).decode()
        return json.dumps(self.json | {"buffers": [{"byteLength": len(self.data), "uri": uri}]})

    def write(self, path: Path) -> Path:
        """Write a .glb, or a .gltf with its .bin beside it."""
        if path.suffix == ".gltf":
            path.with_suffix(".bin").write_bytes(self.data)
            self.json["buffers"] = [{"byteLength": len(self.data), "uri": path.stem + ".bin"}]
            path.write_text(json.dumps(self.json), "utf-8")
            return path
        self.json.setdefault("buffers", [{"byteLength": len(self.data)}])
        path.write_bytes(glb(self.json, bytes(self.data)))
        return path


def skinned(weights=(1, 0, 0, 0), **skin) -> Build:
    """A square whose first joint stands at x 3, its second at y 10; its node at x 50."""
    build = Build()
    mesh = build.mesh()
    build.json["meshes"][mesh]["primitives"][0]["attributes"] |= {
        "JOINTS_0": build.accessor(np.array([(0, 1, 0, 0)] * 4, np.uint8)),
        "WEIGHTS_0": build.accessor(np.array([weights] * 4, np.float32)),
    }
    shown = build.node(mesh=mesh, skin=0, translation=[50, 0, 0])
    joints = [build.node(translation=[3, 0, 0]), build.node(translation=[0, 10, 0])]
    build.skin(joints, **skin)
    build.scene(shown, *joints)
    return build


def inverse_binds(build: Build, *moves) -> int:
    """Add an accessor of matrices that translate."""
    matrices = np.tile(np.eye(4, dtype=np.float32), (len(moves), 1, 1))
    matrices[:, 3, :3] = moves  # by columns
    return build.accessor(matrices.reshape(-1, 16))


def plain() -> Build:
    """A file of all that needs no Blender: nodes, a strip, a shared mesh, a hidden one, points."""
    build = Build()
    square = build.mesh()
    strip = build.mesh(SQUARE, np.array((0, 1, 3, 2), np.uint8), mode=5)
    child = build.node(mesh=strip, rotation=[0, 0, 0, 1], scale=[1, 2, 3], name="Child")
    hidden = {"KHR_node_visibility": {"visible": False}}
    build.node(mesh=square, extensions=hidden)
    matrix = np.eye(4).ravel().tolist()
    root = build.node(mesh=square, children=[child, 1], matrix=matrix, name="Root")
    dots = build.node(mesh=build.mesh(indices=None, mode=0), translation=[1, 2, 3])
    build.scene(root, dots, build.node(mesh=square))
    build.add("animations", name="Walk")
    build.json["buffers"] = [{"byteLength": len(build.data)}]
    return build


def rich() -> Build:
    """One file of all features: a skin, targets, instances, strips, sparse and quantised."""
    build = skinned(inverseBindMatrices=None)
    build.json["skins"][0]["inverseBindMatrices"] = inverse_binds(build, (1, 0, 0), (0, 1, 0))
    primitive = build.json["meshes"][0]["primitives"][0]
    sparse = {
        "count": 2,
        "indices": {"bufferView": build.view(bytes([1, 2])), "componentType": 5121},
        "values": {"bufferView": build.view(bytes(24))},
    }
    zeros = {"componentType": 5126, "count": 4, "type": "VEC3", "sparse": sparse}
    primitive["targets"] = [{"POSITION": build.add("accessors", **zeros)}]
    build.json["meshes"][0]["weights"] = [0.5]
    order = np.array((0, 1, 3, 2), np.uint8)
    small = build.mesh(np.int8(SQUARE * 127), order, mode=5)
    build.json["accessors"][-2]["normalized"] = True
    places = {"TRANSLATION": build.accessor(SQUARE), "SCALE": build.accessor(SQUARE + 1)}
    instanced = {"EXT_mesh_gpu_instancing": {"attributes": places}}
    child = build.node(mesh=small, rotation=[0, 0, 0, 1], extensions=instanced, name="Child")
    mesh = build.mesh(SQUARE, INDICES)
    hidden = {"KHR_node_visibility": {"visible": True}}
    matrix = np.eye(4).ravel().tolist()
    root = build.node(mesh=mesh, children=[child], matrix=matrix, extensions=hidden, weights=[])
    build.json["scenes"][0]["nodes"].append(root)
    build.extension("EXT_mesh_gpu_instancing", required=True)
    build.add("animations", name="Walk")
    build.json["buffers"] = [{"byteLength": len(build.data)}]
    return build


def glb(content: Any, binary: bytes, *further: tuple[bytes, bytes]) -> bytes:
    text = json.dumps(content).encode()
    chunks = [(b"JSON", text + b" " * (-len(text) % 4))]
    if binary:
        chunks.append((b"BIN\0", binary + bytes(-len(binary) % 4)))
    body = b"".join(struct.pack("<I", len(d)) + kind + d for kind, d in (*chunks, *further))
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def corners(placed: Any) -> np.ndarray:
    """The corners of a placed mesh's triangles, (n, 3, 3) float64, in the file's own axes."""
    moved = transform_points(placed.world_from_object, placed.mesh.vertices.T).T
    return moved[placed.mesh.triangles]


def read(path: Path) -> tuple[np.ndarray, tuple[str, ...]]:
    """All triangles of a file, (n, 3, 3), and its notes."""
    contents = read_gltf(path)
    triangles = [corners(p) for p in contents.placed]
    return np.concatenate([np.zeros((0, 3, 3)), *triangles]), contents.notes


def area(triangles: np.ndarray) -> float:
    a, b, c = np.moveaxis(triangles, 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def box(triangles: np.ndarray) -> list[list[float]]:
    """The lowest and the highest corner."""
    return [triangles.min(axis=(0, 1)).tolist(), triangles.max(axis=(0, 1)).tolist()]


def moved(x: float, y: float = 0, z: float = 0) -> list[list[float]]:
    """Return the box of the unit square, moved."""
    return [[x, y, z], [x + 1, y + 1, z]]


def sparse(build: Build, at: list, values: list, dtype: str = "u2") -> dict[str, Any]:
    """Return the sparse part of an accessor, whose data are added."""
    return {
        "count": len(at),
        "indices": {
            "bufferView": build.view(np.array(at, dtype).tobytes()),
            "componentType": CODES[dtype],
        },
        "values": {"bufferView": build.view(np.array(values, np.float32).tobytes())},
    }

"""Reads .glb and .gltf: what trimesh applies by trimesh, and any other by Blender.

The file's JSON says beforehand what it needs. trimesh decodes the positions and triangles of plain
accessors; where the nodes stand is found as for cameras. Skins, morph targets, instances, sparse
and quantised numbers, fans, and compressed data are Blender's.

Source: Khronos, glTF 2.0 specification.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path, PureWindowsPath
from typing import Any
from urllib.parse import unquote, unquote_to_bytes, urlsplit

import numpy as np
from reference_tracer.arrays import Floats, Index
from reference_tracer.camera_files.gltf_file import Tree, as_specified, item, open_gltf, read_tree
from reference_tracer.checked_json import Content
from reference_tracer.cli.opening import import_trimesh
from reference_tracer.scene import Mesh, SceneError
from reference_tracer.wording import count_of

from . import by_blender
from .contents import Contents, Placed
from .gltf_extensions import APPLIED_BY_BLENDER, COMPRESSED, INSTANCING, unknown_extensions

_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}  # bytes, by componentType
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_FLOAT, _UNSIGNED = 5126, (5121, 5123, 5125)
_TRIANGLES, _STRIP, _FAN = 4, 5, 6  # modes; below: points and lines


def read(path: Path) -> Contents:
    """Read the meshes of a file's default scene, at rest, as Khronos' specification says.

    Positions are metres, Y up, as in the file. A mesh of several nodes is one `Mesh`.

    Raises
    ------
    SceneError
        If the file is no glTF 2, is damaged, or needs what is not applied.
    MissingLibraryError
        If it needs Blender, which is not there as a module.
    """
    with as_specified():
        content, binary = open_gltf(path)
        file = _File(path, content, read_tree(content), binary)
        placed, more = file.by_trimesh() if file.is_plain() else file.by_blender()
        notes = (*file.tree.notes, *file.notes(), *more.notes)
        return Contents(tuple(placed), notes, (*file.missing(), *more.missing), more.unmodelled)


class _File:
    """A file, and what of it is shown."""

    def __init__(self, path: Path, content: Content, tree: Tree, binary: bytes) -> None:
        self.content = content
        self.tree = tree
        self.unknown = unknown_extensions(content)
        with_mesh = [k for k in tree.below(self._roots()) if "mesh" in tree.nodes[k]]
        self.shown = [k for k in with_mesh if k not in tree.hidden]
        self.names = _names(content, tree, self.shown)
        self.meshes = {
            tree.nodes[k]["mesh"]: item(content, "meshes", tree.nodes[k]["mesh"])
            for k in self.shown
        }
        self.buffers = [
            _bytes(path.parent, buffer, binary if number == 0 else b"")
            for number, buffer in enumerate(content.get("buffers", []))
        ]
        for number in range(len(content.get("accessors", []))):
            self._check_size(item(content, "accessors", number), number)

    def _roots(self) -> list[int]:
        """Return the nodes that the shown scene begins with (specification 3.5.1)."""
        if "scene" not in self.content and not self.content.get("scenes"):
            return [k for k in range(len(self.tree.nodes)) if k not in self.tree.parents]
        roots = item(self.content, "scenes", self.content.get("scene", 0)).get("nodes", [])
        for root in roots:
            item(self.content, "nodes", root)
        return list(roots)

    def _check_size(self, accessor: Content, number: int) -> None:
        """Refuse an accessor that is larger than what holds its data, before it is made."""
        size = _SIZES[accessor["componentType"]] * _WIDTHS[accessor["type"]]
        count, start = _whole(accessor, "count"), _whole(accessor, "byteOffset", 0)
        if "bufferView" not in accessor:
            held = sum(map(len, self.buffers))
            if count * size > 1000 * held:  # which only compression or zeros could fill
                raise SceneError(
                    f"accessor {number} has {count:,} rows, and the file {held:,} bytes"
                )
            return
        view = item(self.content, "bufferViews", accessor["bufferView"])
        if any(name in view.get("extensions", {}) for name in COMPRESSED):
            return
        first, length = _whole(view, "byteOffset", 0), _whole(view, "byteLength")
        held = len(self.buffers[item(self.content, "buffers", view["buffer"]) and view["buffer"]])
        stride = _whole(view, "byteStride", size)
        if not count or start + (count - 1) * stride + size > length or first + length > held:
            raise SceneError(
                f"accessor {number} has {count:,} rows, which its {length:,} of {held:,} bytes do "
                "not hold"
            )

    def primitives(self) -> Iterator[tuple[int, Content]]:
        """Yield the number of its mesh and each primitive of triangles that is shown."""
        for number, mesh in self.meshes.items():
            for primitive in mesh["primitives"]:
                if _is_surface(primitive):
                    yield number, primitive

    def is_plain(self) -> bool:
        """Return whether trimesh applies all that is shown."""
        nodes = (self.tree.nodes[k] for k in self.shown)
        if any("skin" in n or INSTANCING in n.get("extensions", {}) for n in nodes):
            return False
        if any(
            any(mesh.get("weights", [])) and mesh["primitives"][0].get("targets")
            for mesh in (*self.meshes.values(), *map(self._weighted, self.shown))
        ):
            return False
        return all(self._is_plain(primitive) for _, primitive in self.primitives())

    def _weighted(self, number: int) -> Content:
        """Return a node's mesh with the node's own weights of its morph targets."""
        node = self.tree.nodes[number]
        return self.meshes[node["mesh"]] | {"weights": node.get("weights", [])}

    def _is_plain(self, primitive: Content) -> bool:
        if primitive.get("mode", _TRIANGLES) == _FAN:
            return False
        accessors = [item(self.content, "accessors", primitive["attributes"]["POSITION"])]
        if "indices" in primitive:
            accessors.append(item(self.content, "accessors", primitive["indices"]))
            if accessors[1]["componentType"] not in _UNSIGNED or accessors[1]["type"] != "SCALAR":
                raise SceneError("its indices are no unsigned integers: export it again")
        if accessors[0]["type"] != "VEC3":
            raise SceneError("its positions are no vectors of three: export it again")
        views = [
            self.content["bufferViews"][a["bufferView"]] for a in accessors if "bufferView" in a
        ]
        compressed = any(COMPRESSED & {*_extensions(view)} for view in views)
        sparse = any("sparse" in a or "bufferView" not in a for a in accessors)
        return accessors[0]["componentType"] == _FLOAT and not (sparse or compressed)

    def by_trimesh(self) -> tuple[list[Placed], Contents]:
        """Return the meshes that are shown, of arrays that trimesh decodes."""
        import_trimesh()
        from trimesh.exchange.gltf import load_gltf

        own = [*self.primitives()]
        plain = {
            "asset": {"version": "2.0"},
            "buffers": [{"uri": str(k)} for k in range(len(self.buffers))],
            "bufferViews": self.content.get("bufferViews", []),
            "accessors": [],
            "meshes": [],
        }
        for number, (_, primitive) in enumerate(own):
            mine = {"attributes": {"POSITION": len(plain["accessors"])}}
            plain["accessors"].append(
                self.content["accessors"][primitive["attributes"]["POSITION"]]
            )
            if "indices" in primitive:
                mine["indices"] = len(plain["accessors"])
                plain["accessors"].append(self.content["accessors"][primitive["indices"]])
            mine["mode"] = primitive.get("mode", _TRIANGLES)
            plain["meshes"].append({"name": str(number), "primitives": [mine]})
        text = BytesIO(json.dumps(plain).encode())
        files = {str(k): data for k, data in enumerate(self.buffers)}
        found = load_gltf(text, files, skip_materials=True)["geometry"] if own else {}
        parts: dict[int, list[tuple[int, Floats, Index]]] = {number: [] for number in self.meshes}
        for number, (mesh, primitive) in enumerate(own):
            shape = found[str(number)]
            position = primitive["attributes"]["POSITION"]
            parts[mesh].append((position, shape["vertices"], shape["faces"]))
        meshes = {
            number: _joined(parts[number], str(mesh.get("name", "")) or f"mesh {number}")
            for number, mesh in self.meshes.items()
        }
        nodes, worlds = self.tree.nodes, self.tree.worlds
        placed = [Placed(meshes[nodes[k]["mesh"]], worlds[k], self.names[k]) for k in self.shown]
        return [p for p in placed if len(p.mesh.triangles)], Contents(())

    def by_blender(self) -> tuple[list[Placed], Contents]:
        """Return what Blender shows of the file, at rest; only what has a shape is given to it."""
        keys = "accessors", "bufferViews", "skins"
        content = {key: self.content[key] for key in keys if key in self.content}
        meshes = [
            _bare(mesh) if number in self.meshes else {"primitives": []}
            for number, mesh in enumerate(self.content.get("meshes", []))
        ]
        nodes = []
        for number, node in enumerate(self.tree.nodes):
            kept = {"children", "matrix", "translation", "rotation", "scale"}
            if number in self.shown:
                kept |= {"mesh", "skin", "weights"}
            own = {key: node[key] for key in kept & node.keys()} | {"name": str(number)}
            if "mesh" in own and INSTANCING in _extensions(node):  # whose copies are named by it
                meshes.append(meshes[own["mesh"]] | {"name": str(number)})
                own["mesh"] = len(meshes) - 1
            nodes.append(_with_extensions(own, node))
        content |= {"nodes": nodes, "meshes": meshes}
        content |= {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": self._roots()}]}
        found = by_blender.read_gltf(content, self.buffers)
        placed = []
        for part in found.placed:
            number = part.object.partition(".")[0]
            world = part.world_from_object
            back = np.stack((world[0], world[2], 0 - world[1], world[3]))  # to Y up
            placed.append(part._replace(world_from_object=back, object=self.names[int(number)]))
        return placed, replace(found, placed=())

    def notes(self) -> Iterator[str]:
        """Yield what the file has, and is not shown, or in one of several ways."""
        scenes, nodes = self.content.get("scenes", []), self.tree.nodes
        if not scenes:
            yield "The file has no scene; all its nodes are traced."
        elif "scene" not in self.content and len(scenes) > 1:
            count = f"The file has {len(scenes)} scenes"
            yield f"{count} and does not say which is shown; the first is traced."
        left = {k for k, node in enumerate(nodes) if "mesh" in node} - {*self.shown}
        hidden = left & self.tree.hidden
        for numbers, why in ((left - hidden, "outside the traced scene"), (hidden, "hidden")):
            if numbers:
                yield f"Meshes {why} are left out: {_listed([f'node {k}' for k in numbers])}."
        primitives = [p for mesh in self.meshes.values() for p in mesh["primitives"]]
        if any(p.get("mode", _TRIANGLES) < _TRIANGLES for p in primitives):
            yield "Points and lines have no surface and are not traced."
        if animations := self.content.get("animations"):
            names = [str(a.get("name") or f"animation {k}") for k, a in enumerate(animations)]
            yield f"Animations are not played; everything is traced at rest: {_listed(names)}."
        if count := len(self.content.get("cameras", [])):
            names = [
                str(n.get("name") or f"node {k}") for k, n in enumerate(nodes) if "camera" in n
            ]
            use = "--camera uses one by its node's name"
            yield f"The file has {count_of(count, 'camera')}; {use}: {_listed(names)}."
        if "KHR_lights_punctual" in self.content.get("extensions", {}):
            yield "Lights are not used: the file has some."

    def missing(self) -> Iterator[str]:
        """Yield what may be a surface, and is not traced."""
        primitives = [p for mesh in self.meshes.values() for p in mesh["primitives"]]
        if any("POSITION" not in p["attributes"] for p in primitives):
            yield "Primitives without positions are not traced."
        if self.unknown:
            what = "Extensions are not known, so what they move or add is not traced"
            yield f"{what}: {_listed(self.unknown)}."


def _listed(names: list[str]) -> str:
    """Return the first names of a list, and how many more there are."""
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _extensions(thing: Content) -> dict[str, Any]:
    out: dict[str, Any] = thing.get("extensions", {})
    return out


def _is_surface(primitive: Content) -> bool:
    mode = primitive.get("mode", _TRIANGLES)
    if mode not in range(_FAN + 1):
        raise SceneError(f"a primitive has the mode {mode!r:.40}, which must be from 0 to {_FAN}")
    return mode >= _TRIANGLES and "POSITION" in primitive["attributes"]


def _with_extensions(own: Content, thing: Content) -> Content:
    kept = {k: v for k, v in _extensions(thing).items() if k in APPLIED_BY_BLENDER}
    return own | ({"extensions": kept} if kept else {})


def _bare(mesh: Content) -> Content:
    """Return a mesh with what makes its shape alone."""
    primitives = []
    for primitive in filter(_is_surface, mesh["primitives"]):
        shape = {
            key: value
            for key, value in primitive["attributes"].items()
            if key.startswith(("POSITION", "JOINTS_", "WEIGHTS_"))
        }
        own: Content = {k: primitive[k] for k in ("indices", "mode") if k in primitive}
        own["attributes"] = shape
        if "targets" in primitive:
            own["targets"] = [
                {k: v for k, v in target.items() if k == "POSITION"}
                for target in primitive["targets"]
            ]
        primitives.append(_with_extensions(own, primitive))
    return {"primitives": primitives} | ({"weights": mesh["weights"]} if "weights" in mesh else {})


def _joined(parts: list[tuple[int, Floats, Index]], name: str) -> Mesh:
    """Return a mesh of primitives; those that share their positions share them here, too."""
    starts: dict[int, int] = {}
    vertices, triangles = [np.zeros((0, 3), np.float32)], [np.zeros((0, 3), np.int32)]
    for position, own, faces in parts:
        if not np.isfinite(own).all():
            raise SceneError(f"accessor {position} holds numbers that are not finite")
        if faces.max(initial=0) >= len(own):
            raise SceneError(f"'{name}' names corner {faces.max()} of {len(own)}")
        if position not in starts:
            starts[position] = sum(map(len, vertices))
            vertices.append(own)
        triangles.append(faces.astype(np.int32) + np.int32(starts[position]))
    return Mesh(np.concatenate(vertices), np.concatenate(triangles), name=name)


def _names(content: Content, tree: Tree, numbers: list[int]) -> dict[int, str]:
    """Return a name for the object of each node; no two have the same."""
    names: dict[int, str] = {}
    taken: set[str] = set()
    for number in numbers:
        node = tree.nodes[number]
        mesh = item(content, "meshes", node["mesh"])
        name = str(node.get("name") or mesh.get("name") or f"node {number}")
        while name in taken:
            name = f"{name} (node {number})"
        names[number] = name
        taken.add(name)
    return names


def _whole(thing: Content, key: str, default: int | None = None) -> int:
    value = thing.get(key, default)
    if type(value) is not int or value < 0:
        raise SceneError(f"a '{key}' is {value!r:.40}, which must be an integer from 0 on")
    return value


def _bytes(folder: Path, buffer: Content, own: bytes) -> bytes:
    """Return a buffer's bytes: its own chunk's, a data URI's, or a file's in the same folder.

    No file outside the folder is read, whatever the file names: no address, no absolute path, none
    that climbs out by `..` or by a link.
    """
    uri, size = buffer.get("uri"), _whole(buffer, "byteLength")
    if uri is None:
        data = own
    elif uri[:5].lower() == "data:":
        head, _, body = uri.partition(",")
        is_base64 = head.lower().endswith(";base64")
        data = base64.b64decode(unquote(body)) if is_base64 else unquote_to_bytes(body)
    else:
        data = _file(folder, uri, size)
    if len(data) < size:
        raise SceneError(f"a buffer is cut off: it has {len(data)} of {size} bytes")
    return data[:size]  # it may be padded


def _file(folder: Path, uri: str, size: int) -> bytes:
    """Return the first bytes of a file in the folder, or below it."""
    try:
        parts, named = urlsplit(uri), unquote(uri, errors="strict")
        # A drive or a server of Windows is not even asked for, nor where it means nothing.
        is_address = bool(parts.scheme or parts.netloc or PureWindowsPath(named).anchor)
        path = folder if is_address else (folder / named).resolve()
        is_inside = path.is_relative_to(folder.resolve())
        is_file = not is_address and is_inside and path.is_file()
    except (OSError, ValueError, RuntimeError):  # no name of a file; RuntimeError: links in circles
        raise SceneError(f"'{uri[:60]}' is no name of a file") from None
    if is_address or not is_inside:
        raise SceneError(
            f"'{uri[:60]}' is not in the folder of the file: copy it there, and name it by a "
            "relative path"
        )
    if not is_file:
        raise SceneError(f"the file '{uri[:60]}' is not there")
    with path.open("rb") as file:  # `read` would first take the memory that it is asked for
        return file.read(min(size, path.stat().st_size))

"""Reads .glb and .gltf: what trimesh applies by trimesh, and any other by Blender.

The file's JSON says beforehand what it needs. trimesh decodes the positions and triangles of plain
accessors; where the nodes stand is found as for cameras. Skins, morph targets, instances, sparse
and quantised numbers, fans, and compressed data are Blender's.

Source: Khronos, glTF 2.0 specification.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path, PureWindowsPath
from typing import Any
from urllib.parse import unquote
from urllib.request import urlopen

import numpy as np
from reference_tracer.arrays import Floats, Index
from reference_tracer.camera_files.gltf_file import Tree, as_specified, item, open_gltf, read_tree
from reference_tracer.cli.opening import import_trimesh
from reference_tracer.files.checked_json import Content
from reference_tracer.scene import Mesh, SceneError
from reference_tracer.wording import count_of

from . import by_blender
from .contents import Contents, Placed
from .gltf_extensions import COMPRESSED, INSTANCING, unknown_extensions
from .text import AGAIN

_FLOAT, _UNSIGNED = 5126, (5121, 5123, 5125)  # componentType
_LISTS, _STRIPS = 4, 5  # modes; below: points and lines; above: fans
# What makes no shape. Blender is not given it, and so reads no other file.
_NO_SHAPE = frozenset(
    "animations camera cameras extras images material materials samplers textures "
    "KHR_lights_punctual KHR_materials_variants KHR_node_visibility".split()
)


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
        found = file.by_trimesh() if file.is_plain() else file.by_blender()
        notes = (*file.tree.notes, *file.notes(), *found.notes)
        return replace(found, notes=notes, missing=tuple(file.missing()))


class _File:
    """A file, and what of it is shown."""

    def __init__(self, path: Path, content: Content, tree: Tree, binary: bytes) -> None:
        self.content = content
        self.tree = tree
        self.unknown = unknown_extensions(content)
        self.shown = [
            k for k in tree.below(self._roots()) if "mesh" in tree.nodes[k] and k not in tree.hidden
        ]
        self.meshes = {
            number: item(content, "meshes", number)
            for number in dict.fromkeys(tree.nodes[k]["mesh"] for k in self.shown)
        }
        self.primitives = [(k, p) for k, mesh in self.meshes.items() for p in mesh["primitives"]]
        self.names = _names(self.meshes, tree, self.shown)
        self.buffers = [
            _bytes(path.parent, buffer, binary if number == 0 else b"")
            for number, buffer in enumerate(content.get("buffers", []))
        ]
        self._check_sizes()

    def _roots(self) -> list[int]:
        """Return the nodes that the shown scene begins with (specification 3.5.1)."""
        if not self.content.get("scenes"):
            return [k for k in range(len(self.tree.nodes)) if k not in self.tree.parents]
        roots: list[int] = item(self.content, "scenes", self.content.get("scene", 0)).get(
            "nodes", []
        )
        for root in roots:
            item(self.content, "nodes", root)
        return roots

    def _check_sizes(self) -> None:
        """Refuse what is larger than the file that should hold it, before anything is made."""
        held = sum(map(len, self.buffers))
        for kind in ("bufferViews", "accessors"):
            for number, thing in enumerate(self.content.get(kind, [])):
                for key in {"byteOffset", "byteLength", "byteStride", "count"} & thing.keys():
                    size = _whole(thing, key)
                    # Only of zeros, and of compressed data, there may be more rows than bytes.
                    free = "bufferView" not in thing if kind == "accessors" else _compressed(thing)
                    if size > (1000 * held if free else held):
                        what = f"number {number} of its {kind} has the {key} {size:,}"
                        raise SceneError(f"{what}, and the file holds {held:,} bytes")

    def is_plain(self) -> bool:
        """Return whether trimesh applies all that is shown."""
        nodes = [self.tree.nodes[k] for k in self.shown]
        weighted = any(any(thing.get("weights", [])) for thing in (*nodes, *self.meshes.values()))
        if weighted and any(primitive.get("targets") for _, primitive in self.primitives):
            return False
        if any("skin" in n or INSTANCING in n.get("extensions", {}) for n in nodes):
            return False
        return all(self._is_plain(p) for _, p in self.primitives if _is_surface(p))

    def _is_plain(self, primitive: Content) -> bool:
        used = [primitive["attributes"]["POSITION"]]
        used += [primitive["indices"]] if "indices" in primitive else []
        position, *indices = (item(self.content, "accessors", number) for number in used)
        if position["type"] != "VEC3":
            raise SceneError("its positions are no vectors of three: export it again")
        if any(i["componentType"] not in _UNSIGNED or i["type"] != "SCALAR" for i in indices):
            raise SceneError("its indices are no unsigned integers: export it again")
        corners, mode = [position, *indices][-1]["count"], primitive.get("mode", _LISTS)
        if mode == _LISTS and corners % 3:
            raise SceneError(f"it has {corners} corners, which triangles take in threes: {AGAIN}")
        for accessor in (position, *indices):
            if "sparse" in accessor or "bufferView" not in accessor:
                return False
            view = item(self.content, "bufferViews", accessor["bufferView"])
            if _compressed(view):
                return False
            self._check_view(view, 12 if accessor is position else 1)
        return position["componentType"] == _FLOAT and mode <= _STRIPS

    def _check_view(self, view: Content, row: int) -> None:
        """Refuse a view that is not in its buffer, or whose rows, of so many bytes, overlap."""
        item(self.content, "buffers", view["buffer"])
        end = view.get("byteOffset", 0) + view["byteLength"]
        if end > len(self.buffers[view["buffer"]]):
            raise SceneError("one of its bufferViews ends behind its buffer: export it again")
        if view.get("byteStride", row) < row:
            raise SceneError(f"its byteStride is {view['byteStride']}: rows of {row} bytes overlap")

    def by_trimesh(self) -> Contents:
        """Return the meshes that are shown, of arrays that trimesh decodes."""
        import_trimesh()
        from trimesh.exchange.gltf import load_gltf

        own = [(number, p) for number, p in self.primitives if _is_surface(p)]
        accessors: list[Content] = []
        meshes: list[Content] = []
        for number, (_, p) in enumerate(own):
            mine: Content = {"attributes": {"POSITION": len(accessors)}}
            accessors.append(self.content["accessors"][p["attributes"]["POSITION"]])
            if "indices" in p:
                mine["indices"] = len(accessors)
                accessors.append(self.content["accessors"][p["indices"]])
            mine["mode"] = p.get("mode", _LISTS)
            meshes.append({"name": str(number), "primitives": [mine]})
        plain = {
            "buffers": [{"uri": str(k)} for k in range(len(self.buffers))],
            "bufferViews": self.content.get("bufferViews", []),
            "accessors": accessors,
            "meshes": meshes,
        }
        files = {str(k): data for k, data in enumerate(self.buffers)}
        text = BytesIO(json.dumps(plain).encode())
        found = load_gltf(text, files, skip_materials=True)["geometry"] if own else {}
        parts: dict[int, list[tuple[int, Floats, Index]]] = {number: [] for number in self.meshes}
        for number, (mesh, p) in enumerate(own):
            shape = found[str(number)]
            parts[mesh].append((p["attributes"]["POSITION"], shape["vertices"], shape["faces"]))
        joined = {
            number: _joined(parts[number], str(mesh.get("name") or f"mesh {number}"))
            for number, mesh in self.meshes.items()
        }
        nodes, worlds = self.tree.nodes, self.tree.worlds
        placed = (Placed(joined[nodes[k]["mesh"]], worlds[k], self.names[k]) for k in self.shown)
        return Contents(tuple(part for part in placed if len(part.mesh.triangles)))

    def by_blender(self) -> Contents:
        """Return what Blender shows of the file, at rest; only what has a shape is given to it."""
        content = _shapes(self.content) | {"asset": {"version": "2.0"}, "scene": 0}
        content |= {"scenes": [{"nodes": self._roots()}]}
        for number, node in enumerate(content["nodes"]):
            node["name"] = str(number)
            if "mesh" in node and number not in self.shown:
                del node["mesh"]
                node.pop("skin", None)
            elif INSTANCING in node.get("extensions", {}):  # Blender names its copies by the mesh
                content["meshes"].append(content["meshes"][node["mesh"]] | {"name": str(number)})
                node["mesh"] = len(content["meshes"]) - 1
        found = by_blender.read_gltf(content, self.buffers)
        placed = []
        for part in found.placed:
            world = part.world_from_object
            back = np.stack((world[0], world[2], 0 - world[1], world[3]))  # to Y up
            name = self.names[int(part.object.partition(".")[0])]
            placed.append(part._replace(world_from_object=back, object=name))
        return replace(found, placed=tuple(placed))

    def notes(self) -> Iterator[str]:
        """Yield what the file has, and is not shown, or in one of several ways."""
        scenes, nodes = len(self.content.get("scenes", [])), self.tree.nodes
        if not scenes:
            yield "The file has no scene; all its nodes are traced."
        elif "scene" not in self.content and scenes > 1:
            yield f"The file has {scenes} scenes and does not say which is shown: the first is."
        if left := [k for k in range(len(nodes)) if "mesh" in nodes[k] and k not in self.shown]:
            told = f"{count_of(len(left), 'node')} with a mesh, the first is node {left[0]}"
            yield f"Meshes that are hidden, or outside the traced scene, are left out: {told}."
        if any(p.get("mode", _LISTS) < _LISTS for _, p in self.primitives):
            yield "Points and lines have no surface and are not traced."
        if count := len(self.content.get("animations", [])):
            yield f"Animations are not played, {count} of them; everything is traced at rest."
        if count := len(self.content.get("cameras", [])):
            names = [str(node.get("name", "")) for node in nodes if "camera" in node]
            use = "--camera uses one by its node's name"
            yield f"The file has {count_of(count, 'camera')}; {use}: {', '.join(names)[:99]}."
        if "KHR_lights_punctual" in self.content.get("extensions", {}):
            yield "Lights are not used: the file has some."

    def missing(self) -> Iterator[str]:
        """Yield what may be a surface, and is not traced."""
        if any("POSITION" not in p["attributes"] for _, p in self.primitives):
            yield "Primitives without positions are not traced."
        if self.unknown:
            what = "Extensions are not known, so what they move or add is not traced"
            yield f"{what}: {', '.join(self.unknown)[:99]}."


def _is_surface(primitive: Content) -> bool:
    mode = primitive.get("mode", _LISTS)
    if mode not in range(7):
        raise SceneError(f"a primitive has the mode {mode!r:.40}, which must be from 0 to 6")
    return mode >= _LISTS and "POSITION" in primitive["attributes"]


def _compressed(view: Content) -> bool:
    return not COMPRESSED.isdisjoint(view.get("extensions", {}))


def _shapes(thing: Any) -> Any:
    """Return a copy of JSON without what makes no shape."""
    if isinstance(thing, list):
        return [_shapes(part) for part in thing]
    if not isinstance(thing, dict):
        return thing
    return {key: _shapes(part) for key, part in thing.items() if key not in _NO_SHAPE}


def _joined(parts: list[tuple[int, Floats, Index]], name: str) -> Mesh:
    """Return a mesh of primitives; those that share their positions share them here, too."""
    starts: dict[int, int] = {}
    vertices, triangles = [np.zeros((0, 3), np.float32)], [np.zeros((0, 3), np.int32)]
    for position, own, faces in parts:
        if not np.isfinite(own).all():
            raise SceneError(f"accessor {position} holds numbers that are not finite")
        if len(faces) and np.max(faces) >= len(own):
            raise SceneError(f"'{name}' names corner {np.max(faces)} of {len(own)}")
        if position not in starts:
            starts[position] = sum(map(len, vertices))
            vertices.append(own)
        triangles.append(faces.astype(np.int32) + np.int32(starts[position]))
    return Mesh(np.concatenate(vertices), np.concatenate(triangles), name=name)


def _names(meshes: dict[int, Content], tree: Tree, numbers: list[int]) -> dict[int, str]:
    """Return a name for the object of each node; no two have the same."""
    names: dict[int, str] = {}
    taken: set[str] = set()
    for number in numbers:
        node = tree.nodes[number]
        name = str(node.get("name") or meshes[node["mesh"]].get("name") or f"node {number}")
        while name in taken:
            name = f"{name} (node {number})"
        names[number] = name
        taken.add(name)
    return names


def _whole(thing: Content, key: str) -> int:
    value = thing[key]
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
        data = urlopen(uri).read()
    else:
        data = _file(folder, unquote(uri, errors="strict"), size)
    if len(data) < size:
        raise SceneError(f"a buffer is cut off: it has {len(data)} of {size} bytes")
    return data[:size]  # it may be padded


def _file(folder: Path, name: str, size: int) -> bytes:
    """Return the first bytes of a file in the folder, or below it."""
    shown = name[:60]
    # A drive or a server of Windows is not even asked for, nor where it means nothing.
    if PureWindowsPath(name).anchor or ":" in name:
        raise SceneError(f"'{shown}' is not in the folder of the file: copy it there")
    try:
        path = (folder / name).resolve()
        is_file = path.is_file()
    except (OSError, ValueError, RuntimeError):  # no name of a file; RuntimeError: links in circles
        raise SceneError(f"'{shown}' is no name of a file") from None
    if not path.is_relative_to(folder.resolve()):
        raise SceneError(f"'{shown}' is not in the folder of the file: copy it there")
    if not is_file:
        raise SceneError(f"the file '{shown}' is not there")
    with path.open("rb") as file:  # `read` would first take the memory that it is asked for
        return file.read(min(size, path.stat().st_size))

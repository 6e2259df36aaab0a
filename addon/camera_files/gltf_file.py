"""Opens a .glb or a .gltf: its JSON, its own bytes, and where its nodes stand.

Source: Khronos, glTF 2.0 specification, 3.5 and 4; KHR_node_visibility.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np

from ..arrays import Floats
from ..files.checked_json import Content, numbers
from ..scene import SceneError
from .frame import of_quaternion, pose

VISIBILITY = "KHR_node_visibility"
_HEADER = struct.Struct("<4sII")  # magic, version of the container, length of the whole file
_CHUNK = struct.Struct("<I4s")  # length of what follows, type
# How far the fourth row of a matrix may be from 0 0 0 1, which float32 rounds where a writer has
# inverted or multiplied matrices. It is taken to be 0 0 0 1.
_ROUNDING = 1e-5
# How far a quaternion's length may be from 1 without a word: that of signed bytes, half of 1/127
# in each of four components.
_QUANTISED = 1 / 127


@dataclass(frozen=True, eq=False)
class Tree:
    """All nodes of a file, by their numbers, in world space."""

    nodes: list[Content]
    worlds: Floats  # (n, 4, 4) world_from_node
    hidden: set[int]  # by themselves or by a parent
    order: list[int]  # each node after its parent
    parents: dict[int, int]
    notes: tuple[str, ...]

    def below(self, roots: list[int]) -> Iterator[int]:
        """Yield nodes that are roots or descend from one, parents first."""
        found = set(roots)
        for number in self.order:
            if number in found or self.parents.get(number) in found:
                found.add(number)
                yield number


@contextmanager
def as_specified() -> Iterator[None]:
    """Refuse what in a file's JSON is missing, or of another type than the specification says."""
    try:
        yield
    except SceneError:
        raise
    except (LookupError, TypeError, AttributeError, ValueError, OverflowError) as error:
        raise SceneError(f"it is not as glTF is specified ({error!r}): export it again") from error


def item(content: Content, kind: str, number: object) -> Content:
    """Return one of the file's nodes, meshes and so on, by its number."""
    things = content.get(kind, [])
    if type(number) is not int or not 0 <= number < len(things):
        raise SceneError(f"it names number {number!r:.40} of its {len(things)} {kind}")
    if not isinstance(things[number], dict):
        raise SceneError(f"number {number} of its {kind} is no object")
    found: Content = things[number]
    return found


def open_gltf(path: Path) -> tuple[Content, bytes]:
    """Return a file's JSON, and the bytes of its own that a .glb has. Its first bytes say which.

    Raises
    ------
    SceneError
        If it is cut off, holds no JSON, or is of another version than 2.
    """
    content = path.read_bytes()
    if content[:4] != b"glTF":
        return _parsed(content), b""
    if len(content) < _HEADER.size:
        raise SceneError("it is cut off within its header: export it again")
    _, version, length = _HEADER.unpack_from(content)
    if version != 2:
        raise SceneError(f"it is a .glb of version {version}; version 2 is read: export it again")
    if length > len(content):
        raise SceneError(f"it is cut off: it has {len(content)} of {length} bytes: export it again")
    chunks, at = [], _HEADER.size
    while at + _CHUNK.size <= length:
        size, kind = _CHUNK.unpack_from(content, at)
        at += _CHUNK.size + size
        if at > length:
            raise SceneError(f"a chunk of {size} bytes reaches beyond its end: export it again")
        chunks.append((kind, content[at - size : at]))
    if not chunks or chunks[0][0] != b"JSON":
        raise SceneError("it does not begin with a chunk of JSON: export it again")
    own = next((data for kind, data in chunks[1:] if kind == b"BIN\0"), b"")
    return _parsed(chunks[0][1]), own


def _parsed(stored: bytes) -> Content:
    try:
        text = stored.decode("utf-8-sig")
        parsed = json.loads(text, parse_constant=_refuse, parse_float=_number)
    except RecursionError:
        raise SceneError("its JSON is nested too deeply: export it again") from None
    except ValueError as error:
        raise SceneError(f"its JSON cannot be read ({error}): export it again") from error
    asset = parsed.get("asset") if isinstance(parsed, dict) else None
    if not isinstance(asset, dict):
        raise SceneError("it has no 'asset', which says the version of glTF: it is no glTF")
    for key in ("version", "minVersion"):
        said = asset.get(key, "2.0")
        if not str(said).startswith("2." if key == "version" else ("1.", "2.0")):
            raise SceneError(f"its asset.{key} is {said!r:.40}; glTF 2.0 is read: export it again")
    out: Content = parsed
    return out


def _number(text: str) -> float:
    """Return a number; an integer may be written as 3.0 (specification 2.7.5)."""
    value = float(text)
    return int(value) if value.is_integer() and text[0] != "-" else value  # -0.0 has a sign


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"it holds {constant}, which is no number of JSON")


def read_tree(content: Content) -> Tree:
    """Return a file's nodes, placed.

    Raises
    ------
    SceneError
        If nodes stand in a circle, a node has two parents, or is placed nowhere.
    """
    nodes = [item(content, "nodes", number) for number in range(len(content.get("nodes", [])))]
    parents: dict[int, int] = {}
    for number, node in enumerate(nodes):
        for child in node.get("children", []):
            item(content, "nodes", child)
            if child in parents:
                both = f"{parents[child]} and {number}"
                raise SceneError(f"node {child} is a child of both {both}: it may have one parent")
            parents[child] = number
    order = [k for k in range(len(nodes)) if k not in parents]
    for number in order:  # it grows while it is read
        order += nodes[number].get("children", [])
    if len(order) < len(nodes):
        circle = min(set(range(len(nodes))) - set(order))
        raise SceneError(f"node {circle} descends from itself: its children form a circle")
    notes: dict[str, None] = {}
    worlds, hidden = np.empty((len(nodes), 4, 4)), set()
    with np.errstate(all="ignore"):  # what is not finite is found, and refused
        for number in order:
            parent = parents.get(number)
            local = _local(nodes[number], f"node {number} ", notes)
            worlds[number] = local if parent is None else product(worlds[parent], local)
            said = nodes[number].get("extensions", {}).get(VISIBILITY, {})
            if not said.get("visible", True) or parent in hidden:
                hidden.add(number)
    if lost := np.flatnonzero(~np.isfinite(worlds).all(axis=(1, 2))).tolist():
        raise SceneError(f"node {lost[0]} is placed or scaled beyond the range of numbers")
    return Tree(nodes, worlds, hidden, order, parents, tuple(notes))


def product(first: Floats, second: Floats) -> Floats:
    """Return the product of matrices, (..., 4, 4), by operations that round the same everywhere.

    The matrix product of numpy rounds as the machine's library does.
    """
    terms = [first[..., :, k, None] * second[..., None, k, :] for k in range(4)]
    return ((terms[0] + terms[1]) + terms[2]) + terms[3]


def _local(node: Content, where: str, notes: dict[str, None]) -> Floats:
    """Return parent_from_node, (4, 4)."""
    if "matrix" in node:
        matrix: Floats = numbers(node, "matrix", where, (16,)).reshape(4, 4).T.copy()
        if (np.abs(matrix[3] - (0, 0, 0, 1)) > _ROUNDING).any():
            raise SceneError(f"{where}has a matrix with a fourth row that is not 0 0 0 1")
        if not {"translation", "rotation", "scale"}.isdisjoint(node):
            notes["Nodes have a matrix, and parts of one beside it, which are not used."] = None
        matrix[3] = 0, 0, 0, 1
        return matrix
    rest = {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]} | node
    x, y, z, w = rotation = numbers(rest, "rotation", where, (4,))
    length = np.sqrt(x * x + y * y + z * z + w * w)
    if not 0 < length < np.inf:
        raise SceneError(f"{where}has a rotation of length {length:g}: a rotation has length 1")
    if abs(length - 1) > _QUANTISED:
        notes["Rotations are not of length 1, as they must be; they are made so."] = None
    place, scale = (numbers(rest, key, where, (3,)) for key in ("translation", "scale"))
    x, y, z, w = rotation / length
    return pose(of_quaternion(w, x, y, z) * scale, place)

"""Reads PLY by the library plyfile: text and binary, faces of any mixture of sizes, strips."""

from __future__ import annotations

import re
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from reference_tracer.arrays import Floats, Index
from reference_tracer.files.exr import MissingLibraryError
from reference_tracer.scene import SceneError
from reference_tracer.wording import count_of

from .contents import Contents, of_faces
from .text import AGAIN

_CORNERS = "vertex_indices", "vertex_index"
_HEAD = re.compile(rb"\Aply\s.*?^end_header\r?\n", re.DOTALL | re.MULTILINE)
_ELEMENT = re.compile(rb"^element\s+\S+\s+(\d+)", re.MULTILINE)
_TYPE = re.compile(rb"^(property\s+(?:list\s+\S+\s+)?\S+)\s.*$")


def read(path: Path) -> Contents:
    """Read the faces and the triangle strips of a PLY file.

    Raises
    ------
    MissingLibraryError
        If plyfile is not installed.
    SceneError
        If it is cut off, or not a PLY file, or has no vertices.
    """
    vertices: Floats = np.zeros((0, 3))
    corners: list[Index] = [np.zeros(0, np.intp)]
    sizes: list[Index] = [np.zeros(0, np.intp)]
    notes = []
    elements, behind = _elements(path)
    for element in elements:
        if element.name == "vertex":
            vertices = _vertices(element)
        elif element.name in ("face", "tristrips"):
            own, lengths = _lists(element)
            if element.name == "tristrips":
                own, lengths = _of_strips(own, lengths)
            corners.append(own)
            sizes.append(lengths)
        elif element.count:
            row, rows = f"row of '{element.name}' is", f"rows of '{element.name}' are"
            why = "understood, and left out"
            if element.name == "edge":
                row, rows, why = "edge is", "edges are", "drawn: what has no surface meets no ray"
            notes.append(f"{count_of(element.count, row, rows)} not {why}")
    if behind:
        said = count_of(behind, "byte behind the last row is", "bytes behind the last row are")
        notes.append(f"{said} not understood, and left out")
    every = np.concatenate(sizes)
    return of_faces(vertices, np.concatenate(corners), every, [(path.stem, len(every))], notes)


def _elements(path: Path) -> tuple[Any, int]:
    """Return the elements of a file, whose head is made one that the library understands.

    And how many bytes are behind the last row.
    """
    try:
        from plyfile import PlyData, PlyParseError
    except ImportError:
        raise MissingLibraryError(
            'PLY files take the library plyfile: pip install "reference_tracer[meshes]"'
        ) from None
    content = path.read_bytes()
    head = _HEAD.match(content)
    if not head:
        raise SceneError(
            f"it is no PLY file, or is cut off: its head has no beginning or no end: {AGAIN}"
        )
    if any(int(count) > len(content) for count in _ELEMENT.findall(head[0])):
        raise SceneError(f"it is cut off: it has fewer bytes than its head has rows: {AGAIN}")
    body, behind = content[head.end() :], 0
    is_text = b"format ascii" in head[0]
    if is_text:
        lines = [line for line in body.splitlines() if line.strip()]
        rows = sum(map(int, _ELEMENT.findall(head[0])))
        body, behind = b"\n".join((*lines[:rows], b"")), len(b"\n".join(lines[rows:]))
    with tempfile.TemporaryDirectory() as folder:
        plain = _plain(head[0])
        if is_text or plain != head[0]:
            path = Path(folder, "plain.ply")
            path.write_bytes(plain + body)
        try:
            if is_text:  # the library closes what it reads as text
                return PlyData.read(str(path), mmap=False).elements, behind
            return _binary(path)
        except PlyParseError as error:
            raise SceneError(f"it is cut off or damaged, {error}: {AGAIN}") from error


def _binary(path: Path) -> tuple[Any, int]:
    """Return the elements of a file that is no text, and how many bytes are behind them."""
    from plyfile import PlyData, PlyParseError

    with path.open("rb") as stream:
        for size in (3, 4):  # faces of one size are read at once
            stream.seek(0)
            with suppress(PlyParseError):
                found = PlyData.read(stream, mmap="r", known_list_len=_all(size))
                return found.elements, len(stream.read())
        stream.seek(0)
        return PlyData.read(stream, mmap=False).elements, len(stream.read())


def _all(size: int) -> dict[str, dict[str, int]]:
    return {element: dict.fromkeys(_CORNERS, size) for element in ("face", "tristrips")}


def _plain(head: bytes) -> bytes:
    """Return a head without comments, and without names that the library does not understand.

    Blender writes a vertex group by its own name, which may have spaces.
    """
    lines = []
    for number, line in enumerate(head.splitlines(keepends=True)):
        words = line.split()
        if words[:1] in ([b"comment"], [b"obj_info"]):
            continue
        if words[:1] == [b"property"] and (
            len(words) > (5 if words[1:2] == [b"list"] else 3) or not line.isascii()
        ):
            line = _TYPE.sub(rb"\1", line.rstrip()) + b" unnamed%d\n" % number
        lines.append(line)
    return b"".join(lines)


def _vertices(element: Any) -> Floats:
    """Return (v, 3): float32 if all coordinates are stored so, else float64."""
    if not {"x", "y", "z"} <= {p.name for p in element.properties}:
        raise SceneError("its vertices have no x, y and z")
    together = np.stack([element[axis] for axis in "xyz"], axis=1)
    kind = np.dtype(np.float32)
    return together.astype(kind if together.dtype == kind else np.float64)


def _lists(element: Any) -> tuple[Index, Index]:
    """Return the vertices of faces or strips, one after the other, and how many each has."""
    names = [p.name for p in element.properties if p.name in _CORNERS]
    if len(names) != 1:
        raise SceneError(f"its element '{element.name}' has not one list '{_CORNERS[0]}'")
    found = element[names[0]]
    if found.ndim == 2:
        sizes = np.full(len(found), found.shape[1])
    elif found.dtype == object:
        sizes = np.fromiter(map(len, found), np.intp, len(found))
        found = np.concatenate([np.zeros(0, np.intp), *found])
    else:
        raise SceneError(f"its element '{element.name}' has one vertex in a row, and no list")
    whole = found.astype(np.intp).reshape(-1)
    if found.dtype.kind == "f" and (whole != found.reshape(-1)).any():
        raise SceneError(f"its element '{element.name}' names vertices by numbers with fractions")
    return whole, sizes


def _of_strips(corners: Index, sizes: Index) -> tuple[Index, Index]:
    """Return the triangles of strips: each corner makes one with the two before it.

    Every second one is turned, and -1 begins a new strip. What is repeated to go on elsewhere makes
    triangles of no area, which are left out.
    """
    flat = np.insert(corners, np.cumsum(sizes), -1)  # each list is a strip of its own, too
    place = np.arange(len(flat))
    begin = np.maximum.accumulate(np.where(flat < 0, place, -1)) + 1
    parts = np.stack((flat[:-2], flat[1:-1], flat[2:]), axis=1)
    is_turned = (place - begin)[:-2] % 2 == 1
    parts[is_turned] = parts[is_turned][:, [1, 0, 2]]
    a, b, c = parts.T
    parts = parts[(parts.min(axis=1, initial=0) >= 0) & (a != b) & (b != c) & (c != a)]
    return parts.reshape(-1), np.full(len(parts), 3)

"""Reads PLY: text and binary, of either byte order, with faces of any mixture of sizes."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..scene import SceneError
from ..wording import count_of
from .contents import Contents
from .meshes import contents
from .ply_tables import Binary, Columns, Element, Lists, Property, Text, read_tables
from .words import cut_off

_TYPES = {  # numpy's names, by PLY's old and new ones
    "char": "i1",
    "uchar": "u1",
    "short": "i2",
    "ushort": "u2",
    "int": "i4",
    "uint": "u4",
    "float": "f4",
    "double": "f8",
    "int8": "i1",
    "uint8": "u1",
    "int16": "i2",
    "uint16": "u2",
    "int32": "i4",
    "uint32": "u4",
    "float32": "f4",
    "float64": "f8",
}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_CORNERS = "vertex_indices", "vertex_index"
_READ = {*"xyz", *_CORNERS}  # properties that say where something is


def read_ply(path: Path) -> Contents:
    """Read the faces and the triangle strips of a PLY file.

    Raises
    ------
    SceneError
        If it is cut off, or not a PLY file, or has no vertices.
    """
    content = path.read_bytes()
    order, elements, start = _head(content)
    held, first_line = content[start:], 1 + len(content[:start].splitlines())
    body = Binary(held, order) if order else Text(held, first_line)
    vertices: Floats = np.zeros((0, 3))
    faces = [Lists(np.zeros(0, np.intp), np.zeros(0, np.intp))]
    notes = []
    tables, more = read_tables(body, elements)
    for element, columns in zip(elements, tables, strict=True):
        if element.name == "vertex":
            vertices = _vertices(columns)
        elif element.name == "face":
            faces.append(_corners(element, columns))
        elif element.name == "tristrips":
            faces.append(_of_strips(_corners(element, columns)))
        elif element.count:
            notes.append(_passed_over(element))
    if more:
        unit = "byte" if order else "number"
        said = count_of(more, f"{unit} behind the last row is", f"{unit}s behind the last row are")
        notes.append(f"{said} not understood, and left out")
    corners, sizes = map(np.concatenate, zip(*faces, strict=True))
    return contents(vertices, corners.astype(np.intp), sizes, [path.stem], notes=notes)


def _corners(element: Element, columns: Columns) -> Lists:
    """Return the vertices of faces or strips."""
    if all(name in columns for name in _CORNERS):
        raise SceneError(
            f"its element {element.name!r} has both {_CORNERS[0]!r} and {_CORNERS[1]!r}"
        )
    found = next((columns[name] for name in _CORNERS if name in columns), None)
    if not isinstance(found, Lists):
        raise SceneError(f"its element '{element.name}' has no list '{_CORNERS[0]}'")
    if found.values.dtype.kind == "f":
        raise SceneError(f"its element '{element.name}' names vertices by numbers with fractions")
    return found


def _passed_over(element: Element) -> str:
    if element.name == "edge":
        said = count_of(element.count, "edge is", "edges are")
        return f"{said} not drawn: what has no surface meets no ray"
    said = count_of(element.count, f"row of '{element.name}' is", f"rows of '{element.name}' are")
    return f"{said} not understood, and left out"


def _vertices(columns: Columns) -> Floats:
    """Return (v, 3): float32 if all coordinates are stored so, else float64."""
    found = [columns.get(axis) for axis in "xyz"]
    if any(column is None or isinstance(column, Lists) for column in found):
        raise SceneError("its vertices have no x, y and z")
    together = np.stack(found, axis=1)
    return together.astype(np.float32 if together.dtype == np.float32 else np.float64)


def _of_strips(strips: Lists) -> Lists:
    """Return the triangles of strips: each corner makes one with the two before it.

    Every second one is turned, and -1 begins a new strip. What is repeated to go on elsewhere makes
    triangles of no area, which are left out.
    """
    flat = strips.values.astype(np.intp)
    ends = np.cumsum(strips.sizes)
    flat = np.insert(flat, ends, -1)  # each list is a strip of its own, too
    place = np.arange(len(flat))
    begin = np.maximum.accumulate(np.where(flat < 0, place, -1)) + 1
    parts = np.stack((flat[:-2], flat[1:-1], flat[2:]), axis=1)
    is_turned = (place - begin)[:-2] % 2 == 1
    parts[is_turned] = parts[is_turned][:, [1, 0, 2]]
    a, b, c = parts.T
    parts = parts[(parts.min(axis=1, initial=0) >= 0) & (a != b) & (b != c) & (c != a)]
    return Lists(parts.reshape(-1), np.full(len(parts), 3))


def _head(content: bytes) -> tuple[str, list[Element], int]:
    """Return the byte order ("" of text), the elements, and where the body begins."""
    if content[:3] != b"ply":
        raise SceneError("it is no PLY file: its first word is not ply")
    order, elements, place = None, list[Element](), 0
    while place < len(content):
        end = content.find(b"\n", place) + 1 or len(content)
        words = content[place:end].decode("utf-8", "replace").split()
        place = end
        match words:
            case ["format", kind, *_] if kind in _ORDERS:
                order = _ORDERS[kind]
            case ["element", name, count] if count.isdecimal() and not _has(elements, name):
                elements.append(Element(name, int(count), ()))
            case ["property", *rest] if elements:
                last = elements.pop()
                new = _property(rest)
                if new.name in _READ and any(new.name == p.name for p in last.properties):
                    raise SceneError(f"its element '{last.name}' has '{new.name}' twice")
                elements.append(Element(last.name, last.count, (*last.properties, new)))
            case ["end_header"] if order is not None:
                return order, elements, place
            case [] | ["ply"] | ["comment" | "obj_info", *_]:
                pass
            case _:
                raise SceneError(f"its head is not understood: '{' '.join(words)[:60]}'")
    raise cut_off("its head has no end")


def _has(elements: list[Element], name: str) -> bool:
    return any(element.name == name for element in elements)


def _property(words: list[str]) -> Property:
    match words:  # Blender writes a vertex group by its name, which may have spaces
        case [kind, first, *more] if kind in _TYPES:
            return Property(" ".join((first, *more)), _TYPES[kind])
        case ["list", long, kind, name] if kind in _TYPES and _TYPES.get(long, "f")[0] != "f":
            return Property(name, _TYPES[kind], _TYPES[long])
    raise SceneError(f"its head is not understood: 'property {' '.join(words)[:60]}'")

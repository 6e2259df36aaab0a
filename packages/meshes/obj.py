"""Reads Wavefront OBJ: its polygons, by objects."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from reference_tracer.arrays import Index
from reference_tracer.scene import SceneError
from reference_tracer.wording import count_of

from .contents import Contents, of_faces
from .text import AGAIN, floats, in_lines, integers, shown

# What changes nothing of the shape: normals, texture coordinates, materials, how it is displayed.
_NO_SHAPE = frozenset(
    b"vn vt usemtl mtllib usemap maplib s bevel c_interp d_interp lod shadow_obj trace_obj".split()
)
_CURVED = frozenset(
    b"vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con mg ctech stech".split()
)
_NO_SURFACE = {b"l": "lines", b"p": "points"}
_ONE = frozenset((b"1", b"1.0", b"1.000000"))
_COMMENT = re.compile(rb"\s#.*")  # names may hold the sign, as Cube#2


def read(path: Path) -> Contents:
    """Read the polygons of an OBJ file; its objects are those of `o`, else its groups `g`.

    Raises
    ------
    SceneError, ValueError
        If a line is not understood as what it begins as; it says which line.
    """
    content = path.read_bytes().removeprefix(BOM_UTF8)
    if b"\0" in content:
        raise SceneError("it is no OBJ file: it holds bytes that no text has")
    numbers: list[bytes] = []  # of the vertices, three each
    corners: list[bytes] = []  # indices of vertices: from 1, or back from the face
    sizes: list[int] = []  # of the faces
    lines: dict[bytes, list[int]] = {key: [] for key in (b"v", b"f")}
    named = {key: [(0, path.stem)] for key in (b"o", b"g")}  # lines, and the names there
    weights, other = 0, Counter[bytes]()
    for line, words in _statements(content):
        key = words[0]
        if key == b"v":
            _check_vertex(line, words)
            numbers += words[1:4]
            weights += len(words) in (5, 8) and words[4] not in _ONE
        elif key == b"f":
            corners += [word.partition(b"/")[0] for word in words[1:]]
            sizes.append(len(words) - 1)
        elif key in named:
            name = b" ".join(words[1:]).decode("utf-8", "replace") or path.stem
            named[key].append((line, name))
        elif key not in _NO_SHAPE:
            other[key] += 1
        if key in lines:
            lines[key].append(line)
    vertices, faces = lines.values()
    points = in_lines(floats, numbers, [3] * len(vertices), vertices).reshape(-1, 3)
    indices = _indices(in_lines(integers, corners, sizes, faces), sizes, faces, vertices)
    objects, groups = named.values()
    starts, names = zip(*(objects if len(objects) > 1 else groups), strict=True)
    own = zip(names, np.diff([*np.searchsorted(faces, starts), len(faces)]), strict=True)
    notes = _notes(other, weights, [name for _, name in objects[1:]])
    return of_faces(points, indices, np.array(sizes, np.intp), own, notes, _missing(other))


def _check_vertex(line: int, words: list[bytes]) -> None:
    if len(words) < 4:
        raise SceneError(
            f"line {line}: a vertex has three coordinates; if this is the last line, it is cut "
            f"off: {AGAIN}"
        )


def _indices(found: Index, sizes: list[int], faces: list[int], vertices: list[int]) -> Index:
    """Return the corners' indices, from 0, given the lines of faces and vertices."""
    above = np.repeat(np.searchsorted(vertices, faces), sizes)  # vertices above each face
    found = np.where(found < 0, above + 1 + found, found)
    if len(bad := np.flatnonzero((found < 1) | (found > len(vertices)))):
        face = np.searchsorted(np.cumsum(sizes), bad[0], "right")
        names = f"line {faces[face]} names vertex {found[bad[0]]}"
        raise SceneError(f"{names}, but there are {len(vertices)}")
    return found - 1


def _notes(other: Counter[bytes], weights: int, objects: list[str]) -> Iterator[str]:
    for key, count in other.items():
        if key in _CURVED:
            continue
        what = _NO_SURFACE.get(key)
        named = f"'{shown(key)}' ({what})" if what else f"'{shown(key)}'"
        said = count_of(count, f"line {named} is", f"lines {named} are")
        why = "drawn: what has no surface meets no ray" if what else "understood, and left out"
        yield f"{said} not {why}"
    if weights:
        said = count_of(weights, "vertex has a weight", "vertices have weights")
        yield f"{said} other than 1, which polygons do not use"
    if again := [f"'{name}'" for name, count in Counter(objects).items() if count > 1]:
        yield f"objects that have the same name are taken as one: {', '.join(again[:3])}"


def _missing(other: Counter[bytes]) -> Iterator[str]:
    curved = {key.decode(): count for key, count in other.items() if key in _CURVED}
    if curved:
        said = f"{count_of(sum(curved.values()), 'line')} ({', '.join(curved)})"
        yield f"curves and surfaces are not drawn: {said}; save them as polygons"


def _statements(content: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """Yield the number and the words of each line that has some; a backslash continues it."""
    lines = enumerate(content.splitlines(), 1)
    for number, line in lines:
        if line.lstrip().startswith(b"#"):
            continue  # a backslash in a comment is part of it
        if line.endswith(b"\\"):
            parts = []
            while line.endswith(b"\\"):
                parts.append(line[:-1])
                line = next(lines, (0, b""))[1]
            line = b" ".join((*parts, line))
        if b"#" in line:
            line = _COMMENT.sub(b"", line)
        if words := line.split():
            yield number, words

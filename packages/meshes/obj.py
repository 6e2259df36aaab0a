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
    return _Reading(path.stem).read(content)


class _Reading:
    """The state after the lines of a file read so far."""

    def __init__(self, stem: str) -> None:
        self.numbers: list[bytes] = []  # of the vertices, three each
        self.vertex_lines: list[int] = []
        self.corners: list[bytes] = []  # indices of vertices: from 1, or back from the face
        self.sizes: list[int] = []  # of the faces
        self.above: list[int] = []  # vertices above each face
        self.face_lines: list[int] = []
        # Of objects and groups, how many faces were there before each, and its name.
        self.begun = {key: [(0, stem)] for key in (b"o", b"g")}
        self.stem = stem
        self.weights = 0
        self.other: Counter[bytes] = Counter()

    def read(self, content: bytes) -> Contents:
        """Read a whole file."""
        for line, words in _statements(content):
            key = words[0]
            if key == b"v":
                self._vertex(line, words)
            elif key == b"f":
                self._face(line, words[1:])
            elif key in self.begun:
                name = b" ".join(words[1:]).decode("utf-8", "replace") or self.stem
                self.begun[key].append((len(self.sizes), name))
            elif key not in _NO_SHAPE:
                self.other[key] += 1
        objects, groups = self.begun.values()
        starts, named = zip(*(objects if len(objects) > 1 else groups), strict=True)
        names = {name: number for number, name in enumerate(dict.fromkeys(named))}
        faces = np.diff([*starts, len(self.sizes)])
        threes = [3] * len(self.vertex_lines)
        return of_faces(
            in_lines(floats, self.numbers, threes, self.vertex_lines).reshape(-1, 3),
            self._indices(),
            np.array(self.sizes, np.intp),
            names,
            np.repeat([names[name] for name in named], faces),
            self._notes(),
            self._missing(),
        )

    def _vertex(self, line: int, words: list[bytes]) -> None:
        if len(words) < 4:
            raise SceneError(
                f"line {line}: a vertex has three coordinates; if this is the last line, it is cut "
                f"off: {AGAIN}"
            )
        self.numbers += words[1:4]
        self.vertex_lines.append(line)
        if len(words) in (5, 8) and words[4] not in _ONE:
            self.weights += 1

    def _face(self, line: int, words: list[bytes]) -> None:
        self.corners += [word.partition(b"/")[0] for word in words]
        self.sizes.append(len(words))
        self.above.append(len(self.vertex_lines))
        self.face_lines.append(line)

    def _indices(self) -> Index:
        """Return the corners' indices, from 0."""
        found = in_lines(integers, self.corners, self.sizes, self.face_lines)
        above, sizes = (np.array(own, np.intp) for own in (self.above, self.sizes))
        found = np.where(found < 0, np.repeat(above, sizes) + 1 + found, found)
        if len(bad := np.flatnonzero((found < 1) | (found > len(self.vertex_lines)))):
            face = np.searchsorted(np.cumsum(sizes), bad[0], "right")
            names = f"line {self.face_lines[face]} names vertex {found[bad[0]]}"
            raise SceneError(f"{names}, but there are {len(self.vertex_lines)}")
        return found - 1

    def _notes(self) -> Iterator[str]:
        for key, count in self.other.items():
            if key in _CURVED:
                continue
            what = _NO_SURFACE.get(key)
            named = f"'{shown(key)}' ({what})" if what else f"'{shown(key)}'"
            said = count_of(count, f"line {named} is", f"lines {named} are")
            why = "drawn: what has no surface meets no ray" if what else "understood, and left out"
            yield f"{said} not {why}"
        if self.weights:
            said = count_of(self.weights, "vertex has a weight", "vertices have weights")
            yield f"{said} other than 1, which polygons do not use"
        times = Counter(name for _, name in self.begun[b"o"][1:])
        if again := [f"'{name}'" for name, count in times.items() if count > 1]:
            yield f"objects that have the same name are taken as one: {', '.join(again[:3])}"

    def _missing(self) -> Iterator[str]:
        curved = {key.decode(): count for key, count in self.other.items() if key in _CURVED}
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

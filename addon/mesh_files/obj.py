"""Reads Wavefront OBJ: its polygons, by objects."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..arrays import Floats, Index
from ..scene import SceneError
from ..wording import count_of
from .contents import Contents
from .meshes import contents
from .words import SHORT_VERTEX, floats, integers, numbers, shown

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


def read_obj(path: Path) -> Contents:
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
    """What the lines of a file have said so far."""

    def __init__(self, stem: str) -> None:
        self.numbers: list[bytes] = []  # of the vertices, three each
        self.vertex_lines: list[int] = []
        self.corners: list[bytes] = []  # indices of vertices, from 1
        self.sizes: list[int] = []  # of the faces
        self.face_lines: list[int] = []
        self.groups = _Names(stem)
        self.objects = _Names(stem)
        self.weights = 0
        self.other: Counter[bytes] = Counter()

    def read(self, content: bytes) -> Contents:
        """Read a whole file."""
        by_name = {b"g": self.groups, b"o": self.objects}
        for line, words in _statements(content):
            key = words[0]
            if key == b"v":
                self._vertex(line, words)
            elif key == b"f":
                self._face(line, words[1:])
            elif key in by_name:
                by_name[key].take_up(b" ".join(words[1:]).decode("utf-8", "replace"))
            elif key not in _NO_SHAPE:
                self.other[key] += 1
        by = self.objects if self.objects.times else self.groups
        return contents(
            self._vertices(),
            self._indices(),
            np.array(self.sizes, np.intp),
            list(by.numbers),
            np.array(by.of_faces, np.intp),
            tuple(self._notes()),
            tuple(self._missing()),
        )

    def _vertex(self, line: int, words: list[bytes]) -> None:
        if len(words) < 4:
            raise SceneError(f"line {line}: {SHORT_VERTEX}")
        self.numbers += words[1:4]
        self.vertex_lines.append(line)
        if len(words) in (5, 8) and words[4] not in _ONE:
            self.weights += 1

    def _face(self, line: int, words: list[bytes]) -> None:
        corners = [word.partition(b"/")[0] for word in words]
        for k, corner in enumerate(corners):
            if corner[:1] == b"-":  # -1 is the last vertex above the line
                (back,) = numbers(integers, [corner], lambda _: line)
                corners[k] = b"%d" % (back and len(self.vertex_lines) + 1 + back)
        self.corners += corners
        self.sizes.append(len(corners))
        self.face_lines.append(line)
        for names in (self.groups, self.objects):
            names.of_faces.append(names.current)

    def _vertices(self) -> Floats:
        found = numbers(floats, self.numbers, lambda k: self.vertex_lines[k // 3])
        return found.reshape(-1, 3)

    def _indices(self) -> Index:
        """Return the corners' indices, from 0."""
        found = numbers(integers, self.corners, self._line_of)
        if len(bad := np.flatnonzero((found < 1) | (found > len(self.vertex_lines)))):
            line, count = self._line_of(int(bad[0])), len(self.vertex_lines)
            raise SceneError(f"line {line} names vertex {found[bad[0]]}, but there are {count}")
        return found - 1

    def _line_of(self, corner: int) -> int:
        return self.face_lines[int(np.searchsorted(np.cumsum(self.sizes), corner, "right"))]

    def _notes(self) -> Iterator[str]:
        for key, what in _NO_SURFACE.items():
            if count := self.other[key]:
                named = f"'{key.decode()}' ({what})"
                said = count_of(count, f"line {named} is", f"lines {named} are")
                yield f"{said} not drawn: what has no surface meets no ray"
        if self.weights:
            said = count_of(self.weights, "vertex has a weight", "vertices have weights")
            yield f"{said} other than 1, which polygons do not use"
        if again := [f"'{name}'" for name, times in self.objects.times.items() if times > 1]:
            yield f"objects that have the same name are taken as one: {', '.join(again[:3])}"
        for key, count in self.other.items():
            if key not in _CURVED and key not in _NO_SURFACE:
                named = f"'{shown(key)}'"
                said = count_of(count, f"line {named} is", f"lines {named} are")
                yield f"{said} not understood, and left out"

    def _missing(self) -> Iterator[str]:
        if curved := [key.decode() for key in self.other if key in _CURVED]:
            count = sum(self.other[key.encode()] for key in curved)
            said = f"{count_of(count, 'line')} ({', '.join(curved)})"
            yield f"curves and surfaces are not drawn: {said}; save them as polygons"


class _Names:
    """The names of objects, or of groups, and which each face is of."""

    def __init__(self, first: str) -> None:
        self.numbers = {first: 0}
        self.first = first
        self.current = 0
        self.times = Counter[str]()  # that each was taken up
        self.of_faces: list[int] = []

    def take_up(self, name: str) -> None:
        """Make the next faces those of a name, which may have been there before."""
        self.times[name] += 1
        self.current = self.numbers.setdefault(name or self.first, len(self.numbers))


def _statements(content: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """Yield the number and the words of each line that has some; a backslash continues it."""
    lines = enumerate(content.splitlines(), 1)
    for number, line in lines:
        if line.lstrip().startswith(b"#"):
            continue  # a backslash in a comment is part of it
        while line.endswith(b"\\"):
            line = line[:-1] + b" " + next(lines, (0, b""))[1]
        if b"#" in line:
            line = _COMMENT.sub(b"", line)
        if words := line.split():
            yield number, words

"""Reads OFF, with or without colours, normals and texture coordinates of its vertices."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from ..scene import SceneError
from ..wording import count_of
from .contents import Contents
from .meshes import contents
from .words import AGAIN, SHORT_VERTEX, cut_off, floats, integers, numbers

_GLUED = re.compile(rb"(OFF)(\d+)")  # as many files of ModelNet have it
_KIND = re.compile(rb"(ST)?(C)?(N)?(4)?(n)?OFF")
_COMMENT = re.compile(rb"#.*")
_MORE_OF_FACE = 0, 1, 3, 4  # numbers behind a face's corners: no colour, one of a map, RGB, RGBA


def read_off(path: Path) -> Contents:
    """Read an OFF file: a line for each vertex, then a line for each face.

    What follows a vertex's coordinates, or a face's corners, is colours and the like.

    Raises
    ------
    SceneError
        If it is cut off, not an OFF file, or one of another number of dimensions, or binary.
    """
    lines = _lines(path.read_bytes().removeprefix(BOM_UTF8))
    first, words = next(lines, (0, [b""]))
    if glued := _GLUED.fullmatch(words[0]):
        words = [*glued.groups(), *words[1:]]
    kind = _KIND.fullmatch(words[0])
    if not kind:
        raise SceneError("it is no OFF file: its first word is not OFF")
    if kind[4] or kind[5]:
        raise SceneError(f"{words[0].decode()} has another number of dimensions: save it as OFF")
    if words[1:2] == [b"BINARY"]:
        raise SceneError("it is a binary OFF file: save it as text")
    line, counts = (first, words[1:]) if words[1:] else next(lines, (0, []))
    vertex_count, face_count = _integers(line, counts[:2], 2)
    more_of_vertex = _more_of_vertex(*kind.groups()[:3])
    coordinates: list[bytes] = []
    vertex_lines: list[int] = []
    odd_vertices = odd_faces = 0
    for _ in range(vertex_count):
        line, words = _next(lines, ("vertex", "vertices"), vertex_count)
        if len(words) < 3:
            raise SceneError(f"line {line}: {SHORT_VERTEX}")
        coordinates += words[:3]
        vertex_lines.append(line)
        odd_vertices += len(words) - 3 not in more_of_vertex
    corners: list[int] = []
    sizes: list[int] = []
    for _ in range(face_count):
        line, words = _next(lines, ("face", "faces"), face_count)
        (size,) = _integers(line, words[:1], 1)
        corners += _integers(line, words[1 : 1 + size], size)
        sizes.append(size)
        odd_faces += len(words) - 1 - size not in _MORE_OF_FACE
    vertices = numbers(floats, coordinates, lambda k: vertex_lines[k // 3]).reshape(-1, 3)
    more = sum(1 for _ in lines)
    odd = count_of(odd_vertices, "vertex has", "vertices have")
    colored = count_of(odd_faces, "face has", "faces have")
    said = {
        f"{odd} other numbers than {kind[0].decode()} names: three are read": odd_vertices,
        f"{colored} numbers behind the corners that are no colour, and left out": odd_faces,
        "what is behind the last face is not understood, and left out: "
        + count_of(more, "line"): more,
    }
    notes = [note for note, count in said.items() if count]
    faces = np.array(corners, np.intp), np.array(sizes, np.intp)
    return contents(vertices, *faces, [path.stem], notes=notes)


def _more_of_vertex(*parts: bytes | None) -> set[int]:
    """Return how many numbers may follow a vertex's coordinates, by what the header has.

    That is two texture coordinates (ST), a colour of three or four numbers (C), a normal (N).
    """
    texture, color, normal = (part is not None for part in parts)
    return {2 * texture + 3 * normal + of_color for of_color in ((3, 4) if color else (0,))}


def _lines(content: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """Yield the number and the words of each line that has some."""
    for number, line in enumerate(content.splitlines(), 1):
        if words := (_COMMENT.sub(b"", line) if b"#" in line else line).split():
            yield number, words


def _next(
    lines: Iterator[tuple[int, list[bytes]]], what: tuple[str, str], count: int
) -> tuple[int, list[bytes]]:
    found = next(lines, None)
    if found is None:
        raise cut_off(f"it should have {count_of(count, *what)}")
    return found


def _integers(line: int, words: Sequence[bytes], count: int) -> list[int]:
    """Return so many integers, none of them negative."""
    try:
        found: list[int] = integers(words).tolist()
    except ValueError as error:
        raise SceneError(f"line {line}: {error}") from None
    if len(found) < count or min(found, default=0) < 0:
        wanted = f"line {line}: {count_of(count, 'integer')} from 0 on should be there"
        raise SceneError(f"{wanted}; if this is the last line, it is cut off: {AGAIN}")
    return found

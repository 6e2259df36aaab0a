"""Reads OFF, with or without colours, normals and texture coordinates of its vertices."""

from __future__ import annotations

import re
from codecs import BOM_UTF8
from itertools import islice
from pathlib import Path

from reference_tracer.scene import SceneError
from reference_tracer.wording import count_of

from .contents import Contents, of_faces
from .text import AGAIN, floats, in_lines, integers, statements

_GLUED = re.compile(rb"(OFF)(\d+)")  # as many files of ModelNet have it
_MORE_OF_FACE = 0, 1, 3, 4  # numbers behind a face's corners: no colour, one of a map, RGB, RGBA
_KIND = re.compile(rb"(ST)?(C)?(N)?(4)?(n)?OFF")


def read(path: Path) -> Contents:
    """Read an OFF file: a line for each vertex, then a line for each face.

    What follows a vertex's coordinates, or a face's corners, is colours and the like.

    Raises
    ------
    SceneError
        If it is cut off, not an OFF file, or one of another number of dimensions, or binary.
    """
    lines = statements(path.read_bytes().removeprefix(BOM_UTF8))
    first, words = next(lines, (0, [b""]))
    if glued := _GLUED.fullmatch(words[0]):
        words = [*glued.groups(), *words[1:]]
    kind = _KIND.fullmatch(words[0])
    if not kind:
        raise SceneError("it is no OFF file: its first word is not OFF")
    if kind[4] or kind[5] or words[1:2] == [b"BINARY"]:
        raise SceneError(f"{words[0].decode()} of four dimensions, or binary: save it as text OFF")
    line, counts = (first, words[1:]) if words[1:] else next(lines, (0, []))
    vertex_count, face_count = _counts(line, counts)
    vertices = [*islice(lines, vertex_count)]
    faces = [*islice(lines, face_count)]
    coordinates = [word for _, own in vertices for word in own[:3]]
    if short := [n for n, own in vertices if len(own) < 3]:
        raise SceneError(f"line {short[0]} has no three coordinates: {AGAIN}")
    if len(vertices) < vertex_count or len(faces) < face_count:
        raise SceneError(f"it is cut off: its counts say more than it has; {AGAIN}")
    threes = [3] * vertex_count
    points = in_lines(floats, coordinates, threes, [n for n, _ in vertices]).reshape(-1, 3)
    numbers = [n for n, _ in faces]
    sizes = in_lines(integers, [own[0] for _, own in faces], [1] * face_count, numbers)
    sized = [(n, own[1:], size) for (n, own), size in zip(faces, sizes.tolist(), strict=True)]
    if short := [n for n, own, size in sized if not 0 <= size <= len(own)]:
        raise SceneError(f"line {short[0]} has fewer corners than it says: {AGAIN}")
    words = [word for _, own, size in sized for word in own[:size]]
    more = sum(1 for _ in lines)
    allowed = _more_of_vertex(*kind.groups()[:3])
    odd = sum(len(own) - 3 not in allowed for _, own in vertices)
    colored = sum(len(own) - size not in _MORE_OF_FACE for _, own, size in sized)
    said = {
        f"{count_of(odd, 'vertex has', 'vertices have')} other numbers than {kind[0].decode()} "
        "names: three are read": odd,
        f"{count_of(colored, 'face has', 'faces have')} numbers behind the corners that are no "
        "colour, and left out": colored,
        "what is behind the last face is not understood, and left out: "
        + count_of(more, "line"): more,
    }
    return of_faces(
        points,
        in_lines(integers, words, sizes.tolist(), numbers),
        sizes,
        [path.stem],
        notes=[note for note, count in said.items() if count],
    )


def _more_of_vertex(*parts: bytes | None) -> set[int]:
    """Return how many numbers may follow a vertex's coordinates, by what the header has.

    That is two texture coordinates (ST), a colour of three or four numbers (C), a normal (N).
    """
    texture, color, normal = (part is not None for part in parts)
    return {2 * texture + 3 * normal + of_color for of_color in ((3, 4) if color else (0,))}


def _counts(line: int, words: list[bytes]) -> list[int]:
    """Return how many vertices and faces there should be."""
    found: list[int] = in_lines(integers, words[:2], [2], [line]).tolist()  # below 2^62
    if len(found) < 2 or min(found) < 0:
        raise SceneError(f"line {line} should say how many vertices and faces there are: {AGAIN}")
    return found

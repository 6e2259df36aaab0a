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

_MORE_OF_FACE = 0, 1, 3, 4  # numbers behind a face's corners: no colour, one of a map, RGB, RGBA
# What its vertices have, and the first count, which many files of ModelNet have glued to it.
_KIND = re.compile(rb"((ST)?(C)?(N)?(4)?(n)?OFF)(\d+)?")


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
    kind = _KIND.fullmatch(words[0])
    if not kind:
        raise SceneError("it is no OFF file: its first word is not OFF")
    name = kind[1].decode()
    if kind[5] or kind[6] or words[1:2] == [b"BINARY"]:
        raise SceneError(f"{name} of four dimensions, or binary: save it as text OFF")
    counts = [kind[7], *words[1:]] if kind[7] else words[1:]
    line, counts = (first, counts) if counts else next(lines, (0, []))
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
    # Texture coordinates (ST), a normal (N), and a colour (C) of three or four numbers.
    plain = 3 + 2 * bool(kind[2]) + 3 * bool(kind[4])
    allowed = (plain + 3, plain + 4) if kind[3] else (plain,)
    odd = sum(len(own) not in allowed for _, own in vertices)
    colored = sum(len(own) - size not in _MORE_OF_FACE for _, own, size in sized)
    said = {
        f"{count_of(odd, 'vertex has', 'vertices have')} other numbers than {name} "
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
        [(path.stem, face_count)],
        [note for note, count in said.items() if count],
    )


def _counts(line: int, words: list[bytes]) -> list[int]:
    """Return how many vertices and faces there should be."""
    found: list[int] = in_lines(integers, words[:2], [2], [line]).tolist()  # below 2^62
    if len(found) < 2 or min(found) < 0:
        raise SceneError(f"line {line} should say how many vertices and faces there are: {AGAIN}")
    return found

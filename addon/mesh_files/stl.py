"""Reads STL, binary and text."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..file_kinds import binary_stl_length
from ..scene import SceneError
from ..wording import count_of
from .contents import Contents
from .meshes import contents
from .words import AGAIN, cut_off, floats, numbers, shown

_HEAD = 84  # bytes: 80 of any text, and the number of triangles
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
# The words of a text, but for `solid` and `vertex`; what else a line begins with is refused.
_OTHER = frozenset(b"facet outer endloop endfacet endsolid".split())


def read_stl(path: Path) -> Contents:
    """Read an STL file. It is binary if it is as long as its number of triangles says.

    Raises
    ------
    SceneError
        If it is cut off, or not an STL file.
    """
    content = path.read_bytes()
    count = int.from_bytes(content[80:_HEAD], "little")
    long = binary_stl_length(content)
    is_text = content.lstrip()[:5].lower() == b"solid"
    if len(content) == long or not is_text:
        return _binary(content, count, long, path.stem)
    return _text(content, path.stem)


def _binary(content: bytes, count: int, long: int, name: str) -> Contents:
    if len(content) < long or len(content) < _HEAD:
        there = f"{len(content):,} bytes of {long:,} are there"
        raise SceneError(f"it is cut off, or no STL: {there}; {AGAIN}")
    facets = np.frombuffer(content, _FACET, count, _HEAD)
    notes = []
    if more := len(content) - long:
        at = "behind the last triangle"
        said = count_of(more, f"byte {at} is", f"bytes {at} are")
        notes = [f"{said} not understood, and left out"]
    corners = np.arange(3 * count)
    sizes = np.full(count, 3)
    return contents(facets["corners"].reshape(-1, 3), corners, sizes, [name], notes=notes)


def _text(content: bytes, stem: str) -> Contents:
    coordinates: list[bytes] = []
    vertex_lines: list[int] = []
    sizes: list[int] = []
    owners: list[int] = []
    names: dict[str, int] = {}
    current, key = 0, b""
    for line, text in enumerate(content.splitlines(), 1):
        words = text.split()
        key = words[0].lower() if words else key
        if not words:
            continue
        if key == b"vertex" and len(words) == 4 and sizes:
            coordinates += words[1:]
            vertex_lines.append(line)
            sizes[-1] += 1
        elif key == b"solid":
            name = b" ".join(words[1:]).decode("utf-8", "replace") or stem
            current = names.setdefault(name, len(names))
        elif key == b"outer":
            sizes.append(0)
            owners.append(current)
        elif key not in _OTHER:
            raise SceneError(f"line {line} is not understood: '{shown(text.strip())}'")
    if key != b"endsolid":
        raise cut_off("its last line is not 'endsolid'")
    vertices = numbers(floats, coordinates, lambda k: vertex_lines[k // 3]).reshape(-1, 3)
    corners = np.arange(len(vertices))
    return contents(vertices, corners, np.array(sizes, np.intp), list(names), np.array(owners))

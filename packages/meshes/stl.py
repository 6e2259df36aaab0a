"""Reads STL: binary by trimesh, and text, whose facets may have any number of corners."""

from __future__ import annotations

import re
from io import BytesIO
from pathlib import Path

import numpy as np
from reference_tracer.cli.opening import import_trimesh
from reference_tracer.files.file_kinds import binary_stl_length
from reference_tracer.scene import SceneError
from reference_tracer.wording import count_of

from .contents import Contents, of_faces
from .text import AGAIN, floats

# What is left of a file whose facets are single bytes: names, each with its facets.
_VERTEX = rb"\s+vertex" + 3 * rb"\s+(\S+)"
_FACET = re.compile(
    rb"^[ \t]*facet\b[^\n]*\n\s*outer\s+loop((?:" + _VERTEX.replace(b"(", b"(?:") + rb")*)"
    rb"\s+endloop\s+endfacet\b",
    re.IGNORECASE | re.MULTILINE,
)
_SOLID = re.compile(
    rb"^[ \t]*solid\b[ \t]*([^\n\0]*?)\s*$([\0\s]*)^[ \t]*endsolid\b.*$",
    re.IGNORECASE | re.MULTILINE,
)
_HEAD = 84  # bytes: 80 of any text, and the number of triangles


def read(path: Path) -> Contents:
    """Read an STL file. It is binary if it is as long as its number of triangles says.

    Raises
    ------
    SceneError
        If it is cut off, or not an STL file.
    """
    import_trimesh()
    from trimesh.exchange.stl import load_stl_binary

    content = path.read_bytes()
    long = binary_stl_length(content)
    if len(content) != long and content.lstrip()[:5].lower() == b"solid":
        return _of_text(content, path.stem)
    if len(content) < max(long, _HEAD):
        there = f"{len(content):,} bytes of {long:,} are there"
        raise SceneError(f"it is cut off, or no STL: {there}; {AGAIN}")
    notes = []
    if more := len(content) - long:
        at = "behind the last triangle"
        said = count_of(more, f"byte {at} is", f"bytes {at} are")
        notes = [f"{said} not understood, and left out"]
    found = load_stl_binary(BytesIO(content[:long]))
    vertices = found.get("vertices", np.zeros((0, 3), np.float32))
    sizes = np.full(len(vertices) // 3, 3)
    return of_faces(vertices, np.arange(len(vertices)), sizes, [(path.stem, len(sizes))], notes)


def _of_text(content: bytes, stem: str) -> Contents:
    rest = _FACET.sub(b"\0", content)
    solids = _SOLID.findall(rest)
    if b"\0" in content or _SOLID.sub(b"", rest).strip():
        raise SceneError(f"it is cut off, or a line of it is not understood: {AGAIN}")
    facets = _FACET.findall(content)
    vertices = [v for facet in facets for v in re.findall(_VERTEX, facet, re.IGNORECASE)]
    numbers = floats([word for vertex in vertices for word in vertex]).reshape(-1, 3)
    own = [
        (name.decode("utf-8", "replace") or stem, inside.count(b"\0")) for name, inside in solids
    ]
    sizes = np.array([len(facet.split()) // 4 for facet in facets], np.intp)
    return of_faces(numbers, np.arange(len(numbers)), sizes, own)

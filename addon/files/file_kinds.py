"""Tells by the first bytes of a file what it is, where its name says something else.

What was downloaded may be a web page, and what was cloned a pointer of Git LFS, under the name of
the file that was meant. Nothing but a few bytes is read.
"""

from __future__ import annotations

import os
from codecs import BOM_UTF8
from pathlib import Path
from typing import NamedTuple

from ..scene import SceneError

_READ = 84  # bytes, in which each kind shows


class _Kind(NamedTuple):
    """A kind of file that others are mistaken for."""

    name: str
    begins: tuple[bytes, ...]
    suffixes: tuple[str, ...]  # of files that may begin so
    do: str = "rename it to what it is, or name another file"


_KINDS = (
    _Kind(
        "a pointer of Git LFS, which stands for the file",
        (b"version https://git-lfs",),
        (),
        "`git lfs pull` in its folder fetches the file itself",
    ),
    _Kind(
        "a web page",
        (b"<!DOCTYPE html", b"<!doctype html", b"<html", b"<HTML"),
        (".html",),
        "download the file itself, on GitHub by 'Download raw file'",
    ),
    _Kind("a PNG picture", (b"\x89PNG",), (".png",)),
    _Kind("a JPEG picture", (b"\xff\xd8\xff",), (), "save the picture as PNG, which loses nothing"),
    _Kind("an EXR picture", (b"v/1\x01",), (".exr",)),
    _Kind("a .blend", (b"BLENDER-", b"BLENDER_", b"BLENDER1"), (".blend",)),
    _Kind("a .glb", (b"glTF",), (".glb", ".gltf")),
    _Kind("a .ply", (b"ply\n", b"ply\r"), (".ply",)),
    _Kind("a zip archive", (b"PK\x03\x04",), (".npz", ".usdz"), "unpack it"),
    _Kind("a PDF", (b"%PDF-",), (), "name a file of another kind"),
)
# The first bytes of files by their suffix, one of these; packed ones of Blender have zstd or gzip.
_MUST = {
    ".blend": (b"BLENDER", b"\x28\xb5\x2f\xfd", b"\x1f\x8b"),
    ".npz": (b"PK",),
    ".png": (b"\x89PNG",),
    ".exr": (b"v/1\x01",),
}


def mistaken(path: Path) -> str:
    """Return what a file is and what to do, if its name says something else; else "".

    Raises
    ------
    OSError
        If it cannot be read.
    """
    with path.open("rb") as file:
        content = file.read(_READ)
    head = content.removeprefix(BOM_UTF8)
    if not head:
        return "is empty: save, copy or download it again"
    suffix = path.suffix.lower()
    if suffix == ".stl" and path.stat().st_size == binary_stl_length(content):
        return ""  # it begins with any text
    for kind in _KINDS:
        if head.lstrip().startswith(kind.begins) and suffix not in kind.suffixes:
            return f"is {kind.name}: {kind.do}"
    if suffix in _MUST and not head.startswith(_MUST[suffix]):
        return f"is no {suffix}, as its first bytes say: save, copy or download it again"
    return ""


def binary_stl_length(content: bytes) -> int:
    """Return how long a binary STL is with a head of 84 bytes: any text, and a number of facets."""
    return 84 + 50 * int.from_bytes(content[80:84], "little")


def check_is_file(path: str | Path) -> None:
    """Raise a SceneError if there is no such file, it cannot be read, or it is of another kind."""
    if os.path.exists(path) and not os.path.isfile(path):
        raise SceneError(f"'{path}' is no file but a folder, or a pipe: name a file")
    try:
        said = mistaken(Path(path))
    except FileNotFoundError:
        raise SceneError(f"there is no file '{path}'") from None
    except (OSError, ValueError) as error:  # a name may be too long, or none
        raise SceneError(f"'{path}' cannot be read: {getattr(error, 'strerror', error)}") from error
    if said:
        raise SceneError(f"'{path}' {said}")

"""Opens a .glb or a .gltf: its JSON, and the binary chunk that a .glb may have.

This reader is our own: no library applies skins, morph targets, sparse and normalised numbers in
float64, or says what it leaves out. The container takes twenty lines; `pygltflib` and Blender's
importer are the judges in the tests. Nothing here runs code: bytes become numbers.

Source: Khronos, glTF 2.0 specification, chapters 2 and 4.
"""

from __future__ import annotations

import json
import re
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from ...scene import SceneError
from ...wording import count_of
from .document import Document, quoted
from .notes import Notes

_MAGIC = b"glTF"
_HEADER = struct.Struct("<4sII")  # magic, version of the container, length of the whole file
_CHUNK = struct.Struct("<I4s")  # length of what follows, type
_JSON, _BINARY = b"JSON", b"BIN\0"


@dataclass(frozen=True)
class Container:
    """What a file consists of."""

    document: Document
    binary: memoryview | None  # the .glb's own buffer


def open_container(path: Path, notes: Notes) -> Container:
    """Read a file. Its first bytes, not its suffix, say which of the two it is.

    Raises
    ------
    SceneError
        If it is cut off, holds no JSON, or is of another version than 2.
    """
    content = memoryview(path.read_bytes())
    if content[:4] != _MAGIC:
        return Container(_document(content), None)
    chunks = _chunks(content, notes)
    if not chunks or chunks[0][0] != _JSON:
        raise SceneError("it does not begin with a chunk of JSON: export it again")
    binary = None
    for kind, data in chunks[1:]:
        if kind == _BINARY and binary is None:
            binary = data
        else:
            name = bytes(kind).decode("latin-1").rstrip("\0")
            notes.add("The specification does not say what further chunks hold; not read", name)
    return Container(_document(chunks[0][1]), binary)


def _chunks(content: memoryview, notes: Notes) -> list[tuple[bytes, memoryview]]:
    """Return the type and the bytes of each chunk (specification 4.4)."""
    if len(content) < _HEADER.size:
        raise SceneError("it is cut off within its header: export it again")
    _, version, length = _HEADER.unpack_from(content)
    if version != 2:
        raise SceneError(f"it is a .glb of version {version}; version 2 is read: export it again")
    if length > len(content):
        raise SceneError(f"it is cut off: it has {len(content)} of {length} bytes: export it again")
    if length < len(content):
        more, end = len(content) - length, "the end of the .glb and"
        said = count_of(more, f"byte follows {end} is", f"bytes follow {end} are")
        notes.add(f"{said} not read")
    found, at = [], _HEADER.size
    while at < length:
        if at + _CHUNK.size > length:
            raise SceneError("it is cut off within the head of a chunk: export it again")
        size, kind = _CHUNK.unpack_from(content, at)
        at += _CHUNK.size
        if at + size > length:
            raise SceneError(f"a chunk of {size} bytes reaches beyond its end: export it again")
        found.append((kind, content[at : at + size]))
        at += size
    return found


def _document(content: memoryview) -> Document:
    try:
        parsed = json.loads(bytes(content).decode("utf-8-sig"), parse_constant=_refuse)
    except RecursionError:
        raise SceneError("its JSON is nested too deeply: export it again") from None
    except ValueError as error:
        raise SceneError(f"its JSON cannot be read ({error}): export it again") from error
    if not isinstance(parsed, dict):
        raise SceneError("its JSON is no object: it is no glTF")
    document = Document(parsed, "the file")
    _check_version(document)
    return document


def _refuse(constant: str) -> NoReturn:
    raise ValueError(f"it holds {constant}, which is no number of JSON")


def _check_version(document: Document) -> None:
    """Refuse what is not of version 2, or needs a later one than 2.0 (specification 3.2)."""
    asset = document.part("asset")
    if asset is None:
        raise SceneError("it has no 'asset', which says the version of glTF: it is no glTF")
    version, least = asset.content.get("version"), asset.content.get("minVersion", "2.0")
    if not str(version).startswith("2."):
        raise SceneError(f"its asset.version is {quoted(version)}; glTF 2 is read: export it again")
    if not (isinstance(least, str) and re.fullmatch(r"1\.\d+|2\.0", least)):
        raise SceneError(
            f"its asset.minVersion is {quoted(least)}; glTF 2.0 is read: export it as 2.0"
        )

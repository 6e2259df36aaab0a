"""Gives the bytes of a file's buffers: its own chunk, a data URI, or a file in the same folder.

No file outside the folder is read, whatever the file names: no address, no absolute path, none
that climbs out by `..` or by a link.

Source: Khronos, glTF 2.0 specification, 2.8 (URIs) and 3.6.1 (buffers and buffer views).
"""

from __future__ import annotations

import base64
import binascii
from pathlib import Path, PureWindowsPath
from urllib.parse import unquote, unquote_to_bytes, urlsplit

from ...scene import SceneError
from .document import Document, Thing, short
from .extensions import DECODED_NOT, MESHOPT
from .notes import Notes


class Buffers:
    """The buffers of one file, each read once it is asked for."""

    def __init__(
        self, document: Document, folder: Path, binary: memoryview | None, notes: Notes
    ) -> None:
        self._document = document
        self._folder = folder
        self._binary = binary
        self._notes = notes
        self._read: dict[int, memoryview] = {}

    def view(self, number: int, asker: str) -> tuple[Thing, memoryview]:
        """Return a buffer view and its bytes.

        Raises
        ------
        SceneError
            If it is not there, reaches beyond its buffer, or has no data.
        """
        view = self._document.thing("bufferViews", number, asker)
        compressed = next((name for name in MESHOPT if view.extension(name)), None)
        buffer = self._buffer(view.whole("buffer"), view.label, compressed)
        if compressed:
            self._notes.add(DECODED_NOT, compressed)
        start, size = view.whole("byteOffset", 0), view.whole("byteLength")
        if start + size > len(buffer):
            raise SceneError(
                f"{view.label} ends at byte {start + size} of a buffer of {len(buffer)} bytes"
            )
        return view, buffer[start : start + size]

    def _buffer(self, number: int, asker: str, compressed: str | None) -> memoryview:
        if number not in self._read:
            buffer = self._document.thing("buffers", number, asker)
            self._read[number] = self._bytes(buffer, number, asker, compressed)
        return self._read[number]

    def _bytes(self, buffer: Thing, number: int, asker: str, compressed: str | None) -> memoryview:
        uri = buffer.content.get("uri")
        size = buffer.whole("byteLength")
        if uri is None and number == 0 and self._binary is not None:
            data = self._binary
        elif uri is None and compressed:
            raise SceneError(
                f"{asker} is compressed by {compressed}, which is not decoded, and has no plain "
                "data beside it: export it without compression"
            )
        elif not isinstance(uri, str):
            raise SceneError(f"{buffer.label} has no data: neither a uri nor a chunk of its own")
        elif uri[:5].lower() == "data:":
            data = _data(uri, buffer.label)
        else:
            data = _file(self._folder, uri, size, buffer.label)
        if len(data) < size:
            raise SceneError(f"{buffer.label} is cut off: it has {len(data)} of {size} bytes")
        return data[:size]  # it may be padded


def _data(uri: str, label: str) -> memoryview:
    """Return the bytes of a data URI (RFC 2397)."""
    head, comma, body = uri.partition(",")
    if not comma:
        raise SceneError(f"{label} has a data URI without a comma, which has no data")
    if not head.lower().endswith(";base64"):
        return memoryview(unquote_to_bytes(body))
    try:
        return memoryview(base64.b64decode(unquote(body), validate=True))
    except (binascii.Error, ValueError) as error:
        raise SceneError(f"{label} has a data URI that is no base64: {error}") from error


def _file(folder: Path, uri: str, size: int, label: str) -> memoryview:
    """Return the first bytes of a file in the folder, or below it."""
    shown = short(uri)
    try:
        parts = urlsplit(uri)
        named = unquote(uri, errors="strict")
        # A drive or a server of Windows is not even asked for, nor where it means nothing.
        is_address = bool(parts.scheme or parts.netloc or PureWindowsPath(named).anchor)
        path = folder if is_address else (folder / named).resolve()
        is_inside = path.is_relative_to(folder.resolve())
        is_file = not is_address and is_inside and path.is_file()
    except (OSError, ValueError, RuntimeError):  # no name of a file; RuntimeError: links in circles
        raise SceneError(f"{label} names '{shown}', which is no name of a file") from None
    if is_address or not is_inside:
        raise SceneError(
            f"{label} names '{shown}', which is not in the folder of the file: "
            "copy it there, and name it by a relative path"
        )
    if not is_file:
        raise SceneError(f"{label} names the file '{shown}', which is not there")
    with path.open("rb") as file:  # `read` would first take the memory that it is asked for
        return memoryview(file.read(min(size, path.stat().st_size)))

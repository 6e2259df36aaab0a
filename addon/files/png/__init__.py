"""Writes and reads PNG files with zlib and numpy alone.

References
----------
W3C, "Portable Network Graphics (PNG) Specification", third edition. Its sections are named where
they are followed. Chunks that say more of colour (gAMA, iCCP, ...) are not applied, but told of.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...arrays import Array, Bytes
from .said import remarks
from .samples import CHANNELS, GREY, PALETTE, RGB, RGBA, Header, PngError, in_channels, unpacked

SIGNATURE = b"\x89PNG\r\n\x1a\n"
LEVEL = 6  # of zlib's compression: 9 takes several times as long for a few per cent
NOISY = 4  # of a picture that is full of holes: in a third of the time, a tenth larger

_DEPTHS = {GREY: (1, 2, 4, 8, 16), RGB: (8, 16), PALETTE: (1, 2, 4, 8)}
_TEXTS = b"tEXt", b"zTXt", b"iTXt"  # each begins with a keyword (11.3.3)
_SEVERAL = {b"IDAT", b"sPLT", *_TEXTS}  # chunks that may be there more than once (5.6)


@dataclass(frozen=True, eq=False)
class Samples:
    """The pixels of a PNG."""

    values: Array  # (h, w, c) uint8 or uint16, row 0 on top; 1 or 3 channels, and alpha if any
    levels: int  # the value that stands for 1: 255 for 8 bits, and for a palette
    has_alpha: bool
    notes: frozenset[str]  # the keywords of the texts in the file
    remarks: tuple[str, ...]  # what the file says of its pixels that is not applied


def encode(picture: Bytes, level: int = LEVEL) -> bytes:
    """Return an (h, w, 4) uint8 picture, row 0 at the bottom, as the content of a PNG file.

    It has 8 bits a channel, and no filter: flat colours are smaller without. `level` is zlib's.
    """
    return _encoded(picture, RGBA, level)


def encode_grey(picture: Bytes) -> bytes:
    """Return an (h, w) uint8 picture likewise, as one of grey values."""
    return _encoded(picture, GREY, LEVEL)


def _encoded(picture: Bytes, kind: int, level: int) -> bytes:
    height, width = picture.shape[:2]
    # Each row begins with 0: it is not filtered.
    rows = np.zeros((height, 1 + CHANNELS[kind] * width), np.uint8)
    rows[:, 1:] = picture[::-1].reshape(height, -1)
    header = struct.pack(">2I5B", width, height, 8, kind, 0, 0, 0)
    out = [SIGNATURE]
    for chunk in (b"IHDR" + header, b"IDAT" + zlib.compress(rows, level), b"IEND"):
        out += struct.pack(">I", len(chunk) - 4), chunk, struct.pack(">I", zlib.crc32(chunk))
    return b"".join(out)


def header_of(content: bytes) -> Header:
    """Return what the first bytes of a file, 33 or more, say of the picture.

    Raises
    ------
    PngError
        If they do not begin a PNG.
    """
    if not content.startswith(SIGNATURE):
        raise PngError("it is no PNG file")
    kind, body = next(_chunks(content), (b"", b""))
    if kind != b"IHDR" or len(body) != 13:
        raise PngError("its header is damaged")
    width, height, depth, color, packed, filtered, interlaced = struct.unpack(">2I5B", body)
    is_known = color in CHANNELS and depth in _DEPTHS.get(color, (8, 16))
    if not (width and height and is_known) or packed or filtered or interlaced > 1:
        raise PngError("its header is damaged")
    return Header(width, height, depth, color, bool(interlaced))


def decode(content: bytes) -> Samples:
    """Return the pixels of a PNG file: of every colour type and depth, interlaced or not.

    Raises
    ------
    PngError
        If it is no PNG, a damaged one, or has a critical chunk that is not known.
    """
    header = header_of(content)
    parts: dict[bytes, list[bytes]] = {}
    end = len(SIGNATURE)
    for kind, body in _chunks(content):
        parts.setdefault(kind, []).append(body)
        end += 12 + len(body)
    texts = (text for kind in _TEXTS for text in parts.get(kind, ()))
    notes = frozenset(text.partition(b"\0")[0].decode("latin-1") for text in texts)
    if b"IEND" not in parts:
        raise PngError("it is cut off")
    chunks = {k: b"".join(bodies) if k in _SEVERAL else bodies[0] for k, bodies in parts.items()}
    repeated = {kind for kind, bodies in parts.items() if len(bodies) > 1} - _SEVERAL
    stored = unpacked(header, chunks.get(b"IDAT", b""))
    values, levels, has_alpha = in_channels(header, chunks, stored)
    said = tuple(remarks(header, chunks, repeated, len(content) - end))
    return Samples(values, levels, has_alpha, notes, said)


def _chunks(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield the name and the content of each chunk that is whole, to the last one (5.3)."""
    at, kind = len(SIGNATURE), b""
    while kind != b"IEND" and at + 12 <= len(content):
        (size,) = struct.unpack_from(">I", content, at)
        end = at + 12 + size
        if end > len(content):
            return
        kind, body = content[at + 4 : at + 8], content[at + 8 : end - 4]
        (sum_,) = struct.unpack_from(">I", content, end - 4)
        if sum_ != zlib.crc32(content[at + 4 : end - 4]):
            raise PngError(f"its chunk {kind.decode('ascii', 'replace')} is damaged")
        yield kind, body
        at = end

"""PNG files by the letter of the specification."""

from __future__ import annotations

import struct
import zlib


def chunk(kind, content):
    body = kind + content
    return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))


def png_file(path, size, depth, kind, rows, *chunks, interlaced=0, filtered=False):
    """Write a PNG by the letter of its specification, rows as bytes from the top."""
    header = struct.pack(">2I5B", *size, depth, kind, 0, 0, interlaced)
    stored = zlib.compress(b"".join(b"\0" * (not filtered) + bytes(row) for row in rows))
    every = (b"IHDR", header), *chunks, (b"IDAT", stored), (b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*c) for c in every))

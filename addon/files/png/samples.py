"""The pixels of a PNG: unpacked, unfiltered, put in their places, and turned into channels.

References
----------
W3C, "Portable Network Graphics (PNG) Specification", third edition. Its sections are named where
they are followed.
"""

from __future__ import annotations

import sys
import zlib
from typing import NamedTuple

import numpy as np

from ...arrays import Array, Bytes

GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6  # colour types (11.2.1)
CHANNELS = {GREY: 1, RGB: 3, PALETTE: 1, GREY_ALPHA: 2, RGBA: 4}
_PAETH = 4  # the last of the filter types (9.2)
# The first column and row of each pass of an interlaced picture, and its steps (8.1).
_ADAM7 = (
    (0, 0, 8, 8),
    (4, 0, 8, 8),
    (0, 4, 4, 8),
    (2, 0, 4, 4),
    (0, 2, 2, 4),
    (1, 0, 2, 2),
    (0, 1, 1, 2),
)


class PngError(ValueError):
    """A file is no PNG, or a damaged one."""


class Header(NamedTuple):
    """The header of a PNG (11.2.1)."""

    width: int
    height: int
    depth: int  # bits a sample
    kind: int  # colour type
    interlaced: bool

    @property
    def bits(self) -> int:
        """The bits of a pixel."""
        return self.depth * CHANNELS[self.kind]

    def line(self, width: int) -> int:
        """Return the bytes of a row of some pixels, without its filter type."""
        return -(-width * self.bits // 8)


def unpacked(header: Header, packed: bytes) -> Array:
    """Return the samples of all pixels, (h, w, c) as they are stored (8, 9, 10)."""
    passes = _ADAM7 if header.interlaced else ((0, 0, 1, 1),)
    sizes = [
        (len(range(x, header.width, dx)), len(range(y, header.height, dy)))
        for x, y, dx, dy in passes
    ]
    whole = sum(height * (1 + header.line(width)) for width, height in sizes if width)
    data = _inflated(packed, whole)
    shape = header.height, header.width, CHANNELS[header.kind]
    out = np.zeros(shape, np.uint16 if header.depth == 16 else np.uint8)
    at = 0
    for (x, y, dx, dy), (width, height) in zip(passes, sizes, strict=True):
        if width and height:
            rows = np.frombuffer(data, np.uint8, height * (1 + header.line(width)), at)
            at += rows.size
            lines = _unfiltered(rows.reshape(height, -1), max(header.bits // 8, 1))
            out[y::dy, x::dx] = _of_bytes(header, lines, width)
    return out


def _inflated(packed: bytes, size: int) -> bytes:
    """Return `size` bytes of zlib's; never more, whatever the stream holds."""
    reader = zlib.decompressobj()
    try:
        data = reader.decompress(packed, min(size, sys.maxsize))
    except zlib.error as error:
        raise PngError(f"its pixels are damaged ({error})") from error
    if len(data) < size:
        raise PngError("it has fewer pixels than it says")
    return data


def _unfiltered(rows: Bytes, step: int) -> Bytes:
    """Undo the filters of rows (h, 1 + n), the first byte of each its filter type (9.2).

    A byte is found from the one `step` bytes before it, the one above, and the one above that.
    Those with the same sum of row and column need nothing of one another, so that they are found
    together: an element of the flat array and the next one of such a diagonal are a row, less a
    column, apart.
    """
    kinds, height = rows[:, 0], len(rows)
    if (kinds > _PAETH).any():
        raise PngError("its pixels are damaged (an unknown filter)")
    if not kinds.any():
        return rows[:, 1:]
    count = (rows.shape[1] - 1) // step
    width = count + 1
    padded = np.zeros((height + 1, width, step), np.int16)  # zeros above, and on the left
    padded[1:, 1:] = rows[:, 1:].reshape(height, count, step)
    flat = padded.reshape(-1, step)
    for diagonal in range(height + count - 1):
        first, end = max(0, diagonal - count + 1), min(height, diagonal + 1)
        start = (first + 1) * width + diagonal - first + 1
        here = slice(start, start + (end - first - 1) * count + 1, count)
        left, above, corner = (
            flat[here.start - off : here.stop - off : count] for off in (1, width, width + 1)
        )
        flat[here] += _predicted(kinds[first:end, None], left, above, corner)
        flat[here] &= 255
    return padded[1:, 1:].astype(np.uint8).reshape(height, -1)


def _predicted(kinds: Bytes, left: Array, above: Array, corner: Array) -> Array:
    """Return what each filter takes a byte for, from its three neighbours (9.2, 9.4)."""
    a, b = above - corner, left - corner
    off_left, off_above, off_corner = np.abs(a), np.abs(b), np.abs(a + b)
    nearest = np.where(off_above <= off_corner, above, corner)
    paeth = np.where((off_left <= off_above) & (off_left <= off_corner), left, nearest)
    choices = np.zeros_like(left), left, above, (left + above) >> 1, paeth
    return np.choose(kinds, choices)


def _of_bytes(header: Header, lines: Bytes, width: int) -> Array:
    """Return the samples (h, w, c) of rows of bytes (7.2)."""
    shape = len(lines), width, CHANNELS[header.kind]
    if header.depth >= 8:
        return np.ascontiguousarray(lines).view(f">u{header.depth // 8}").reshape(shape)
    bits = np.unpackbits(lines, axis=1).reshape(len(lines), -1, header.depth)
    return np.packbits(bits[:, :width], axis=2).reshape(shape) >> (8 - header.depth)


def in_channels(
    header: Header, chunks: dict[bytes, bytes], samples: Array
) -> tuple[Array, int, bool]:
    """Return the samples as colours, their levels, and whether there is alpha (11.3.2.1)."""
    most = 2**header.depth - 1
    clear = chunks.get(b"tRNS")
    if header.kind == PALETTE:
        return _looked_up(chunks.get(b"PLTE", b""), clear, samples[..., 0])
    has_alpha = header.kind in (GREY_ALPHA, RGBA)
    if clear is not None and not has_alpha:
        if len(clear) != 2 * samples.shape[2]:
            raise PngError("its chunk tRNS is damaged")
        level = np.frombuffer(clear, ">u2") & most  # the other bits say nothing
        hole = (samples == level).all(axis=-1, keepdims=True)
        alpha = np.where(hole, 0, most).astype(samples.dtype)
        samples, has_alpha = np.concatenate((samples, alpha), axis=-1), True
    return samples, most, has_alpha


def _looked_up(palette: bytes, clear: bytes | None, index: Bytes) -> tuple[Array, int, bool]:
    """Return what :func:`in_channels` does, of indices (h, w) into a palette."""
    if not palette or len(palette) % 3 or len(palette) // 3 <= int(np.max(index)):
        raise PngError("its palette is damaged")
    table = np.frombuffer(palette, np.uint8).reshape(-1, 3)
    if clear is None:
        return table[index], 255, False
    alpha = np.full(len(table), 255, np.uint8)
    alpha[: len(clear)] = np.frombuffer(clear, np.uint8)[: len(table)]
    return np.column_stack((table, alpha))[index], 255, True

"""Notes on what a PNG says of its pixels and the reader does not apply.

All values are read by sRGB's curve.

References
----------
W3C, "Portable Network Graphics (PNG) Specification", third edition: 4.3 says which of the chunks
on colour counts, 11.3 what they hold, 5.4 what a reader has to understand.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping, Set

from ...wording import count_of
from .samples import PALETTE, Header, PngError

_CRITICAL = {b"IHDR", b"PLTE", b"IDAT", b"IEND"}
# Chunks that are applied or looked at here; then those that say nothing of the pixels.
_KNOWN = {b"tRNS", b"cICP", b"iCCP", b"sRGB", b"gAMA", b"cHRM", b"sBIT"}
_IDLE = {b"tIME", b"bKGD", b"hIST", b"sPLT"}
_OPTIONAL = 0x20  # of the first letter of a name, if it is small: not critical
_SAFE = 0x20  # of the last: it stays true whatever the pixels are, such as a text
_SRGB_CODES = bytes((1, 13, 0, 1))  # ITU-T H.273: BT.709's primaries, sRGB's curve, RGB, full range
_SRGB_GAMMA = 45455  # 1/2.2, in units of 1/100,000
# White, red, green, blue: x and y each, in the same units.
_SRGB_CHROMATICITIES = 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000
_ROUNDED = 10  # of these units: programs store them as they round them


def remarks(
    header: Header, chunks: Mapping[bytes, bytes], repeated: Set[bytes], more: int
) -> Iterator[str]:
    """Yield what is not applied, a sentence without its full stop each.

    Parameters
    ----------
    header : Header
    chunks : mapping
        The content of each kind, of several that of the first.
    repeated : set of bytes
        Kinds that are there more often than they may be.
    more : int
        Bytes behind the last chunk.

    Raises
    ------
    PngError
        If a chunk that a reader must understand is not known, or one of them is damaged.
    """
    telling = {kind for kind in chunks if not _is_idle(kind)}
    for kind in sorted(repeated & telling):
        if kind in _CRITICAL:
            raise PngError(f"it has more than one chunk {_name(kind)}")
        yield f"it has more than one chunk {_name(kind)}: the first one was read"
    if more:
        said = count_of(more, "byte behind its end is", "bytes behind its end are")
        yield f"{said} not read"
    unknown = sorted(telling - _CRITICAL - _KNOWN)
    for kind in unknown:
        if not kind[0] & _OPTIONAL:
            raise PngError(f"its chunk {_name(kind)} is not understood")
    try:
        yield from _of_color(chunks)
    except struct.error:
        raise PngError("a chunk on its colours is damaged") from None
    bits = 8 if header.kind == PALETTE else header.depth
    if (significant := min(chunks.get(b"sBIT", b""), default=bits)) < bits:
        yield f"only {significant} of {bits} bits of a sample count, as its chunk sBIT says"
    if unknown:
        names = ", ".join(map(_name, unknown))
        yield f"what its chunks {names} say is not understood, and passed over"


def _of_color(chunks: Mapping[bytes, bytes]) -> Iterator[str]:
    """Yield what the first kind of chunk that counts says of colours, if that is not sRGB."""
    read = "it was read by sRGB's curve"
    if codes := chunks.get(b"cICP"):
        if codes != _SRGB_CODES:
            yield f"its chunk cICP names other colours ({', '.join(map(str, codes))}): {read}"
    elif profile := chunks.get(b"iCCP"):
        yield f"its colour profile '{_name(profile.partition(bytes(1))[0])}' is not applied: {read}"
    elif b"sRGB" not in chunks:
        if gamma := chunks.get(b"gAMA"):
            (found,) = struct.unpack(">I", gamma)
            if abs(found - _SRGB_GAMMA) > _ROUNDED:
                yield f"its chunk gAMA says {found / 1e5:g}, sRGB is about {1 / 2.2:.5f}: {read}"
        if places := chunks.get(b"cHRM"):
            off = zip(struct.unpack(">8I", places), _SRGB_CHROMATICITIES, strict=True)
            if any(abs(own - srgb) > _ROUNDED for own, srgb in off):
                yield f"its chunk cHRM names other primaries than sRGB's: {read}"


def _is_idle(kind: bytes) -> bool:
    """Return whether a chunk says nothing of the pixels (5.4, 14.2)."""
    return kind in _IDLE or bool(kind[0] & _OPTIONAL and kind[3] & _SAFE)


def _name(kind: bytes) -> str:
    return kind.decode("latin-1")

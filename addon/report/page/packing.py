"""Arrays -> text that a page can carry, with zlib and base64 alone: Blender has no more.

The page's `data.js` unpacks what is packed here.
"""

from __future__ import annotations

import base64
import struct
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

_LEVEL = 6  # of zlib: 9 takes several times as long for a few per cent
_UP = 2  # PNG's filter: the difference from the row above
_RGBA = 6  # PNG's colour type


def packed(values: NDArray) -> dict[str, Any]:
    """Return an array as its type, its shape, and its bytes: all first ones, all second ones...

    So sorted, the exponents of neighbouring numbers stand side by side, and compress. The bytes of
    a number begin with the least; all are deflated (zlib) and in base64.
    """
    values = np.ascontiguousarray(values)
    values = values.astype(values.dtype.newbyteorder("<"), copy=False)
    planes = values.reshape(-1).view(np.uint8).reshape(-1, values.dtype.itemsize).T
    return {
        "type": values.dtype.name,
        "shape": list(values.shape),
        "data": _base64(zlib.compress(np.ascontiguousarray(planes), _LEVEL)),
    }


def size(value: Any) -> int:
    """Return how many letters the packed arrays in a value take."""
    if isinstance(value, dict):
        return sum(map(size, value.values()))
    return len(value) if isinstance(value, str) else 0


def png(picture: NDArray[np.uint8]) -> bytes:
    """Return an (h, w, 4) picture, row 0 at the bottom, as a PNG file.

    Source: the PNG specification, third edition (W3C): 8 bits a channel, every row filtered by its
    difference from the one above.
    """
    height, width = picture.shape[:2]
    rows = np.empty((height, 1 + 4 * width), np.uint8)
    rows[:, 0] = _UP
    flat = picture[::-1].reshape(height, -1)
    rows[0, 1:] = flat[0]
    rows[1:, 1:] = flat[1:] - flat[:-1]  # modulo 256, as the filter wants it
    header = struct.pack(">2I5B", width, height, 8, _RGBA, 0, 0, 0)
    parts = (b"IHDR", header), (b"IDAT", zlib.compress(rows, _LEVEL)), (b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*part) for part in parts)


def _chunk(kind: bytes, content: bytes) -> bytes:
    body = kind + content
    return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))


def data_uri(picture: NDArray[np.uint8]) -> str:
    """Return an (h, w, 4) picture, row 0 at the bottom, as the address of an image."""
    return f"data:image/png;base64,{_base64(png(picture))}"


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")

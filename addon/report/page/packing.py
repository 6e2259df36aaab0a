"""Arrays -> text within a page, and pictures -> addresses of images.

The page's `data.js` unpacks the arrays.
"""

from __future__ import annotations

import base64
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...images import png

_LEVEL = 6  # of zlib: 9 takes several times as long for a few per cent


def packed(values: NDArray) -> dict[str, Any]:
    """Return an array's type, its shape, and its bytes, deflated (zlib) and in base64.

    The first bytes of all numbers come first, then all second ones, and so on, so that the
    exponents of neighbouring numbers stand side by side and compress. Numbers are little-endian.
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
    """Return how many characters the packed arrays in a value take."""
    if isinstance(value, dict):
        return sum(map(size, value.values()))
    return len(value) if isinstance(value, str) else 0


def data_uri(picture: NDArray[np.uint8]) -> str:
    """Return an (h, w, 4) picture, row 0 at the bottom, as the address of an image."""
    return f"data:image/png;base64,{_base64(png(picture))}"


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")

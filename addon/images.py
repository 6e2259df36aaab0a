"""Arrays <-> picture files, and the way from linear colour to what a screen shows.

Pictures are (h, w, 4), row 0 at the bottom; files are written with their first row on top.
A PNG is written with zlib alone. The extra `images` has what the rest takes: Pillow reads a PNG,
OpenEXR reads and writes an EXR.
"""

from __future__ import annotations

import base64
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_LEVEL = 6  # of zlib: 9 takes several times as long for a few per cent
_UP = 2  # PNG's filter: the difference from the row above
_RGBA = 6  # PNG's colour type


class MissingLibraryError(RuntimeError):
    """An optional library is not installed; the message says how to get it."""


def to_display(color: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return what a screen shows of linear RGBA with premultiplied alpha, (h, w, 4) uint8.

    The transfer function is sRGB's (IEC 61966-2-1), Blender's view transform 'Standard'; values are
    cut off at 1, and what is not a number is black.
    """
    color = np.nan_to_num(np.asarray(color, dtype=np.float64), posinf=1.0, neginf=0.0)
    return np.rint(255 * encoded(color)).astype(np.uint8)


def encoded(color: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return linear premultiplied RGBA or RGB (..., 4 or 3) as sRGB's curve, straight, 0 to 1."""
    color = np.asarray(color, dtype=np.float64)
    alpha = np.clip(color[..., 3:], 0, 1)
    straight = color[..., :3]
    if color.shape[-1] == 4:
        straight = straight / np.where(alpha > 0, alpha, 1)
    return np.concatenate((curve(np.clip(straight, 0, 1)), alpha), axis=-1)


def decoded(stored: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return what :func:`encoded` was made of: linear RGBA or RGB, alpha premultiplied."""
    stored = np.asarray(stored, dtype=np.float64)
    linear, alpha = curve_undone(stored[..., :3]), stored[..., 3:]
    if stored.shape[-1] == 4:
        linear = linear * alpha
    return np.concatenate((linear, alpha), axis=-1)


def curve(linear: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return sRGB's transfer function (IEC 61966-2-1) of linear values, 0 to 1."""
    with np.errstate(invalid="ignore"):
        return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def curve_undone(stored: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return the linear values of which :func:`curve` makes the stored ones."""
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def save_png(path: str | Path, picture: NDArray[np.uint8]) -> None:
    """Write an (h, w, 4) uint8 sRGB picture, row 0 at the bottom.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    Path(path).write_bytes(png(picture))


def png(picture: NDArray[np.uint8]) -> bytes:
    """Return an (h, w, 4) uint8 sRGB picture, row 0 at the bottom, as the content of a PNG file.

    Source: the PNG specification, third edition (W3C): 8 bits a channel; every row is filtered by
    its difference from the one above.
    """
    height, width = picture.shape[:2]
    rows = np.empty((height, 1 + 4 * width), np.uint8)
    rows[:, 0] = _UP
    flat = picture[::-1].reshape(height, -1)
    rows[0, 1:] = flat[0]
    rows[1:, 1:] = flat[1:] - flat[:-1]  # modulo 256, as the filter wants it
    header = struct.pack(">2I5B", width, height, 8, _RGBA, 0, 0, 0)
    chunks = (b"IHDR", header), (b"IDAT", zlib.compress(rows, _LEVEL)), (b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*chunk) for chunk in chunks)


def data_uri(picture: NDArray[np.uint8]) -> str:
    """Return the same PNG as the address of an image in a page."""
    return f"data:image/png;base64,{base64.b64encode(png(picture)).decode('ascii')}"


def _chunk(kind: bytes, content: bytes) -> bytes:
    body = kind + content
    return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))


def save_exr(path: str | Path, passes: dict[str, NDArray]) -> None:
    """Write passes to one EXR: `color` as RGBA, the others as channels of a layer of their name.

    All channels are float32: an index above 2^24 is rounded (`frame.npz` has it whole).

    Raises
    ------
    MissingLibraryError
        If OpenEXR is not installed.
    """
    try:
        import OpenEXR
    except ImportError:
        raise _missing("EXR files", "OpenEXR") from None
    channels = {}
    for name, values in passes.items():
        if np.ndim(values) < 2:
            continue
        values = np.atleast_3d(values)
        letters = "RGBA" if name == "color" else "XYZ" if values.shape[2] == 3 else "V"
        for index, letter in enumerate(letters):
            key = letter if name == "color" else f"{name}.{letter}"
            channels[key] = np.ascontiguousarray(values[::-1, :, index], dtype=np.float32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    try:
        OpenEXR.File(header, channels).write(str(path))
    except RuntimeError as error:
        raise OSError(f"cannot write '{path}': {error}") from error


@dataclass(frozen=True, eq=False)
class StoredPicture:
    """A picture from a file."""

    color: NDArray[np.float32]  # (h, w, 4) linear RGBA, premultiplied alpha, row 0 at the bottom
    levels: int  # above 0 of sRGB's curve in which it was stored; 0 for floats
    opaque: bool  # the file has no alpha


def read_picture(path: str | Path) -> StoredPicture:
    """Read a PNG, of 8 bits and sRGB's curve, or an EXR.

    Raises
    ------
    MissingLibraryError
        If Pillow or OpenEXR is not installed.
    OSError
        If there is no such file, or it is no such picture.
    """
    path = Path(path)
    if not path.is_file():
        raise OSError(f"there is no file '{path}'")
    readers = {".png": _load_png, ".exr": _load_exr}
    if path.suffix.lower() not in readers:
        raise OSError(f"'{path}' is no picture that can be compared: it must be .png or .exr")
    return readers[path.suffix.lower()](path)


def _load_png(path: Path) -> StoredPicture:
    try:
        from PIL import Image
    except ImportError:
        raise _missing("PNG files", "Pillow") from None
    try:
        with Image.open(path) as image:
            if image.mode.startswith("I"):
                raise OSError(f"'{path}' has 16 bits a channel: save it with 8, or as an EXR")
            opaque = not (image.has_transparency_data or "A" in image.mode)
            stored = np.asarray(image.convert("RGBA"))[::-1]
    except (ValueError, SyntaxError) as error:
        raise OSError(f"'{path}' cannot be read: {error}") from error
    return StoredPicture(decoded(stored / 255).astype(np.float32), 255, opaque)


def _load_exr(path: Path) -> StoredPicture:
    try:
        import OpenEXR
    except ImportError:
        raise _missing("EXR files", "OpenEXR") from None
    try:
        with OpenEXR.File(str(path), separate_channels=True) as file:
            channels = {k: np.array(c.pixels, np.float32) for k, c in file.channels().items()}
    except (RuntimeError, OSError) as error:
        raise OSError(f"'{path}' cannot be read: {error}") from error
    if not {"R", "G", "B"} <= channels.keys():
        raise OSError(f"'{path}' has no channels R, G and B: {', '.join(sorted(channels))}")
    alpha = channels.get("A", np.ones_like(channels["R"]))
    color = np.stack((*(channels[c] for c in "RGB"), alpha), axis=-1)[::-1]
    return StoredPicture(np.ascontiguousarray(color), 0, "A" not in channels)


def _missing(what: str, library: str) -> MissingLibraryError:
    return MissingLibraryError(
        f"{what} need the library {library}: pip install 'reference_tracer[images]'"
    )

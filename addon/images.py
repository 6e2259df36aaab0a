"""Arrays <-> picture files, and the way from linear colour to what a screen shows.

Pictures are (h, w, 4), row 0 at the bottom; files are written with their first row on top.
PNG needs Pillow and EXR needs OpenEXR, the extra `images`; inside Blender, Blender writes them.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

SavePng = Callable[[Path, NDArray[np.uint8]], None]  # (h, w, 4) pictures, row 0 at the bottom


class MissingLibraryError(RuntimeError):
    """An optional library is not installed; the message says how to get it."""


def to_display(color: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return what a screen shows of linear RGBA with premultiplied alpha, (h, w, 4) uint8.

    The transfer function is sRGB's (IEC 61966-2-1), Blender's view transform 'Standard'; values are
    cut off at 1, and what is not a number is black.
    """
    color = np.nan_to_num(np.asarray(color, dtype=np.float64), posinf=1.0, neginf=0.0)
    alpha = np.clip(color[..., 3:], 0, 1)
    straight = np.clip(color[..., :3] / np.where(alpha > 0, alpha, 1), 0, 1)
    encoded = np.where(
        straight <= 0.0031308, 12.92 * straight, 1.055 * straight ** (1 / 2.4) - 0.055
    )
    return np.rint(255 * np.concatenate((encoded, alpha), axis=-1)).astype(np.uint8)


def save_png(path: str | Path, picture: NDArray[np.uint8]) -> None:
    """Write an (h, w, 4) uint8 picture.

    Raises
    ------
    MissingLibraryError
        If Pillow is not installed.
    """
    try:
        from PIL import Image
    except ImportError:
        raise _missing("PNG files", "Pillow") from None
    Image.fromarray(np.ascontiguousarray(picture[::-1])).save(path)


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
        values = np.asarray(values)
        if values.ndim < 2:
            continue
        if values.ndim == 2:
            values = values[..., None]
        letters = "RGBA" if name == "color" else "XYZ" if values.shape[2] == 3 else "V"
        for index, letter in enumerate(letters):
            key = letter if name == "color" else f"{name}.{letter}"
            channels[key] = np.ascontiguousarray(values[::-1, :, index], dtype=np.float32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    try:
        OpenEXR.File(header, channels).write(str(path))
    except RuntimeError as error:
        raise OSError(f"cannot write '{path}': {error}") from error


def _missing(what: str, library: str) -> MissingLibraryError:
    return MissingLibraryError(
        f"{what} need the library {library}: pip install 'reference_tracer[images]'"
    )

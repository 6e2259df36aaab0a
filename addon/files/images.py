"""Reads and writes picture files, and turns linear colours into what a screen shows.

Pictures are (h, w, 4), row 0 at the bottom; files are written with their first row on top.
A PNG takes zlib and numpy alone. An EXR takes OpenImageIO, the extra `images`.
"""

from __future__ import annotations

import base64
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Array, Bytes, Colors, Floats, by_runs, parts
from . import exr, png
from .file_kinds import mistaken
from .png.samples import PngError

EIGHT_BITS = 255  # levels above 0
_TOGETHER = 1 << 16  # pixels


def to_display(color: Floats) -> Bytes:
    """Return what a screen shows of linear RGBA with premultiplied alpha, (h, w, 4) uint8.

    The transfer function is sRGB's (IEC 61966-2-1), as of Blender's view transform 'Standard'.
    Values are cut off at 1, and NaN is black.
    """

    def shown(color: Array) -> Bytes:
        color = np.nan_to_num(color.astype(np.float64), posinf=1.0, neginf=0.0)
        return np.rint(EIGHT_BITS * encoded(color)).astype(np.uint8)

    flat = np.reshape(color, (-1, 4))
    out = np.empty(flat.shape, np.uint8)
    for some in parts(len(flat), _TOGETHER):  # temporaries of whole pictures take longer
        out[some] = by_runs(shown, flat[some])
    return out.reshape(np.shape(color))


def hex_color(linear: Sequence[float]) -> str:
    """Return a linear RGBA with premultiplied alpha as #rrggbb of sRGB."""
    return f"#{to_display(np.array(linear))[:3].tobytes().hex()}"


def encoded(color: Floats) -> Floats:
    """Return linear premultiplied RGBA or RGB, (..., 4 or 3), in sRGB's curve, straight, 0 to 1."""
    color = np.asarray(color, dtype=np.float64)
    alpha = np.clip(color[..., 3:], 0, 1)
    straight = color[..., :3]
    if color.shape[-1] == 4:
        straight = straight / np.where(alpha > 0, alpha, 1)
    return np.concatenate((curve(np.clip(straight, 0, 1)), alpha), axis=-1)


def decoded(stored: Floats) -> Floats:
    """Undo :func:`encoded`: return linear RGBA or RGB, alpha premultiplied."""
    stored = np.asarray(stored, dtype=np.float64)
    linear, alpha = curve_undone(stored[..., :3]), stored[..., 3:]
    if stored.shape[-1] == 4:
        linear = linear * alpha
    return np.concatenate((linear, alpha), axis=-1)


def curve(linear: Floats) -> Floats:
    """Return sRGB's transfer function (IEC 61966-2-1) of linear values, 0 to 1."""
    with np.errstate(invalid="ignore"):
        return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def curve_undone(stored: Floats) -> Floats:
    """Undo :func:`curve`: return the linear values of stored ones."""
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


def save_png(path: str | Path, picture: Bytes) -> None:
    """Write an (h, w, 4) uint8 sRGB picture, row 0 at the bottom.

    Raises
    ------
    OSError
        If the file cannot be written.
    """
    Path(path).write_bytes(png.encode(picture))


def data_uri(content: bytes) -> str:
    """Return the content of a PNG file as an image's address in a page."""
    return f"data:image/png;base64,{base64.b64encode(content).decode('ascii')}"


@dataclass(frozen=True, eq=False)
class StoredPicture:
    """A picture from a file."""

    color: Colors  # (h, w, 4) linear RGBA, premultiplied alpha, row 0 at the bottom
    # Above 0 of sRGB's curve in which it was stored; 0 for floats. At least 255: programs store
    # fewer bits where that loses nothing, and half a step of one bit would excuse any colour.
    levels: int
    opaque: bool  # the file has no alpha
    remarks: tuple[str, ...] = ()  # what the file says of its pixels that is not applied
    engine: str = ""  # of Blender, as the file's own header has it: 'cycles', 'other'; else ''


@dataclass(frozen=True)
class PictureFile:
    """A picture file: its header was read, but no pixel."""

    path: Path
    width: int
    height: int

    def read(self) -> StoredPicture:
        """Read the pixels.

        Raises
        ------
        OSError
            If they are damaged.
        """
        _, read = _FORMATS[self.path.suffix.lower()]
        return read(self.path)


def open_picture(path: str | Path) -> PictureFile:
    """Read the header of a PNG, of sRGB's curve, or of an EXR: its size is known before its pixels.

    Raises
    ------
    MissingLibraryError
        If it is an EXR, and OpenImageIO is not installed.
    OSError
        If there is no such file, or it is no such picture.
    """
    path = Path(path)
    if not path.is_file():
        raise OSError(f"there is no file '{path}', or it is a folder or a pipe")
    if (suffix := path.suffix.lower()) not in _FORMATS:
        raise OSError(f"'{path}' is no picture that can be compared: it must be .png or .exr")
    if said := mistaken(path):
        raise OSError(f"'{path}' {said}")
    size, _ = _FORMATS[suffix]
    return PictureFile(path, *size(path))


def _png_size(path: Path) -> tuple[int, int]:
    with path.open("rb") as file, _damage_named(path):
        header = png.header_of(file.read(33))
    return header.width, header.height


def _png_of(path: Path) -> StoredPicture:
    with _damage_named(path):
        stored = png.decode(path.read_bytes())
    values, most = stored.values[::-1], stored.levels
    linear = curve_undone(np.arange(most + 1) / most)  # of each level
    count = values.shape[2] - stored.has_alpha  # grey, or RGB
    color = np.empty((*values.shape[:2], 4), np.float32)
    for row, own in zip(color, values, strict=True):
        alpha = own[:, count:] / most if stored.has_alpha else 1.0
        row[:, :3] = linear[own[:, :count]] * alpha
        row[:, 3:] = alpha
    return StoredPicture(
        color,
        max(most, EIGHT_BITS),
        not stored.has_alpha,
        stored.remarks,
        engine_of(stored.notes),
    )


@contextmanager
def _damage_named(path: Path) -> Iterator[None]:
    """Add the file's name to the message of a damaged PNG."""
    try:
        yield
    except PngError as error:
        raise OSError(f"'{path}' cannot be read, save it again: {error}") from error


def _exr_of(path: Path) -> StoredPicture:
    color, opaque, notes = exr.read(path)
    return StoredPicture(color, 0, opaque, engine=engine_of(notes))


def engine_of(notes: Collection[str]) -> str:
    """Return which of Blender's engines made a picture; '' where Blender did not write the header.

    Blender notes the scene, the camera and how long it rendered; Cycles also notes its samples, for
    each layer. No other engine notes its name.
    """
    if not {"Scene", "Camera", "RenderTime"} <= set(notes):
        return ""
    return "cycles" if any(name.startswith("cycles.") for name in notes) else "other"


# What reads the size of a file, and what its pixels.
_FORMATS = {".png": (_png_size, _png_of), ".exr": (exr.size, _exr_of)}

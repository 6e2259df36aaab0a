"""Reads and writes EXR files by OpenImageIO, the extra `images`."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from ..arrays import Array, Colors, parts

_ROWS = 64  # written at a time: several of a file's blocks


class MissingLibraryError(RuntimeError):
    """An optional library is not installed; the message says how to get it."""


# Other programs' names of passes: OpenEXR reserves Z, renderers write N and P.
_AS_OTHERS = {"normal": "N", "position": "P"}
_LETTERS = {1: "V", 3: "XYZ", 4: "RGBA"}


def _channels(name: str, count: int) -> list[str]:
    """Return the names of a pass' channels."""
    if name == "depth":
        return ["Z"]
    letters = _LETTERS[count]
    return (
        list(letters) if name == "color" else [f"{_AS_OTHERS.get(name, name)}.{x}" for x in letters]
    )


def save(
    path: str | Path, passes: dict[str, Array], notes: Mapping[str, str] | None = None
) -> None:
    """Write passes to one EXR: `color` as RGBA, depth as Z, the others as channels of a layer.

    Normals are N.X, N.Y and N.Z, positions P.X and so on, others have their own name. `notes` are
    texts for the header, by their names.

    All channels are float32: an index above 2^24 is rounded (`frame.npz` has it whole).

    Raises
    ------
    MissingLibraryError
        If OpenImageIO is not installed.
    OSError
        If the file cannot be written.
    """
    oiio = _library()
    path = Path(path)
    pictures = {name: np.atleast_3d(v) for name, v in passes.items() if np.ndim(v) > 1}
    names = []
    for name, values in pictures.items():
        names += _channels(name, values.shape[2])
    height, width = next(iter(pictures.values())).shape[:2]
    spec = oiio.ImageSpec(width, height, len(names), "float")
    spec.channelnames = names
    spec.attribute("compression", "zip")
    spec.attribute("DateTime", "")  # the same frame makes the same file
    for note, text in (notes or {}).items():
        spec.attribute(note, text)
    file = oiio.ImageOutput.create(str(path))
    written = file and file.open(str(path), spec)
    for some in parts(height, _ROWS):
        first, end = some.start, some.stop
        rows = [v[height - end : height - first][::-1] for v in pictures.values()]
        part = np.concatenate(rows, axis=-1, dtype=np.float32, casting="unsafe")
        written = written and file.write_scanlines(first, end, 0, part)
    if not (written and file.close()):
        if shutil.disk_usage(path.parent).free < 1 << 20:  # the library does not say so
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        raise OSError(f"cannot write '{path.name}': {_error(file or oiio)}")


def size(path: Path) -> tuple[int, int]:
    """Return the width and the height that a file's header says; raises as :func:`read` does."""
    with _opened(path) as file:
        spec = file.spec()
        return spec.width, spec.height


def read(path: Path) -> tuple[Colors, bool, set[str]]:
    """Return what a file shows, (h, w, 4) linear RGBA with premultiplied alpha, row 0 below.

    Then whether it has no alpha, and the names of what its header notes.

    Raises
    ------
    MissingLibraryError
        If OpenImageIO is not installed.
    OSError
        If the file is damaged, or has no colours.
    """
    with _opened(path) as file:
        names = list(file.spec().channelnames)
        if not {"R", "G", "B"} <= set(names):
            raise OSError(f"'{path}' has no channels R, G and B: {', '.join(sorted(names))}")
        at = [names.index(c) for c in "RGBA" if c in names]
        stored = file.read_image(min(at), max(at) + 1, "float")
        if stored is None:
            raise OSError(f"'{path}' cannot be read, save it again: {_error(file)}")
        noted = {note.name for note in file.spec().extra_attribs}
    color = np.ones((*stored.shape[:2], 4), np.float32)
    color[..., : len(at)] = stored[::-1][..., np.subtract(at, min(at))]
    return color, len(at) == 3, noted


def read_channels(path: Path) -> dict[str, Array]:
    """Return every channel of a file by its name, (h, w) each, row 0 on top, in its own type.

    Half floats come as float16. Of several parts with a channel of one name, the first counts.

    Raises
    ------
    MissingLibraryError
        If OpenImageIO is not installed.
    OSError
        If the file is damaged.
    """
    out: dict[str, Array] = {}
    with _opened(path) as file:
        part = 0
        while file.seek_subimage(part, 0):
            spec = file.spec()
            for number, name in enumerate(spec.channelnames):
                of = str(spec.channelformat(number))
                values = file.read_image(part, 0, number, number + 1, of)
                if values is None:
                    raise OSError(f"'{path}' cannot be read, save it again: {_error(file)}")
                out.setdefault(name, values[..., 0] if values.ndim == 3 else values)
            part += 1
    return out


@contextmanager
def _opened(path: Path) -> Iterator[Any]:
    """Open an EXR; what the library would print stays unsaid."""
    oiio = _library()
    asked = oiio.ImageSpec()
    asked.attribute("oiio:UnassociatedAlpha", 1)
    with open(os.devnull, "wb") as nowhere, redirected(2, nowhere.fileno()):
        file = oiio.ImageInput.open(str(path), asked)
        if not file:
            raise OSError(f"'{path}' cannot be read, save it again: {_error(oiio)}")
        yield file


def _library() -> ModuleType:
    try:
        import OpenImageIO
    except ImportError:
        raise MissingLibraryError(
            'EXR files take the library OpenImageIO: pip install "reference_tracer[images]"'
        ) from None
    OpenImageIO.attribute("try_all_readers", 0)  # a JPEG that is named .exr is refused
    return OpenImageIO


def _error(of: Any) -> str:
    try:
        return " ".join(of.geterror().split())
    except UnicodeDecodeError:  # the message quotes what it read
        return "its header is damaged"


@contextmanager
def redirected(number: int, into: int) -> Iterator[None]:
    """Send what is written to a file descriptor, also by C libraries, to another for a while."""
    own = os.dup(number)
    os.dup2(into, number)
    try:
        yield
    finally:
        os.dup2(own, number)
        os.close(own)

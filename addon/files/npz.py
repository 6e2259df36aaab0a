"""Reads and writes .npy and .npz: no array but one that its header and the file's length bear out.

Both are read without pickle: they hold numbers and text, and nothing that runs. What they say of
their sizes is compared before anything is allocated: zeros are packed a thousandfold, so that a
small file could take all memory.
"""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import zip_longest
from pathlib import Path
from typing import IO, Any, NamedTuple
from zipfile import ZipFile

import numpy as np

from ..arrays import Array
from ..scene import SceneError
from ..tracer.memory import free_memory
from .file_kinds import check_is_file

# A file's arrays take at most so many times its own length, or so many bytes: what is small, such
# as a picture of nothing, may be packed as well as it can be.
PACKED, SMALL = 100, 1 << 28
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


class Header(NamedTuple):
    """The header of an array."""

    shape: tuple[int, ...]
    dtype: np.dtype[Any]


class Arrays(Mapping[str, Array]):
    """The arrays of an open .npz by their names; each is read on first use."""

    def __init__(self, stored: ZipFile, path: str | Path) -> None:
        """List the arrays; whatever else is in the archive is none."""
        self._stored = stored
        self.limit = max(SMALL, PACKED * os.path.getsize(path))  # bytes that they may take
        every = [info for info in stored.infolist() if info.filename.endswith(".npy")]
        self._infos = {info.filename.removesuffix(".npy"): info for info in every}
        if len(self._infos) < len(every):
            raise SceneError("an array is in it twice: write the file again")
        self.size = sum(info.file_size for info in every)

    def __iter__(self) -> Iterator[str]:
        return iter(self._infos)

    def __len__(self) -> int:
        return len(self._infos)

    def __getitem__(self, name: str) -> Array:
        self.header(name)
        with self._stored.open(self._infos[name]) as file:
            return np.lib.format.read_array(file, allow_pickle=False)

    def header(self, name: str) -> Header:
        """Return what an array says of itself, which its length bears out."""
        with self._stored.open(self._infos[name]) as file:
            return _header(file, name, self._infos[name].file_size)

    def checked(self, name: str, shape: str, kinds: str = "fiu") -> Array:
        """Return an array of one of numpy's kinds, and of this shape: n is any number.

        Raises
        ------
        SceneError
            If there is none, or it is another one.
        """
        if name not in self._infos:
            raise SceneError(f"it has no array '{name}': `reftrace export` writes a scene with all")
        own, dtype = self.header(name)
        fits = all(n == str(m) or (n == "n" and m is not None) for n, m in zip_longest(shape, own))
        if not fits or dtype.kind not in kinds:
            raise SceneError(f"{name} holds {own} of {dtype}, not ({', '.join(shape)}) numbers")
        return self[name]


@contextmanager
def opened(path: str | Path) -> Iterator[Arrays]:
    """Open an .npz; what goes wrong in the block is the file's fault, too, and names it.

    Raises
    ------
    SceneError
        If there is no such file, it is none, or it would take more memory than it may.
    """
    with _named(path), ZipFile(path) as stored:
        arrays = Arrays(stored, path)
        if arrays.size > arrays.limit:
            raise SceneError(
                f"its arrays would take {arrays.size / 2**30:.1f} GiB, more than {PACKED} times "
                "the file: if that is right, write it without compression, by numpy.savez"
            )
        if arrays.size > 1 << 20 and arrays.size > (free_memory() or arrays.size):
            raise SceneError(f"it takes {arrays.size / 2**30:.1f} GiB, more than is free")
        yield arrays


def load_npy(path: str | Path) -> Array:
    """Read an .npy; raises what :func:`opened` raises."""
    with _named(path), open(path, "rb") as file:
        _header(file, "its array", os.path.getsize(path))
        file.seek(0)
        return np.lib.format.read_array(file, allow_pickle=False)


def save(path: str | Path, arrays: Mapping[str, Array]) -> None:
    """Write arrays to an .npz, compressed where that may be read."""
    for write in (np.savez_compressed, np.savez):
        with open(path, "wb") as file:  # given a name, numpy would add .npz to one in capitals
            write(file, **arrays)  # type: ignore[arg-type]  # none is "allow_pickle"
        with ZipFile(path) as stored:
            written = Arrays(stored, path)
        if written.size <= written.limit:
            return


def _header(file: IO[bytes], name: str, length: int) -> Header:
    """Read an array's header, from a file that is so long."""
    version = np.lib.format.read_magic(file)
    if version not in _HEADERS:
        raise SceneError(f"{name} is of numpy's format {version}, not 1.0 or 2.0")
    shape, _, dtype = _HEADERS[version](file)
    if dtype.hasobject:
        raise SceneError(f"{name} holds objects of Python, not numbers")
    if math.prod(shape) * dtype.itemsize != length - file.tell():
        raise SceneError(f"{name} is not as long as it says: write the file again")
    return Header(shape, dtype)


@contextmanager
def _named(path: str | Path) -> Iterator[None]:
    """Name the file in whatever goes wrong, and keep numpy's warnings from the user."""
    check_is_file(path)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")  # of headers that an older numpy wrote
            yield
    except SceneError as error:
        raise SceneError(f"'{path}': {error}") from error
    except Exception as error:  # zip, zlib, numpy, JSON: each has its own ways to say no
        say = f"'{path}' is cut off or damaged: copy it again, or write it again ({error})"
        raise SceneError(say) from error

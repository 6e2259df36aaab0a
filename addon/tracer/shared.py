"""A scene and a frame in memory that several processes share: no array is sent from one to another.

In comes a scene, or the camera of a frame; out goes a ticket, small enough to be sent, with which
another process opens the same arrays. A block of memory lives as long as somebody has arrays in it
and, on the systems that name it, until whoever made it has let it go.
"""

from __future__ import annotations

import io
import math
import os
import pickle
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from multiprocessing.shared_memory import SharedMemory
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene import Camera, Region, Scene, ViewWindow
from .frame import BYTES_PER_PIXEL, Frame
from .memory import check_memory

_ALIGNED = 64  # bytes: arrays begin where cache lines do
_SHARED = Path("/dev/shm")  # where Linux keeps shared memory, of which containers may have little

Span = tuple[int, int]  # first byte, number of bytes


@dataclass(frozen=True)
class SceneTicket:
    """A scene without its arrays, as bytes, and where those are: in which block, and its spans."""

    rest: bytes
    block: str
    spans: tuple[Span, ...]

    def open(self) -> Scene:
        """Return the scene; its arrays can be read only."""
        memory = SharedMemory(self.block)
        arrays = [_view(memory, first, (size,), np.uint8) for first, size in self.spans]
        for array in arrays:
            array.flags.writeable = False
        return pickle.loads(self.rest, buffers=arrays)


@dataclass(frozen=True)
class FrameTicket:
    """Where the arrays of a frame are."""

    block: str

    def open(self, scene: Scene) -> Frame:
        """Return the frame of a scene; rows are to be cleared (:func:`clear`) before tracing."""
        return _frame(scene, SharedMemory(self.block))


class Blocks:
    """Blocks of shared memory that this process has made, until it lets them go."""

    def __init__(self) -> None:
        self._blocks: list[SharedMemory] = []

    def reserve(self, size: int) -> SharedMemory:
        """Make a block of zeros.

        Raises
        ------
        OSError
            If there is not enough shared memory.
        """
        if _SHARED.is_dir():  # the system would end the process that writes what there is not
            about = os.statvfs(_SHARED)
            free = about.f_bavail * about.f_frsize
            if size > free:
                raise OSError(
                    f"several processes need {size >> 20:,} MiB of shared memory, of which "
                    f"{free >> 20:,} MiB are free: enlarge {_SHARED}, or trace with one process"
                )
        self._blocks.append(SharedMemory(create=True, size=max(size, 1)))
        return self._blocks[-1]

    def let_go(self) -> None:
        """Take their names from the blocks: they end with the last array in them.

        They are not closed, which would take the memory from under the arrays.
        """
        while self._blocks:
            with suppress(FileNotFoundError):
                self._blocks[-1].unlink()
            self._blocks.pop()


def share_scene(scene: Scene, blocks: Blocks) -> SceneTicket:
    """Copy a scene's arrays into a new block.

    Raises
    ------
    OSError
        If there is not enough shared memory.
    """
    parts: list[memoryview] = []
    file = io.BytesIO()
    _Pickler(file, 5, buffer_callback=lambda buffer: parts.append(buffer.raw())).dump(scene)
    spans, size = [], 0
    for part in parts:
        spans.append((size, part.nbytes))
        size += -(-part.nbytes // _ALIGNED) * _ALIGNED
    memory = blocks.reserve(size)
    _fill(memory, parts, spans)
    return SceneTicket(file.getvalue(), memory.name, tuple(spans))


def share_frame(scene: Scene, blocks: Blocks) -> tuple[FrameTicket, Frame]:
    """Make a frame in a new block; its rows are not cleared yet.

    Raises
    ------
    PictureTooLargeError, OSError
        If there is not enough memory, or not enough shared memory.
    """
    region = scene.camera.region
    check_memory(region.width, region.height, BYTES_PER_PIXEL)
    memory = blocks.reserve(max(first + count for _, first, *_, count in _layout(region)))
    return FrameTicket(memory.name), _frame(scene, memory)


def clear(frame: Frame, rows: slice | NDArray[np.bool_]) -> None:
    """Make rows as :meth:`Frame.empty` has them; in a new block all bytes are zero."""
    for name, value in _empty_pixel().items():
        if value.any():
            getattr(frame, name)[rows] = value.ravel()[0]


class _Pickler(pickle.Pickler):
    """One that leaves every array to the buffers, also those that are not contiguous."""

    def reducer_override(self, item: Any) -> Any:
        if type(item) is np.ndarray and not item.flags.forc:
            return np.ascontiguousarray(item).__reduce_ex__(5)
        return NotImplemented


class _Held:
    """An array to be, of a block that it keeps: what it is made into ends before the block does."""

    def __init__(self, memory: SharedMemory, first: int, shape: tuple, dtype: Any) -> None:
        self._memory = memory
        address = np.frombuffer(memory.buf, np.uint8).ctypes.data + first
        kind = np.dtype(dtype).str
        self.__array_interface__ = dict(data=(address, False), shape=shape, typestr=kind, version=3)


def _view(memory: SharedMemory, first: int, shape: tuple[int, ...], dtype: Any) -> NDArray:
    return np.asarray(_Held(memory, first, shape, dtype))


def _fill(memory: SharedMemory, parts: list[memoryview], spans: list[Span]) -> None:
    path = _SHARED / memory.name
    if not path.exists():
        for part, (first, count) in zip(parts, spans, strict=True):
            memory.buf[first : first + count] = part
        return
    with path.open("r+b") as file:  # which takes half as long as to touch new pages one by one
        for part, (first, _) in zip(parts, spans, strict=True):
            file.seek(first)
            file.write(part)


def _frame(scene: Scene, memory: SharedMemory) -> Frame:
    layout = _layout(scene.camera.region)
    return Frame(scene, **{name: _view(memory, *where) for name, *where, _ in layout})


def _layout(region: Region) -> list[tuple[str, int, tuple[int, ...], np.dtype, int]]:
    """Return name, first byte, shape, dtype and number of bytes of the arrays of a frame."""
    out, first, size = [], 0, (region.height, region.width)
    for name, value in _empty_pixel().items():
        shape = (*size[: value.ndim], *value.shape[2:])
        count = math.prod(shape) * value.itemsize
        out.append((name, first, shape, value.dtype, count))
        first += -(-count // _ALIGNED) * _ALIGNED
    return out


@cache
def _empty_pixel() -> dict[str, NDArray]:
    """Return the arrays of an empty frame of one pixel, by name."""
    return Frame.empty(Scene(Camera(np.eye(4), ViewWindow(-1, 1, -1, 1), 1, 1))).arrays()

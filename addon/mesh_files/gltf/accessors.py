"""Turns accessors into arrays: every component type, strides, sparse and normalised numbers.

Sizes are checked against the bytes that are there, and against free memory, before anything is
allocated.

Source: Khronos, glTF 2.0 specification, 3.6.2; KHR_mesh_quantization for the normalised integers.
"""

from __future__ import annotations

import math

import numpy as np

from ...arrays import Array, Floats, Index
from ...scene import SceneError
from ...tracer.memory import free_memory
from .buffers import Buffers
from .document import Document, Thing, quoted

_COMPONENTS: dict[int, np.dtype[np.generic]] = {  # little-endian, by the file's number
    5120: np.dtype("i1"),
    5121: np.dtype("u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
_UNSIGNED = 5121, 5123, 5125
_WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}  # the types that a shape is made of


class Accessors:
    """The arrays of one file, each made once: primitives often share one."""

    def __init__(self, document: Document, buffers: Buffers) -> None:
        self._document = document
        self._buffers = buffers
        self._read: dict[int, Array] = {}

    def floats(self, number: int, asker: str, kind: str) -> Floats:
        """Return the numbers of an accessor, with integers that are normalised made fractions.

        Parameters
        ----------
        asker
            What names the accessor, for messages.
        kind
            Its type: "VEC3", "VEC4", "MAT4".

        Returns
        -------
        (n, width) float32 as stored, or float64 of integers

        Raises
        ------
        SceneError
            If it is of another type, reaches beyond its data, or is not finite.
        """
        accessor = self._of_kind(number, asker, kind)
        values = self._values(number, accessor)
        if values.dtype.kind == "f":
            if not np.isfinite(values).all():
                row = int(np.flatnonzero(~np.isfinite(values).all(axis=1))[0])
                raise SceneError(
                    f"{accessor.label} holds numbers that are not finite, in row {row}"
                )
            return values
        check_fits(8 * values.size, accessor.label)
        if not accessor.flag("normalized", False):
            return values.astype(np.float64)
        # f = max(c / 127, -1) of a signed byte, c / 255 of an unsigned one.
        return np.maximum(values / np.iinfo(values.dtype).max, -1.0)

    def whole_numbers(self, number: int, asker: str, kind: str, packed: bool) -> Index:
        """Return unsigned integers, (n, width), as stored.

        `packed` says that no stride is allowed, as of indices.
        """
        accessor = self._of_kind(number, asker, kind)
        if accessor.whole("componentType") not in _UNSIGNED:
            raise accessor.wrong("componentType", f"one of {_UNSIGNED} where {asker} names it")
        return self._values(number, accessor, packed)

    def length(self, number: int, asker: str) -> int:
        """Return how many rows an accessor has."""
        return self._document.thing("accessors", number, asker).whole("count")

    def is_empty(self, number: int, asker: str) -> bool:
        """Return whether an accessor has no data of its own, so that all of it is zero."""
        accessor = self._document.thing("accessors", number, asker)
        return "bufferView" not in accessor.content and "sparse" not in accessor.content

    def _of_kind(self, number: int, asker: str, kind: str) -> Thing:
        accessor = self._document.thing("accessors", number, asker)
        if accessor.content.get("type") != kind:
            said = quoted(accessor.content.get("type"))
            raise SceneError(f"{accessor.label} is of type {said}, not {kind}, as {asker} needs it")
        return accessor

    def _values(self, number: int, accessor: Thing, packed: bool = False) -> Array:
        if number not in self._read:
            self._read[number] = self._array(accessor, packed)
        return self._read[number]

    def _array(self, accessor: Thing, packed: bool) -> Array:
        """Return the stored numbers, (n, width), of their own type."""
        code = accessor.whole("componentType")
        if code not in _COMPONENTS:
            raise accessor.wrong("componentType", f"one of {', '.join(map(str, _COMPONENTS))}")
        shape = accessor.whole("count"), _WIDTHS[accessor.content["type"]]
        if not shape[0]:
            raise accessor.wrong("count", "1 or more")
        base = accessor.refers("bufferView")
        sparse = accessor.part("sparse")
        viewed = None
        if base is not None:
            viewed = self._viewed(accessor, base, shape, _COMPONENTS[code], packed)
        check_fits(math.prod(shape) * 4, accessor.label)
        values = np.zeros(shape, _COMPONENTS[code]) if viewed is None else viewed.copy()
        if sparse is not None:
            self._replace(values, sparse)
        return values

    def _viewed(
        self,
        source: Thing,
        number: int,
        shape: tuple[int, int],
        dtype: np.dtype[np.generic],
        packed: bool,
    ) -> Array:
        """Return rows of a buffer view, without a copy, once they are known to lie in it."""
        view, data = self._buffers.view(number, source.label)
        start, size = source.whole("byteOffset", 0), shape[1] * dtype.itemsize
        stride = view.whole("byteStride", size)
        if stride < size or (packed and stride != size):
            raise SceneError(
                f"{view.label} has rows {stride} bytes apart, but {source.label} has {size} bytes "
                "in a row" + (" and must have nothing between them" if packed else "")
            )
        end = start + (shape[0] - 1) * stride + size
        if end > len(data):
            raise SceneError(
                f"{source.label} ends at byte {end} of {view.label}, which has {len(data)} bytes"
            )
        return np.ndarray(shape, dtype, data, start, (stride, dtype.itemsize))

    def _replace(self, values: Array, sparse: Thing) -> None:
        """Put the rows of a sparse accessor where it says."""
        indices, rows = sparse.part("indices"), sparse.part("values")
        count = sparse.whole("count")
        if indices is None or rows is None:
            raise SceneError(f"{sparse.label} has no 'indices' or no 'values'")
        if not 0 < count <= len(values):
            raise sparse.wrong("count", f"between 1 and {len(values)}")
        code = indices.whole("componentType")
        if code not in _UNSIGNED:
            raise indices.wrong("componentType", f"one of {_UNSIGNED}")
        at = self._viewed(
            indices, indices.whole("bufferView"), (count, 1), _COMPONENTS[code], packed=True
        )[:, 0].astype(np.int64)
        if at[-1] >= len(values) or (np.diff(at) <= 0).any():
            raise SceneError(f"{indices.label} must rise, and stay below {len(values)}")
        shape = count, values.shape[1]
        values[at] = self._viewed(rows, rows.whole("bufferView"), shape, values.dtype, packed=True)


def check_fits(size: int, what: str) -> None:
    """Refuse to allocate what does not fit into free memory.

    Raises
    ------
    SceneError
        It names what is too large. Systems kill who takes too much.
    """
    if size > 1 << 20 and size > (free_memory() or size):
        raise SceneError(f"{what} takes {size / 2**30:.1f} GiB, more than is free")

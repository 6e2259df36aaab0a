"""The numbers of random accessors are those that pygltflib's files hold, read one by one."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pygltflib
import pytest
from reference_tracer.mesh_files.gltf.accessors import Accessors
from reference_tracer.mesh_files.gltf.buffers import Buffers
from reference_tracer.mesh_files.gltf.container import open_container
from reference_tracer.mesh_files.gltf.notes import Notes

LETTERS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}
ACCESSORS = 40


def random_file(rng) -> pygltflib.GLTF2:
    """Return accessors of all types: with strides and offsets, sparse, normalised, without data."""
    file, data = pygltflib.GLTF2(), bytearray()

    def view(content: bytes, stride: int | None = None) -> int:
        data.extend(bytes(-len(data) % 4))
        start = len(data)
        data.extend(content)
        held = pygltflib.BufferView(
            buffer=0, byteOffset=start, byteLength=len(content), byteStride=stride
        )
        file.bufferViews.append(held)
        return len(file.bufferViews) - 1

    def packed(code: int, values: np.ndarray) -> bytes:
        return struct.pack(f"<{values.size}{LETTERS[code]}", *values.ravel().tolist())

    def values(code: int, shape: tuple[int, int]) -> np.ndarray:
        if code == 5126:
            return rng.normal(size=shape).astype(np.float32)
        low = 0 if code in (5121, 5123, 5125) else -(2 ** (8 * struct.calcsize(LETTERS[code]) - 1))
        return rng.integers(low, low + 2 ** (8 * struct.calcsize(LETTERS[code])), shape)

    for _ in range(ACCESSORS):
        code, kind = int(rng.choice(list(LETTERS))), str(rng.choice(list(WIDTHS)))
        count, width = int(rng.integers(1, 9)), WIDTHS[kind]
        size = width * struct.calcsize(LETTERS[code])
        accessor = pygltflib.Accessor(componentType=code, count=count, type=kind)
        accessor.normalized = bool(code not in (5125, 5126) and rng.random() < 0.5)
        if rng.random() < 0.8:
            offset = int(rng.integers(0, 3)) * 4
            gap = int(rng.integers(0, 3)) * 4 + -size % 4
            rows = values(code, (count, width))
            body = b"".join(packed(code, row) + bytes([77] * gap) for row in rows)
            accessor.byteOffset = offset
            accessor.bufferView = view(bytes([99] * offset) + body, size + gap if gap else None)
        if rng.random() < 0.4:
            few = int(rng.integers(1, count + 1))
            where = np.sort(rng.choice(count, few, replace=False))
            at = int(rng.choice([5121, 5123, 5125]))
            accessor.sparse = pygltflib.Sparse(
                count=few,
                indices=pygltflib.AccessorSparseIndices(
                    bufferView=view(packed(at, where)), componentType=at
                ),
                values=pygltflib.AccessorSparseValues(
                    bufferView=view(packed(code, values(code, (few, width))))
                ),
            )
        file.accessors.append(accessor)
    file.buffers = [pygltflib.Buffer(byteLength=len(data))]
    file.set_binary_blob(bytes(data))
    return file


def one_by_one(file: pygltflib.GLTF2, number: int) -> list[list[float]]:
    """Return an accessor's rows by the specification's words, with nothing but struct."""
    accessor, blob = file.accessors[number], file.get_data_from_buffer_uri(file.buffers[0].uri)
    letter, width = LETTERS[accessor.componentType], WIDTHS[accessor.type]
    one = struct.calcsize(letter)

    def row(view, start, form, length, k, stride=None):
        step = stride or struct.calcsize(form) * length
        at = (view.byteOffset or 0) + (start or 0) + k * step
        return list(struct.unpack_from(f"<{length}{form}", blob, at))

    rows = [[0] * width for _ in range(accessor.count)]
    if accessor.bufferView is not None:
        view = file.bufferViews[accessor.bufferView]
        stride = view.byteStride
        rows = [row(view, accessor.byteOffset, letter, width, k, stride) for k in range(len(rows))]
    if accessor.sparse is not None:
        places, moved = accessor.sparse.indices, accessor.sparse.values
        for k in range(accessor.sparse.count):
            form = LETTERS[places.componentType]
            (at,) = row(file.bufferViews[places.bufferView], places.byteOffset, form, 1, k)
            rows[at] = row(file.bufferViews[moved.bufferView], moved.byteOffset, letter, width, k)
    if accessor.normalized:
        most = 2 ** (8 * one - (accessor.componentType in (5120, 5122))) - 1
        rows = [[max(c / most, -1.0) for c in r] for r in rows]
    return rows


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
@pytest.mark.parametrize("seed", range(3))
def test_numbers(suffix, seed, tmp_path):
    made = random_file(np.random.default_rng((5, seed)))
    path: Path = tmp_path / f"a.{suffix}"
    if suffix == "gltf":
        made.convert_buffers(pygltflib.BufferFormat.DATAURI)
    made.save(str(path))
    judge = pygltflib.GLTF2().load(str(path))
    notes = Notes()
    container = open_container(path, notes)
    buffers = Buffers(container.document, path.parent, container.binary, notes)
    accessors = Accessors(container.document, buffers)
    for number, accessor in enumerate(judge.accessors):
        wanted = np.array(one_by_one(judge, number), np.float64)
        found = accessors.floats(number, "the test", accessor.type)
        assert found.dtype == (np.float32 if accessor.componentType == 5126 else np.float64)
        assert np.array_equal(found, wanted), number
        if accessor.componentType in (5121, 5123, 5125) and not accessor.normalized:
            whole = accessors.whole_numbers(number, "the test", accessor.type, packed=False)
            assert whole.tolist() == wanted.astype(np.int64).tolist()
    assert len(judge.accessors) == ACCESSORS and not notes.sentences()

"""Numbers and buffers of glTF files, each of its conventions in a small file."""

from __future__ import annotations

from urllib.parse import quote

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import read_gltf

from .gltf_build import INDICES, SQUARE, UNIT, Build, area, box, glb, read, sparse


class TestNumbers:
    @pytest.mark.parametrize("dtype", ["i1", "u1", "i2", "u2"])
    @pytest.mark.parametrize("normalized", [True, False])
    def test_quantised_positions(self, dtype, normalized, path):
        """KHR_mesh_quantization: the greatest integer is 1 where it is normalised."""
        build = Build()
        build.extension("KHR_mesh_quantization", required=True)
        most = np.iinfo(dtype).max
        padded = np.zeros((4, 4), dtype)
        padded[:, :3] = SQUARE * most
        mesh = build.mesh()
        position = build.json["accessors"][0]
        position |= {
            "bufferView": build.view(padded.tobytes(), byteStride=4 * padded.itemsize),
            "componentType": {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123}[dtype],
            "normalized": normalized,
        }
        build.scene(build.node(mesh=mesh))
        triangles, notes = read(build.write(path))
        assert box(triangles) == [[0, 0, 0], [1, 1, 0] if normalized else [most, most, 0]]
        assert not notes

    def test_the_least_signed_integer_is_minus_one(self, path):
        build = Build()
        values = np.array([(-128, -127, 0), (127, 0, 0), (0, 127, 64)], np.int8)
        mesh = build.mesh(values, None)
        build.json["accessors"][0]["normalized"] = True
        build.scene(build.node(mesh=mesh))
        triangles, _ = read(build.write(path))
        assert triangles[0].tolist() == [[-1, -1, 0], [1, 0, 0], [0, 1, 64 / 127]]

    def test_interleaved_with_an_offset(self, path):
        build = Build()
        mixed = np.full((4, 7), np.nan, np.float32)
        mixed[:, 2:5] = SQUARE
        view = build.view(bytes(8) + mixed.tobytes(), byteStride=28)
        mesh = build.mesh()
        build.json["accessors"][0] |= {"bufferView": view, "byteOffset": 16}
        build.scene(build.node(mesh=mesh))
        assert box(read(build.write(path))[0]) == UNIT

    @pytest.mark.parametrize("dtype", ["u1", "u2", "u4"])
    def test_sparse(self, dtype, path):
        """The corner at (1, 1) is moved to (5, 5)."""
        build = Build().shown()
        build.json["accessors"][0]["sparse"] = sparse(build, [2], [(5, 5, 0)], dtype)
        triangles, _ = read(build.write(path))
        assert area(triangles) == 5 and box(triangles) == [[0, 0, 0], [5, 5, 0]]

    def test_sparse_without_a_view_begins_with_zeros(self, path):
        build = Build().shown()
        del build.json["accessors"][0]["bufferView"]
        build.json["accessors"][0]["sparse"] = sparse(build, [1, 2], [(2, 0, 0), (2, 2, 0)])
        triangles, _ = read(build.write(path))
        assert area(triangles) == 2

    def test_an_integer_may_be_written_as_a_decimal(self, path):
        build = Build().shown()
        build.json["accessors"][0]["count"] = 4.0
        assert area(read(build.write(path))[0]) == 1

    def test_a_million_corners_without_data_are_no_trouble(self, path):
        """They are zeros, which the specification allows; the triangle has no area."""
        build = Build().shown()
        build.json["accessors"][0] = {"componentType": 5126, "count": 10**6, "type": "VEC3"}
        (placed,) = read_gltf(build.write(path)).placed
        assert not placed.mesh.vertices.any() and len(placed.mesh.triangles) == len(INDICES) // 3


class TestBuffers:
    @pytest.mark.parametrize("kind", ["application/octet-stream", "application/gltf-buffer", ""])
    def test_a_data_uri(self, kind, tmp_path):
        text = Build().shown().with_data_uri().replace("data:;", f"data:{kind};")
        (tmp_path / "a.gltf").write_text(text)
        assert area(read(tmp_path / "a.gltf")[0]) == 1

    def test_a_data_uri_without_base64(self, tmp_path):
        build = Build().shown()
        uri = "data:," + quote(bytes(build.data))
        build.json["buffers"] = [{"byteLength": len(build.data), "uri": uri}]
        (tmp_path / "a.glb").write_bytes(glb(build.json, b""))
        assert area(read(tmp_path / "a.glb")[0]) == 1

    @pytest.mark.parametrize("name", ["b.bin", "sub folder/größe%.bin", "./b.bin", "sub/../b.bin"])
    @pytest.mark.parametrize("encode", [True, False])
    def test_a_file_beside_it(self, name, encode, tmp_path):
        build = Build().shown()
        for folder in ("sub folder", "sub"):
            (tmp_path / folder).mkdir()
        (tmp_path / name).write_bytes(build.data + b"more than is needed")
        uri = quote(name) if encode else name.replace("%", "%25")
        build.json["buffers"] = [{"byteLength": len(build.data), "uri": uri}]
        (tmp_path / "a.glb").write_bytes(glb(build.json, b""))
        assert area(read(tmp_path / "a.glb")[0]) == 1

    def test_a_chunk_and_a_file(self, tmp_path):
        build = Build().shown()
        (tmp_path / "b.bin").write_bytes(build.data)
        build.json["buffers"] = [
            {"byteLength": len(build.data)},
            {"byteLength": len(build.data), "uri": "b.bin"},
        ]
        build.json["bufferViews"][1]["buffer"] = 1
        (tmp_path / "a.glb").write_bytes(glb(build.json, bytes(build.data) + b"long"))
        assert area(read(tmp_path / "a.glb")[0]) == 1

    def test_further_chunks_are_named(self, tmp_path):
        build = Build().shown()
        build.json["buffers"] = [{"byteLength": len(build.data)}]
        content = glb(build.json, bytes(build.data), (b"BIN\0", bytes(8)), (b"ABCD", bytes(4)))
        (tmp_path / "a.glb").write_bytes(content + b"tail")
        triangles, notes = read(tmp_path / "a.glb")
        assert area(triangles) == 1
        assert any("BIN, ABCD" in n for n in notes) and any("4 bytes follow" in n for n in notes)

    def test_the_content_says_which_of_the_two_it_is(self, tmp_path):
        Build().shown().write(tmp_path / "a.glb").rename(tmp_path / "b.gltf")
        Build().shown().write(tmp_path / "a.gltf").rename(tmp_path / "b.glb")
        assert area(read(tmp_path / "b.gltf")[0]) == area(read(tmp_path / "b.glb")[0]) == 1

"""A glTF file that is cut off, or whose buffer is elsewhere, is refused in one line."""

from __future__ import annotations

import base64
import json
import os
import re

import pytest

from .gltf_build import Build, glb
from .gltf_wrong import refused, requiring


@pytest.mark.parametrize("length", [4, 11, 12, 16, 20, 300, -30, -1])
def test_a_glb_that_is_cut_off(length, tmp_path):
    path = Build().shown().write(tmp_path / "a.glb")
    path.write_bytes(path.read_bytes()[:length])
    refused(path, "cut off")


def test_a_chunk_beyond_the_end(tmp_path):
    content = bytearray(Build().shown().write(tmp_path / "a.glb").read_bytes())
    content[12:16] = b"\xff\xff\xff\x7f"
    (tmp_path / "a.glb").write_bytes(content)
    refused(tmp_path / "a.glb", "a chunk of 2147483647 bytes reaches beyond its end")


@pytest.mark.parametrize(
    "content, pattern",
    [
        (b"", "JSON cannot be read"),
        (b"{", "JSON cannot be read"),
        (b"[]", "is no object"),
        (b"\xff{}", "JSON cannot be read"),
        (b"[" * 100_000, "nested too deeply"),
        (b'{"asset": {"version": NaN}}', "holds NaN"),
        (b"glTF" + (1).to_bytes(4, "little") + (12).to_bytes(4, "little"), "version 1"),
        (glb({}, b"").replace(b"JSON", b"ABCD"), "does not begin with a chunk of JSON"),
        (b"\x80\x04\x95K.", "JSON cannot be read"),  # a pickle
    ],
)
def test_what_is_no_gltf(content, pattern, tmp_path):
    (tmp_path / "a.gltf").write_bytes(content)
    refused(tmp_path / "a.gltf", pattern)


def names_a_buffer(tmp_path, uri):
    """A file that would be read if its buffer were."""
    build = Build().shown()
    folder = tmp_path / "folder"
    folder.mkdir()
    (tmp_path / "outside.bin").write_bytes(build.data)
    (folder / "inside.bin").write_bytes(build.data[:10])
    os.symlink(tmp_path / "outside.bin", folder / "link.bin")
    os.symlink(folder / "circle.bin", folder / "circle.bin")
    os.mkfifo(folder / "pipe.bin")
    build.json["buffers"] = [{"byteLength": len(build.data), "uri": uri}]
    (folder / "a.gltf").write_text(json.dumps(build.json))
    return folder / "a.gltf"


@pytest.mark.parametrize(
    "uri",
    [
        "../outside.bin",
        "..%2Foutside.bin",
        "sub/../../outside.bin",
        "link.bin",
        "{outside}",
        "{address}",
        "FILE:{outside}",
        "https://example.org/outside.bin",
        "//example.org/outside.bin",
        "C:outside.bin",
        "C%3A/outside.bin",
        "%5C%5Cserver/share/outside.bin",
        "\\\\server\\share\\outside.bin",
    ],
)
def test_no_file_outside_of_the_folder_is_read(uri, tmp_path):
    outside = tmp_path / "outside.bin"
    uri = uri.format(outside=outside, address=outside.as_uri())
    refused(names_a_buffer(tmp_path, uri), "buffer 0 names .* not in the folder of the file")


@pytest.mark.parametrize(
    "uri, pattern",
    [
        ("none.bin", "names the file 'none.bin', which is not there"),
        ("pipe.bin", "names the file 'pipe.bin', which is not there"),
        ("", "names the file '', which is not there"),
        ("a%00b", "no name of a file"),
        ("a\0b", "no name of a file"),
        ("%ff", "no name of a file"),
        ("x" * 5000, "buffer 0 names"),
        ("circle.bin", "buffer 0 names"),
        ("inside.bin", "buffer 0 is cut off: it has 10 of 60 bytes"),
        (7, "buffer 0 has no data"),
        ("data:;base64,!!!!", "buffer 0 has a data URI that is no base64"),
        ("data:;base64", "buffer 0 has a data URI without a comma"),
        ("data:;base64," + base64.b64encode(bytes(9)).decode(), "it has 9 of 60 bytes"),
    ],
)
def test_a_buffer_that_is_not_there(uri, pattern, tmp_path):
    refused(names_a_buffer(tmp_path, uri), pattern)


def test_the_command_names_the_file(tmp_path, exit_code, capsys):
    build = Build().shown()
    requiring("KHR_draco_mesh_compression")(build)
    path = build.write(tmp_path / "a.glb")
    assert exit_code(["trace", str(path), "--out", str(tmp_path / "a.png")]) == 4
    said = capsys.readouterr().err
    assert re.search(r"a\.glb'.* KHR_draco_mesh_compression", said)

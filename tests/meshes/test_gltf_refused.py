"""A glTF file that is damaged, or whose buffer is elsewhere, is refused in one line, or read."""

from __future__ import annotations

import base64
import json
import os

import numpy as np
import pytest
from reference_tracer.scene import SceneError
from reference_tracer_meshes.load import load_meshes

from .gltf_build import SQUARE, Build, glb


def refused(path, pattern=""):
    with pytest.raises(SceneError, match=pattern) as found:
        load_meshes(path)
    said = str(found.value)
    assert "\n" not in said and len(said) < 500 and path.name in said


@pytest.mark.parametrize("length", [4, 11, 12, 16, 20, 300, -30, -1])
def test_a_glb_that_is_cut_off(length, tmp_path):
    path = Build().shown().write(tmp_path / "a.glb")
    path.write_bytes(path.read_bytes()[:length])
    refused(path, "cut off|begin with")


@pytest.mark.parametrize(
    ("content", "pattern"),
    [
        (b"{", "JSON cannot be read"),
        (b"[]", "no 'asset'"),
        (b"\xff{}", "JSON cannot be read"),
        (b"[" * 100_000, "nested too deeply"),
        (b'{"asset": {"version": NaN}}', "holds NaN"),
        (b"glTF" + (1).to_bytes(4, "little") + (12).to_bytes(4, "little"), "version 1"),
        (glb({}, b"").replace(b"JSON", b"ABCD"), "does not begin with a chunk of JSON"),
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
        "C%3A/outside.bin",
        "%5C%5Cserver/share/outside.bin",
    ],
)
def test_no_file_outside_of_the_folder_is_read(uri, tmp_path):
    outside = tmp_path / "outside.bin"
    uri = uri.format(outside=outside, address=outside.as_uri())
    refused(names_a_buffer(tmp_path, uri), "not in the folder of the file")


@pytest.mark.parametrize(
    "uri",
    [
        *("none.bin", "pipe.bin", "", "a%00b", "%ff", "x" * 5000, "circle.bin", "inside.bin", 7),
        *("data:;base64,!!!!", "data:;base64"),
        "data:;base64," + base64.b64encode(bytes(9)).decode(),
    ],
)
def test_a_buffer_that_is_not_there(uri, tmp_path):
    refused(names_a_buffer(tmp_path, uri))


def edit(kind, /, **changes):
    return lambda build: build.json[kind][0].update(changes)


def primitive(**changes):
    return lambda build: build.json["meshes"][0]["primitives"][0].update(changes)


def indices(*values):
    return lambda build: primitive(indices=build.accessor(np.uint8(values)))(build)


WRONG = {
    "no asset": lambda b: b.json.pop("asset"),
    "a later version": lambda b: b.json.update(asset={"version": "2.1", "minVersion": "2.1"}),
    "required": lambda b: b.extension("ACME_inflate", required=True),
    "no such scene": lambda b: b.json.update(scene=4),
    "no such node": edit("scenes", nodes=[9]),
    "a node before the first": edit("scenes", nodes=[-1]),
    "no such mesh": edit("nodes", mesh=9),
    "no such accessor": primitive(indices=9),
    "no such view": edit("accessors", bufferView=9),
    "no such buffer": edit("bufferViews", buffer=9),
    "a circle": edit("nodes", children=[0]),
    "two parents": lambda b: [b.node(children=[0]), b.node(children=[0])],
    "nodes": lambda b: b.json.update(nodes=3),
    "a node": lambda b: b.json.update(nodes=["a"]),
    "true for a number": edit("nodes", mesh=True),
    "a short vector": edit("nodes", scale=[1, 2]),
    "an integer too long": edit("nodes", scale=[10**400, 1, 1]),
    "a projection": edit("nodes", matrix=[1] * 16),
    "no rotation": edit("nodes", rotation=[0, 0, 0, 0]),
    "a count too large": edit("accessors", count=10**12),
    "a count below zero": edit("accessors", count=-3),
    "a count without data": lambda b: b.json["accessors"].__setitem__(
        0, {"componentType": 5126, "count": 300_000_000, "type": "VEC3"}
    ),
    "a component": edit("accessors", componentType=5124),
    "a type": edit("accessors", type="VEC2"),
    "an offset": edit("accessors", byteOffset=4),
    "an offset below zero": edit("accessors", byteOffset=-4),
    "a stride": edit("bufferViews", byteStride=252),
    "a view too long": edit("bufferViews", byteLength=10**9),
    "a view longer than its file": edit("bufferViews", byteLength=3000),
    "a view below zero": edit("bufferViews", byteOffset=-48),
    "a buffer too long": lambda b: b.json.update(buffers=[{"byteLength": 10**12}]),
    "a NaN": lambda b: primitive(attributes={"POSITION": b.accessor(SQUARE * np.float32(np.nan))})(
        b
    ),
    "a mode": primitive(mode=7),
    "an index": indices(0, 1, 4),
    "four indices": indices(0, 1, 2, 3),
}
SAID = {
    "a type": "its positions are no vectors",
    "four indices": r"4 corners, .* threes",
    "a view too long": "number 0 of its bufferViews has the byteLength",
    "a view longer than its file": "number 0 of its bufferViews has the byteLength",
}


@pytest.mark.parametrize("name", WRONG)
def test_a_square_with_something_wrong(name, tmp_path):
    build = Build().shown()
    WRONG[name](build)
    refused(build.write(tmp_path / "a.glb"), SAID.get(name, ""))


class TestNotes:
    def test_animations_cameras_and_lights(self, tmp_path):
        build = Build().shown(camera=0)
        build.add("animations", channels=[], samplers=[])
        build.add("cameras", type="perspective")
        build.extension("KHR_lights_punctual", required=True)
        build.json["extensions"] = {"KHR_lights_punctual": {"lights": [{}, {}]}}
        found = load_meshes(build.write(tmp_path / "a.glb"))
        assert len(found.placed) == 1 and found.missing == ()
        for word, note in zip(("Animations", "1 camera", "Lights"), found.notes, strict=True):
            assert word in note

    @pytest.mark.parametrize("listed", [True, False])
    def test_an_extension_that_nobody_knows_is_missing(self, listed, tmp_path):
        build = Build().shown(extensions={"ACME_inflate": {"by": 3}})
        if listed:
            build.extension("ACME_inflate")
        (lacking,) = load_meshes(build.write(tmp_path / "a.glb")).missing
        assert "ACME_inflate" in lacking and "not known" in lacking

    def test_the_plain_data_beside_draco_s_is_read(self, tmp_path):
        build = Build().shown()
        build.extension("KHR_draco_mesh_compression")
        extension = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
        primitive(extensions=extension)(build)
        assert len(load_meshes(build.write(tmp_path / "a.glb")).placed[0].mesh.triangles) == 2


@pytest.mark.parametrize(
    ("change", "pattern"),
    [
        ({"byteStride": 4}, "byteStride is 4"),
        ({"byteLength": 1 << 20}, "byteLength 1,048,576|behind its buffer"),
        ({"byteOffset": 52}, "behind its buffer"),
        ({"buffer": 3}, "buffers"),
    ],
)
def test_a_view_that_is_not_in_its_buffer_or_whose_rows_overlap(change, pattern, tmp_path):
    build = Build().shown()
    last = build.json["bufferViews"][-1]
    for view in build.json["bufferViews"]:
        if "byteStride" in change or "buffer" in change or view is last:
            view.update(change)
    refused(build.write(tmp_path / "a.gltf"), pattern)

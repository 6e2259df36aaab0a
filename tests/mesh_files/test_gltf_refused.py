"""What cannot be read rightly is refused in one line that names the thing in the file."""

from __future__ import annotations

import base64
import json
import os
import re

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import read_gltf
from reference_tracer.scene import SceneError

from .gltf_build import INDICES, SQUARE, Build, glb, inverse_binds, skinned


def refused(path, pattern):
    with pytest.raises(SceneError, match=pattern) as found:
        read_gltf(path)
    assert "\n" not in str(found.value) and len(str(found.value)) < 300


def edit(kind, /, **changes):
    """Change the first of a list of the file's things."""

    def change(build):
        build.json[kind][0] |= changes

    return change


def primitive(**changes):
    def change(build):
        build.json["meshes"][0]["primitives"][0] |= changes

    return change


def whole(**changes):
    def change(build):
        build.json |= changes

    return change


def sparse(**changes):
    """Make the positions sparse, with something wrong."""

    def change(build):
        parts = {
            "count": 2,
            "indices": {"bufferView": build.view(bytes([1, 2])), "componentType": 5121},
            "values": {"bufferView": build.view(bytes(24))},
        }
        build.json["accessors"][0]["sparse"] = parts | changes

    return change


def positions(values, **more):
    def change(build):
        number = build.accessor(values, **more)
        build.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = number

    return change


def indices(*values, dtype=np.uint8, **more):
    def change(build):
        number = build.accessor(np.array(values, dtype), **more)
        build.json["meshes"][0]["primitives"][0]["indices"] = number

    return change


def instanced(**attributes):
    def change(build):
        held = {key: build.accessor(np.float32(values)) for key, values in attributes.items()}
        extension = {"EXT_mesh_gpu_instancing": {"attributes": held}}
        build.json["nodes"][0]["extensions"] = extension

    return change


def requiring(*names):
    def change(build):
        for name in names:
            build.extension(name, required=True)

    return change


def far(build):
    below = build.node(translation=[0, 1e300, 0], scale=[1e300] * 3)
    build.json["nodes"][below]["children"] = [0]
    build.json["nodes"][0]["scale"] = [1e300] * 3
    build.json["scenes"] = [{"nodes": [below]}]


REFUSED = {
    "no asset": (lambda b: b.json.pop("asset"), "no 'asset'"),
    "version 1": (whole(asset={"version": "1.0"}), "asset.version is '1.0'"),
    "version missing": (whole(asset={}), "asset.version is None"),
    "a later version": (whole(asset={"version": "2.1", "minVersion": "2.1"}), "minVersion"),
    "required": (requiring("ACME_inflate"), "requires ACME_inflate, .* does not apply"),
    "draco": (requiring("KHR_draco_mesh_compression"), "compressed by KHR_draco_mesh_compression"),
    "meshopt": (requiring("EXT_meshopt_compression"), "compressed by EXT_meshopt_compression"),
    "names": (whole(extensionsUsed=[7]), "extensionsUsed .* list of names"),
    "no such scene": (whole(scene=4), "the file names scene 4, and the file has 1"),
    "no such node": (edit("scenes", nodes=[9]), "scene 0 names node 9, and the file has 1"),
    "no such child": (edit("nodes", children=[9]), "node 0 names node 9"),
    "no such mesh": (edit("nodes", mesh=9), "node 0 names mesh 9, and the file has 1"),
    "no such skin": (edit("nodes", skin=0), "node 0 names skin 0, and the file has 0"),
    "no such accessor": (primitive(indices=9), "primitive 0 of mesh 0 names accessor 9"),
    "no such view": (edit("accessors", bufferView=9), "accessor 0 names buffer view 9"),
    "no such buffer": (edit("bufferViews", buffer=9), "buffer view 0 names buffer 9"),
    "a circle": (edit("nodes", children=[0], name="Loop"), "node 0 'Loop' descends from itself"),
    "two parents": (
        lambda b: [b.node(children=[0]), b.node(children=[0])],
        "node 0 is a child of both node 1 and node 2",
    ),
    "nodes": (whole(nodes=3), "the file has the nodes 3, which must be a list"),
    "a node": (whole(nodes=["a"]), "node 0 is 'a', which must be an object"),
    "a text for a number": (edit("nodes", mesh="0"), "node 0 has the mesh '0', .* an integer"),
    "true for a number": (edit("nodes", mesh=True), "node 0 has the mesh True, .* an integer"),
    "half a number": (edit("nodes", mesh=0.5), "node 0 has the mesh 0.5, .* an integer"),
    "below zero": (edit("nodes", mesh=-1), "node 0 has the mesh -1, .* not negative"),
    "a short vector": (edit("nodes", scale=[1, 2]), r"node 0 has the scale \[1, 2\], .* 3 finite"),
    "an endless vector": (edit("nodes", scale=[1e999, 1, 1]), "JSON cannot be read .*Infinity"),
    "an integer too long": (edit("nodes", scale=[10**400, 1, 1]), "node 0 has the scale"),
    "a projection": (edit("nodes", matrix=[1] * 16), "node 0 has a matrix whose fourth row"),
    "no rotation": (edit("nodes", rotation=[0, 0, 0, 0]), "node 0 has a rotation of length 0"),
    "too far": (far, "node 0 is placed or scaled beyond"),
    "visible": (
        edit("nodes", extensions={"KHR_node_visibility": {"visible": 1}}),
        "'KHR_node_visibility' of 'extensions' of node 0 has the visible 1, .* true or false",
    ),
    "a count too large": (edit("accessors", count=10**12), "accessor 0 ends at byte 1200"),
    "a count of none": (edit("accessors", count=0), "accessor 0 has the count 0, .* 1 or more"),
    "a count without data": (
        lambda b: b.json["accessors"].__setitem__(
            0, {"componentType": 5126, "count": 2**52, "type": "VEC3"}
        ),
        "accessor 0 takes .* GiB, more than is free",
    ),
    "a component": (edit("accessors", componentType=5124), "accessor 0 has the componentType 5124"),
    "a type": (edit("accessors", type="VEC2"), "accessor 0 is of type 'VEC2', not VEC3"),
    "an offset": (edit("accessors", byteOffset=4), "accessor 0 ends at byte 52 of buffer view 0"),
    "a stride": (edit("bufferViews", byteStride=8), "buffer view 0 has rows 8 bytes apart"),
    "a wide stride": (edit("bufferViews", byteStride=252), "ends at byte 768 of buffer view 0"),
    "a view too long": (
        edit("bufferViews", byteLength=10**9),
        "buffer view 0 ends at byte 1000000",
    ),
    "a buffer too long": (
        whole(buffers=[{"byteLength": 10**12}]),
        "buffer 0 is cut off: it has 60 of 1000000000000 bytes",
    ),
    "a view into the padding": (
        whole(buffers=[{"byteLength": 59}]),
        "buffer view 1 ends at byte 60 of a buffer of 59 bytes",
    ),
    "a second buffer": (
        lambda b: (
            b.json.update(buffers=[{"byteLength": 60}, {"byteLength": 60}]),
            b.json["bufferViews"][0].update(buffer=1),
        ),
        "buffer 1 has no data",
    ),
    "a NaN": (positions(SQUARE * np.float32(np.nan)), "accessor 2 holds .* not finite, in row 0"),
    "no attributes": (
        lambda b: b.json["meshes"][0]["primitives"][0].pop("attributes"),
        "primitive 0 of mesh 0 has no 'attributes'",
    ),
    "a mode": (primitive(mode=7), "primitive 0 of mesh 0 has the mode 7, .* between 0 and 6"),
    "an index": (indices(0, 1, 4), "primitive 0 of mesh 0 has the index 4, and 4 corners"),
    "a restart": (indices(0, 1, 255), "the index 255, which starts a strip anew"),
    "a long restart": (indices(0, 1, 2**32 - 1, dtype=np.uint32), "starts a strip anew"),
    "signed indices": (indices(0, 1, 2, dtype=np.int8), "accessor 2 has the componentType 5120"),
    "four indices": (indices(0, 1, 2, 3), "has 4 indices, which make no triangles"),
    "a short fan": (lambda b: (indices(0, 1)(b), primitive(mode=6)(b)), "has 2 indices"),
    "sparse too many": (sparse(count=5), "'sparse' of accessor 0 has the count 5, .* 1 and 4"),
    "sparse very many": (sparse(count=10**12), "'sparse' of accessor 0 has the count"),
    "sparse none": (sparse(count=0), "'sparse' of accessor 0 has the count 0"),
    "sparse nowhere": (sparse(values=None), "'values' of 'sparse' of accessor 0 is None"),
    "sparse short": (sparse(count=3), "ends at byte 3 of buffer view 2, which has 2 bytes"),
    "sparse signed": (
        sparse(indices={"bufferView": 0, "componentType": 5120}),
        "'indices' of 'sparse' of accessor 0 has the componentType 5120",
    ),
    "sparse falling": (
        lambda b: sparse(indices={"bufferView": b.view(bytes([2, 1])), "componentType": 5121})(b),
        "'indices' of 'sparse' of accessor 0 must rise, and stay below 4",
    ),
    "sparse twice": (
        lambda b: sparse(indices={"bufferView": b.view(bytes([2, 2])), "componentType": 5121})(b),
        "must rise, and stay below 4",
    ),
    "sparse outside": (
        lambda b: sparse(indices={"bufferView": b.view(bytes([2, 4])), "componentType": 5121})(b),
        "must rise, and stay below 4",
    ),
    "weights": (edit("nodes", weights=[1, 2]), "node 0 has 2 weights for 0 morph targets"),
    "a short target": (
        lambda b: (
            primitive(targets=[{"POSITION": b.accessor(SQUARE[:3])}])(b),
            edit("meshes", weights=[1])(b),
        ),
        "morph target 0 of primitive 0 of mesh 0 has 3 corners, not 4",
    ),
    "targets that differ": (
        lambda b: b.json["meshes"][0]["primitives"].append(
            {"attributes": {"POSITION": 0}, "targets": [{}]}
        ),
        "mesh 0 has primitives with different numbers of morph targets",
    ),
    "a target too far": (
        lambda b: (
            primitive(targets=[{"POSITION": 0}] * 2)(b),
            edit("meshes", weights=[1.7e308, 1.7e308])(b),
        ),
        "primitive 0 of mesh 0 is moved beyond",
    ),
    "no places": (instanced(), "node 0 has instances whose places are missing"),
    "different places": (
        instanced(TRANSLATION=SQUARE, SCALE=SQUARE[:2]),
        "node 0 has instances whose places differ in number",
    ),
    "no turns": (instanced(ROTATION=np.zeros((2, 4))), "node 0 has a rotation of length 0"),
    "draco alone": (
        lambda b: (
            edit("accessors", type="VEC3")(b),
            b.json["accessors"][0].pop("bufferView"),
            primitive(extensions={"KHR_draco_mesh_compression": {}})(b),
        ),
        "primitive 0 of mesh 0 is compressed by KHR_draco_mesh_compression",
    ),
    "draco's weights alone": (
        lambda b: primitive(
            attributes={
                "POSITION": 0,
                "WEIGHTS_0": b.add("accessors", componentType=5126, count=4, type="VEC4"),
            },
            extensions={"KHR_draco_mesh_compression": {}},
        )(b),
        "primitive 0 of mesh 0 is compressed by KHR_draco_mesh_compression",
    ),
    "meshopt alone": (
        lambda b: (
            b.json.update(buffers=[{"byteLength": 60}, {"byteLength": 60}]),
            b.json["bufferViews"][0].update(
                buffer=1, extensions={"EXT_meshopt_compression": {"buffer": 0}}
            ),
        ),
        "buffer view 0 is compressed by EXT_meshopt_compression",
    ),
}


@pytest.mark.parametrize("change, pattern", REFUSED.values(), ids=REFUSED)
def test_a_square_with_something_wrong(change, pattern, tmp_path):
    build = Build().shown()
    change(build)
    refused(build.write(tmp_path / "a.glb"), pattern)


def test_indices_with_something_between_them(tmp_path):
    build = Build().shown()
    build.json["bufferViews"][1]["byteStride"] = 4
    refused(build.write(tmp_path / "a.glb"), "rows 4 bytes apart.* nothing between")


def joints(values, name="JOINTS_0"):
    def change(build):
        attributes = build.json["meshes"][0]["primitives"][0]["attributes"]
        attributes[name] = build.accessor(values)

    return change


SKINS = {
    "no joints": (edit("skins", joints=[]), "skin 0 has no joints"),
    "no such joint": (edit("skins", joints=[0, 9]), "skin 0 names node 9"),
    "a joint outside": (
        joints(np.array([(2, 0, 0, 0)] * 4, np.uint8)),
        "joint 2, and skin 0 has 2",
    ),
    "float joints": (joints(np.ones((4, 4), np.float32)), "has the componentType 5126"),
    "few joints": (joints(np.zeros((3, 4), np.uint8)), "joints and weights that differ in number"),
    "half a set": (joints(np.zeros((4, 4), np.uint8), "JOINTS_1"), "JOINTS_1 without WEIGHTS_1"),
    "no set": (
        lambda b: primitive(attributes={"POSITION": 0})(b),
        "primitive 0 of mesh 0 is shown with a skin, but has no JOINTS_0",
    ),
    "few matrices": (
        lambda b: edit("skins", inverseBindMatrices=inverse_binds(b, (0, 0, 0)))(b),
        "skin 0 has 2 joints, but 1 inverse bind matrices",
    ),
    "a projecting matrix": (
        lambda b: edit("skins", inverseBindMatrices=b.accessor(np.ones((2, 16), np.float32)))(b),
        "skin 0 has a matrix whose fourth row",
    ),
    "instances": (
        lambda b: edit(
            "nodes",
            extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}},
        )(b),
        "node 0 has instances and a skin",
    ),
}


@pytest.mark.parametrize("change, pattern", SKINS.values(), ids=SKINS)
def test_a_skin_with_something_wrong(change, pattern, tmp_path):
    build = skinned()
    change(build)
    refused(build.write(tmp_path / "a.glb"), pattern)


def test_fourth_rows_that_float32_has_rounded(tmp_path):
    build = skinned()
    number = inverse_binds(build, (0, 0, 0), (0, 0, 0))
    build.json["skins"][0]["inverseBindMatrices"] = number
    start = build.json["bufferViews"][build.json["accessors"][number]["bufferView"]]["byteOffset"]
    build.data[start + 60 : start + 64] = np.float32(0.9999999).tobytes()
    assert read_gltf(build.write(tmp_path / "a.glb")).placed


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


def test_a_million_corners_without_data_are_no_trouble(tmp_path):
    """They are zeros, which the specification allows; the triangle has no area."""
    build = Build().shown()
    build.json["accessors"][0] = {"componentType": 5126, "count": 10**6, "type": "VEC3"}
    (placed,) = read_gltf(build.write(tmp_path / "a.glb")).placed
    assert not placed.mesh.vertices.any() and len(placed.mesh.triangles) == len(INDICES) // 3

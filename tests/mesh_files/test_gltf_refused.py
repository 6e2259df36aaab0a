"""What cannot be read rightly is refused in one line that names the thing in the file."""

from __future__ import annotations

import numpy as np
import pytest

from .gltf_build import SQUARE, Build, inverse_binds, skinned
from .gltf_wrong import (
    edit,
    indices,
    instanced,
    positions,
    primitive,
    refused,
    requiring,
    sparse,
    whole,
)


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

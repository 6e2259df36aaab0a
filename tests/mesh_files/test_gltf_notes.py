"""What of a glTF file is not shown is named, and what alters no shape needs no word."""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import read_gltf

from .gltf_build import UNIT, Build, area, box, read, skinned


class TestNotes:
    def test_animations_cameras_and_lights(self, path):
        build = Build().shown()
        for name in ("Walk", "Run", "Jump", "Sit"):
            build.add("animations", name=name, channels=[], samplers=[])
        build.add("cameras", type="perspective")
        build.extension("KHR_lights_punctual", required=True)
        build.json["extensions"] = {"KHR_lights_punctual": {"lights": [{}, {}]}}
        triangles, notes = read(build.write(path))
        assert area(triangles) == 1 and len(notes) == 3
        assert "Walk, Run, Jump and 1 more" in notes[0]
        assert "has 1" in notes[1] and "has 2" in notes[2]

    @pytest.mark.parametrize("listed", [True, False])
    def test_an_extension_that_nobody_knows(self, listed, path):
        build = Build().shown(extensions={"ACME_inflate": {"by": 3}})
        if listed:
            build.extension("ACME_inflate")
        (lacking,) = read_gltf(build.write(path)).missing
        assert "ACME_inflate" in lacking and "not known" in lacking

    @pytest.mark.parametrize(
        "name", ["KHR_texture_transform", "KHR_materials_unlit", "KHR_lights_punctual"]
    )
    def test_an_extension_that_leaves_the_shape_alone(self, name, path):
        build = Build().shown()
        build.extension(name, required=True)
        triangles, notes = read(build.write(path))
        assert area(triangles) == 1 and not notes

    def test_the_plain_data_beside_draco_s(self, path):
        build = Build().shown()
        build.extension("KHR_draco_mesh_compression")
        extension = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}
        build.json["meshes"][0]["primitives"][0]["extensions"] = extension
        triangles, (note,) = read(build.write(path))
        assert area(triangles) == 1
        assert "plain data" in note and "KHR_draco_mesh_compression" in note

    @pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
    def test_the_plain_data_beside_meshopt_s(self, name, path):
        build = Build().shown()
        build.extension(name)
        build.json["bufferViews"][0]["extensions"] = {name: {"buffer": 0, "byteLength": 4}}
        triangles, (note,) = read(build.write(path))
        assert area(triangles) == 1 and "plain data" in note and name in note

    def test_a_version_that_2_0_is_enough_for(self, path):
        build = Build().shown()
        build.json["asset"] = {"version": "2.1", "minVersion": "2.0"}
        assert area(read(build.write(path))[0]) == 1

    def test_a_name_is_said_once(self, path):
        build = skinned((0.5, 0, 0, 0))
        mesh = build.json["meshes"][0]
        mesh["primitives"] += [{"mode": 0, "attributes": {"POSITION": 0}}] * 2
        notes = read(build.write(path))[1]
        assert len(notes) == 2 and all(note.count("mesh 0") == 1 for note in notes)

    def test_a_rotation_that_is_too_long(self, path):
        triangles, (note,) = read(Build().shown(rotation=[0, 0, 2, 0], name="N").write(path))
        assert box(triangles) == [[-1, -1, 0], [0, 0, 0]]
        assert "length 1" in note and "node 0 'N'" in note


def test_what_a_node_has_beside_its_matrix_is_named(tmp_path):
    matrix = np.eye(4).ravel().tolist()
    path = Build().shown(matrix=matrix, translation=[5, 0, 0]).write(tmp_path / "a.gltf")
    triangles, notes = read(path)
    assert box(triangles) == UNIT
    assert notes == (
        "Nodes have a matrix, and parts of one beside it, which are not used: node 0.",
    )

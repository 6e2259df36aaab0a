"""Morph targets, skins and instances of glTF files are applied, each feature in a small file.

The right area and place are worked out from the rules of the specification, by hand.
"""

from __future__ import annotations

import numpy as np
import pytest
from reference_tracer.mesh_files.gltf import read_gltf

from .gltf_build import UNIT, Build, area, box, corners, inverse_binds, moved, read, skinned, sparse

HALF = np.sqrt(0.5)


class TestMorphTargets:
    def build(self, *weights, own=None, **node) -> Build:
        build = Build()
        targets = [
            {"POSITION": build.accessor(np.broadcast_to(np.float32(move), (4, 3)).copy())}
            for move in ((2, 0, 0), (0, 8, 0))
        ]
        mesh = build.mesh(targets=targets)
        if own is not None:
            build.json["meshes"][mesh]["weights"] = own
        build.scene(*(build.node(mesh=mesh, **({"weights": w} if w else {})) for w in weights))
        return build

    def test_default_weights_are_the_mesh_s(self, path):
        assert box(read(self.build(None, own=[1, 0.25]).write(path))[0]) == moved(2, 2)

    def test_the_node_s_come_first(self, path):
        build = self.build([0.5, 0], own=[1, 0.25])
        assert box(read(build.write(path))[0]) == moved(1)

    def test_without_weights_nothing_moves(self, path):
        assert box(read(self.build(None).write(path))[0]) == UNIT

    def test_each_pose_is_made_once(self, path):
        build = self.build([1, 0], [1, 0], [0, 1], [0, 0], None)
        placed = read_gltf(build.write(path)).placed
        assert [box(corners(p)) for p in placed] == [moved(2), moved(2), moved(0, 8), UNIT, UNIT]
        assert len({id(p.mesh) for p in placed}) == 3

    def test_a_target_that_moves_no_position(self, path):
        build = self.build([3, 0.5])
        build.json["meshes"][0]["primitives"][0]["targets"][0] = {}
        assert box(read(build.write(path))[0]) == moved(0, 4)

    def test_a_sparse_and_a_quantised_target(self, path):
        build = Build().shown(weights=[1, 10])
        corner = sparse(build, [2], [(4, 4, 0)])
        zeros = {"componentType": 5126, "type": "VEC3", "count": 4}
        down = np.array([(0, 0, -127)] * 4, np.int8)
        build.json["meshes"][0]["primitives"][0]["targets"] = [
            {"POSITION": build.add("accessors", **zeros, sparse=corner)},
            {"POSITION": build.accessor(down, normalized=True)},
        ]
        assert box(read(build.write(path))[0]) == [[0, 0, -10], [5, 5, -10]]


class TestSkins:
    def test_the_mesh_node_s_own_place_is_not_used(self, path):
        (placed,) = read_gltf(skinned().write(path)).placed
        assert box(corners(placed)) == moved(3) and (placed.world_from_object == np.eye(4)).all()

    def test_two_joints_are_mixed(self, path):
        assert box(read(skinned((0.75, 0.25, 0, 0)).write(path))[0]) == moved(2.25, 2.5)

    def test_inverse_bind_matrices_come_first(self, path):
        build = skinned()
        build.json["nodes"][1]["scale"] = [2, 2, 2]
        build.json["skins"][0]["inverseBindMatrices"] = inverse_binds(build, (-1, 0, 0), (0, 0, 0))
        triangles, _ = read(build.write(path))
        assert box(triangles) == [[1, 0, 0], [3, 2, 0]] and area(triangles) == 4

    def test_joints_hang_from_one_another_and_outside_of_the_scene(self, path):
        build = skinned((0, 1, 0, 0))
        root = build.node(children=[1], scale=[1, 1, 5], translation=[0, 0, 7])
        build.json["nodes"][1]["children"] = [2]
        build.json["scenes"] = [{"nodes": [0]}]
        assert root == 3 and box(read(build.write(path))[0]) == moved(3, 10, 7)

    @pytest.mark.parametrize("dtype", ["u1", "u2"])
    def test_normalised_weights_and_wide_joints(self, dtype, path):
        build = skinned()
        most = np.iinfo(dtype).max
        attributes = build.json["meshes"][0]["primitives"][0]["attributes"]
        weights = np.array([(most // 5, most - most // 5, 0, 0)] * 4, dtype)
        attributes["WEIGHTS_0"] = build.accessor(weights, normalized=True)
        attributes["JOINTS_0"] = build.accessor(np.array([(0, 1, 0, 0)] * 4, dtype))
        triangles, notes = read(build.write(path))
        assert np.allclose(box(triangles), moved(0.6, 8), atol=1e-14) and not notes

    def test_a_second_set_of_joints(self, path):
        build = skinned((0.5, 0, 0, 0))
        build.json["meshes"][0]["primitives"][0]["attributes"] |= {
            "JOINTS_1": build.accessor(np.array([(0, 0, 0, 1)] * 4, np.uint8)),
            "WEIGHTS_1": build.accessor(np.array([(0, 0, 0, 0.5)] * 4, np.float32)),
        }
        triangles, notes = read(build.write(path))
        assert box(triangles) == moved(1.5, 5) and not notes

    def test_weights_that_do_not_sum_to_one_are_used_and_named(self, path):
        """Half a weight is half of the joint's matrix: the square shrinks to a quarter."""
        triangles, notes = read(skinned((0.5, 0, 0, 0)).write(path))
        assert box(triangles) == [[1.5, 0, 0], [2, 0.5, 0]]
        (note,) = notes
        assert "do not sum to 1" in note
        assert "primitive 0 of mesh 0 (sums from 0.5 to 0.5)" in note

    def test_morph_targets_move_before_the_skin(self, path):
        build = skinned()
        build.json["nodes"][1]["scale"] = [2, 1, 1]
        target = build.accessor(np.array([(5, 0, 0)] * 4, np.float32))
        build.json["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": target}]
        build.json["meshes"][0]["weights"] = [1]
        assert box(read(build.write(path))[0]) == [[13, 0, 0], [15, 1, 0]]

    def test_a_mesh_that_is_shown_without_its_skin_too(self, path):
        build = skinned()
        build.scene(0, build.node(mesh=0, translation=[0, 0, 9]), build.node(mesh=0, skin=0))
        build.json["scene"] = 1
        placed = read_gltf(build.write(path)).placed
        assert [box(corners(p)) for p in placed] == [moved(3), moved(0, 0, 9), moved(3)]
        assert placed[0].mesh is placed[2].mesh is not placed[1].mesh

    def test_a_joint_without_weight_may_be_anything(self, path):
        build = skinned()
        joints = np.array([(0, 77, 78, 79)] * 4, np.uint8)
        build.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = build.accessor(joints)
        assert box(read(build.write(path))[0]) == moved(3)

    def test_fourth_rows_that_float32_has_rounded(self, path):
        build = skinned()
        number = inverse_binds(build, (0, 0, 0), (0, 0, 0))
        build.json["skins"][0]["inverseBindMatrices"] = number
        start = build.json["bufferViews"][build.json["accessors"][number]["bufferView"]][
            "byteOffset"
        ]
        build.data[start + 60 : start + 64] = np.float32(0.9999999).tobytes()
        assert read_gltf(build.write(path)).placed


class TestInstances:
    def build(self, **attributes) -> Build:
        build = Build()
        build.extension("EXT_mesh_gpu_instancing", required=True)
        held = {key: build.accessor(values, **more) for key, (values, more) in attributes.items()}
        extension = {"EXT_mesh_gpu_instancing": {"attributes": held}}
        return build.shown(translation=[0, 100, 0], extensions=extension)

    def test_places(self, path):
        places = np.array([(0, 0, 0), (3, 0, 0), (6, 0, 0)], np.float32)
        placed = read_gltf(self.build(TRANSLATION=(places, {})).write(path)).placed
        assert [box(corners(p)) for p in placed] == [moved(x, 100) for x in (0, 3, 6)]
        assert len({id(p.mesh) for p in placed}) == 1

    @pytest.mark.parametrize("dtype", ["f4", "i1", "i2"])
    def test_rotation_and_scale(self, dtype, path):
        """A quarter turn about Z; an integer's rounding makes no rotation longer or shorter."""
        whole = 1 if dtype == "f4" else np.iinfo(dtype).max
        turn = np.array([(0, 0, HALF * whole, HALF * whole)])
        turn = (turn if dtype == "f4" else np.round(turn)).astype(dtype)
        build = self.build(
            ROTATION=(turn, {} if dtype == "f4" else {"normalized": True}),
            SCALE=(np.array([(2, 3, 4)], np.float32), {}),
        )
        triangles, notes = read(build.write(path))
        assert np.allclose(box(triangles), [[-3, 100, 0], [0, 102, 0]], atol=1e-6) and not notes
        assert area(triangles) == pytest.approx(6, rel=1e-15)

    def test_instances_of_no_mesh_are_named(self, path):
        build = Build().shown()
        build.json["scenes"][0]["nodes"].append(
            build.node(name="Empty", extensions={"EXT_mesh_gpu_instancing": {"attributes": {}}})
        )
        triangles, (note,) = read(build.write(path))
        assert area(triangles) == 1 and "without a mesh" in note and "node 1 'Empty'" in note
